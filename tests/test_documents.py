"""Captions, article, supplement and the list of verdicts name what there is."""

import re

import pytest
import yaml

from documents.verdicts import page
from tests.cases import ROOT

TEXTS = {name: (ROOT / f"paper/{name}.typ").read_text("utf-8") for name in ("report", "supplement")}
CAPTIONS = yaml.safe_load((ROOT / "figures/captions.yaml").read_text("utf-8"))
CLAIMS = yaml.safe_load((ROOT / "paper/claims.yaml").read_text("utf-8"))


def test_each_figure_has_a_caption_and_is_in_one_document():
    shown = [name for text in TEXTS.values() for name in re.findall(r'#picture\("(\w+)"', text)]
    scripts = {path.stem: path.read_text("utf-8") for path in (ROOT / "figures").glob("*.py")}
    drawn = [name for name, text in scripts.items() if "\ndef draw(" in text]
    assert sorted(shown) == sorted(CAPTIONS) == sorted(drawn)


@pytest.mark.parametrize("name", CAPTIONS)
def test_a_caption_names_claims_that_there_are(name):
    assert set(CAPTIONS[name]) == {"title", "alt", "text", "claims"}
    assert set(CAPTIONS[name]["claims"]) <= {row["id"] for rows in CLAIMS.values() for row in rows}


def test_the_abstract_has_the_results_of_the_paper_and_the_plane():
    abstract = TEXTS["report"].split("abstract: [")[1].split("\n  ],")[0]
    for words in ("hat(p) =", "limit_of_size_ratio", "restitution", "trilith", "Allen", "planar"):
        assert words in abstract


CLAIM = {
    "id": "uplift", "where": "p. 3", "statement": "At |θ| = 0.", "printed": 0.275, "unit": "g",
    "rule": "trilith", "differs": "", "remark": "For one pulse.", "part": "paper",
    "verdict": "confirmed", "shown": "0.2750 g", "condition": None,
}  # fmt: skip
RULES = {"trilith": {"script": "src/steps/trilith.py", "tables": ["results/tables/trilith.csv"]}}


def test_a_confirmed_claim_is_one_line_with_links():
    text = page([CLAIM], {"map": {"claims": ["uplift"]}}, RULES)
    assert (
        "| `uplift`, p. 3. At &#124;θ&#124; = 0. (printed 0.275 g, computed 0.2750 g) | confirmed "
        "| [trilith.py](../src/steps/trilith.py) [figures/map.py](../figures/map.py) |"
    ) in text
    assert "- [trilith.py](../src/steps/trilith.py): [trilith.csv](../tests/reference/" in text
    assert "For one pulse." not in text


def test_another_claim_has_a_paragraph_and_a_discrepancy_its_place():
    rows = [
        CLAIM | {"verdict": "qualified", "condition": "ω is at most 2 p"},
        CLAIM | {"differs": "sign"},
    ]
    text = page(rows, {}, RULES)
    assert "**`uplift`** (qualified). True if ω is at most 2 p. For one pulse." in text
    assert "| confirmed (our copy differs) |" in text
    assert text.endswith("- p. 3 (`uplift`), sign. For one pulse.\n")


ENTRIES = (ROOT / "paper/references.bib").read_text("utf-8").split("\n@")[1:]


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: re.search(r"{(\w+)", entry)[1])
def test_a_reference_has_year_and_source_and_says_what_confirms_it(entry):
    fields = set(re.findall(r"^ +(\w+) += {.", entry, re.MULTILINE))
    assert {"author", "title", "year"} <= fields
    assert fields & {"journal", "booktitle", "publisher", "institution", "url"}
    assert fields & {"confirmed", "unconfirmed"}


def test_each_reference_is_cited_and_each_source_is_a_reference():
    keys = {re.search(r"{(\w+)", entry)[1] for entry in ENTRIES}
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text("utf-8"))
    sources = {row["source"] for row in config["verification"]["published"]}
    cited = {key for text in TEXTS.values() for key in re.findall(r"[<@]([a-z]+\d{4})\b", text)}
    assert cited | sources == keys
