"""Captions, article, supplement and the list of verdicts name what there is."""

import re
from pathlib import Path

import pytest
import yaml

from steps.verdicts import page

TEXTS = {name: Path(f"paper/{name}.typ").read_text("utf-8") for name in ("report", "supplement")}
CAPTIONS = yaml.safe_load(Path("figures/captions.yaml").read_text("utf-8"))
CLAIMS = yaml.safe_load(Path("paper/claims.yaml").read_text("utf-8"))


def test_each_figure_has_a_caption_and_is_in_one_document():
    shown = [name for text in TEXTS.values() for name in re.findall(r'#picture\("(\w+)"', text)]
    scripts = {path.stem: path.read_text("utf-8") for path in Path("figures").glob("*.py")}
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


def test_a_claim_is_one_row_with_links():
    claim = {
        "id": "uplift", "where": "p. 3", "statement": "At |θ| = 0.", "printed": 0.275,
        "unit": "g", "rule": "trilith", "differs": "sign", "remark": "", "part": "paper",
        "verdict": "confirmed", "shown": "0.2750 g",
    }  # fmt: skip
    rules = {
        "trilith": {"script": "src/steps/trilith.py", "tables": ["results/tables/trilith.csv"]}
    }
    text = page([claim], {"map": {"claims": ["uplift"]}}, rules)
    assert (
        "| `uplift`, p. 3. At &#124;θ&#124; = 0. | 0.275 g | 0.2750 g "
        "| confirmed (our copy differs) | "
        "[trilith.py](../src/steps/trilith.py) [trilith.csv](../tests/reference/trilith.csv) "
        "[map.py](../figures/map.py) |"
    ) in text
    assert text.endswith("- p. 3 (`uplift`): sign\n")
