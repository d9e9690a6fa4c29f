"""Captions, article and supplement name what there is."""

import re

import yaml

from tests.cases import ROOT

TEXTS = {name: (ROOT / f"paper/{name}.typ").read_text("utf-8") for name in ("report", "supplement")}
CAPTIONS = yaml.safe_load((ROOT / "figures/captions.yaml").read_text("utf-8"))
CLAIMS = yaml.safe_load((ROOT / "paper/claims.yaml").read_text("utf-8"))


def test_each_figure_has_a_caption_and_is_in_one_document():
    shown = [name for text in TEXTS.values() for name in re.findall(r'#picture\("(\w+)"', text)]
    scripts = {path.stem: path.read_text("utf-8") for path in (ROOT / "figures").glob("*.py")}
    figures = [name for name, text in scripts.items() if "\ndef draw(" in text]
    assert sorted(shown) == sorted(CAPTIONS) == sorted(figures)


def test_captions_name_claims_that_there_are():
    known = {row["id"] for rows in CLAIMS.values() for row in rows}
    for name, caption in CAPTIONS.items():
        assert set(caption) == {"title", "alt", "text", "claims"}, name
        assert set(caption["claims"]) <= known, name


def test_each_reference_is_cited_and_each_source_is_a_reference():
    keys = {*re.findall(r"^@\w+{(\w+)", (ROOT / "paper/references.bib").read_text("utf-8"), re.M)}
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text("utf-8"))
    sources = {row["source"] for row in config["verification"]["published"]}
    cited = {key for text in TEXTS.values() for key in re.findall(r"[<@]([a-z]+\d{4})\b", text)}
    assert cited | sources == keys
