"""Captions, article, supplement and the list of verdicts name what there is."""

import re

import yaml

from documents import lists
from tests.cases import ROOT

TEXTS = {name: (ROOT / f"paper/{name}.typ").read_text("utf-8") for name in ("report", "supplement")}
CAPTIONS = yaml.safe_load((ROOT / "figures/captions.yaml").read_text("utf-8"))
CLAIMS = yaml.safe_load((ROOT / "paper/claims.yaml").read_text("utf-8"))


def test_each_figure_has_a_caption_and_is_in_one_document():
    shown = [name for text in TEXTS.values() for name in re.findall(r'#picture\("(\w+)"', text)]
    scripts = {path.stem: path.read_text("utf-8") for path in (ROOT / "figures").glob("*.py")}
    drawn = [name for name, text in scripts.items() if "\ndef draw(" in text]
    assert sorted(shown) == sorted(CAPTIONS) == sorted(drawn)


def test_captions_name_claims_that_there_are():
    known = {row["id"] for rows in CLAIMS.values() for row in rows}
    for name, caption in CAPTIONS.items():
        assert set(caption) == {"title", "alt", "text", "claims"}, name
        assert set(caption["claims"]) <= known, name


CLAIM = {
    "id": "uplift", "where": "p. 3", "statement": "At |θ| = 0.", "printed": 0.275, "unit": "g",
    "rule": "trilith", "finding": "uplift", "differs": "", "remark": "For one pulse.",
    "part": "paper", "verdict": "confirmed", "shown": "0.2750 g", "condition": None,
}  # fmt: skip


def claims(*rows, captions=None):
    return lists.claims(lists.Run(list(rows), captions or {}), lists.Docs())


def test_a_confirmed_claim_is_one_line_with_links():
    text = claims(CLAIM, captions={"map": {"claims": ["uplift"]}})
    assert (
        '| <a id="uplift"></a>`uplift`, p. 3. At &#124;θ&#124; = 0. | 0.275 g | 0.2750 g | '
        "**confirmed** | [trilith.uplift](numbers.md#trilith.uplift), "
        "[figures/map.py](../figures/map.py) |"
    ) in text
    assert "For one pulse." not in text


def test_other_claims_come_first_with_a_reason_and_a_discrepancy_has_its_place():
    qualified = CLAIM | {"id": "late", "verdict": "qualified", "condition": "ω is at most 2 p"}
    text = claims(CLAIM, CLAIM | {"id": "copy", "differs": "sign"}, qualified)
    assert "<br>True if ω is at most 2 p. For one pulse. |" in text
    assert "**confirmed** (our copy differs) |" in text
    assert "- p. 3 (`copy`), sign. For one pulse." in text
    assert text.index('id="late"') < text.index('id="copy"') < text.index('id="uplift"')


def test_each_reference_is_cited_and_each_source_is_a_reference():
    keys = {*re.findall(r"^@\w+{(\w+)", (ROOT / "paper/references.bib").read_text("utf-8"), re.M)}
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text("utf-8"))
    sources = {row["source"] for row in config["verification"]["published"]}
    cited = {key for text in TEXTS.values() for key in re.findall(r"[<@]([a-z]+\d{4})\b", text)}
    assert cited | sources == keys
