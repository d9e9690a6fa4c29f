"""README's numbers, the published tables and the claims agree; the paper comes first."""

import json
import re

import pandas as pd
import pytest

from replication.claims import unexpected
from steps.check import REFERENCE, findings, published
from steps.compare import departures
from tests.cases import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def found():
    return findings(json.loads((ROOT / REFERENCE / "rules.json").read_text("utf-8")))


def test_every_claim_has_its_expected_verdict_by_the_published_tables():
    assert unexpected(published()) == []


def test_first_value_that_departs_from_the_published_one_is_named():
    ours, theirs = (pd.DataFrame({"x": [1, 2.0], "y": [0.1, y]}) for y in (0.2, 0.3))
    bounds = {"relative": 1e-6, "absolute": 1e-9, "counts": 3}
    (told,) = departures(ours, theirs, bounds)
    assert told == "y (At positional index 1, first diff: 0.2 != 0.3)"


def test_numbers_of_readme_are_those_of_the_published_tables(found):
    trilith, vase, motions, spectra = (found[n] for n in ("trilith", "vase", "motions", "spectra"))
    errors = [100 * found["allen"][f"error_all_{ratio}"]["value"] for ratio in ("0.5", "2", "10")]
    gain = [100 * motions["gain"][end] for end in ("least", "most")]
    reduction = [100 * found["break_even"]["benefit_ends"][end] for end in ("least", "most")]
    sentences = [
        f"R̂ is at most {found['parameters']['limit_of_size_ratio']['value']:.1f} times R",
        f"p̂ = {trilith['frame_frequency_parameter']['value']:.2f} rad/s",
        "by {:.1f}, {:.1f} and {:.1f} % for γ = 0.5, 2 and 10".format(*errors),
        f"from {vase['minimum_of_the_column']['value']:.3f} g alone",
        f"from {vase['minimum_of_the_heaviest']['value']:.3f} g under a very heavy beam",
        "by {:.0f} to {:.0f} %".format(*gain),
        "{:.0f} to {:.0f} % less velocity after impacts".format(*reduction),
        f"prevents overturning on {100 * spectra['prevented']['value']:.0f} % of the area",
        f"causes it on {100 * spectra['caused']['value']:.1f} %",
    ]
    text = " ".join(README.split())
    assert [sentence for sentence in sentences if sentence not in text] == []
    told = re.sub(r"```.*?```|\([^)]*\)|\[[^]]*\]", "", README, flags=re.DOTALL)
    assert len(re.findall(r"\d+\.\d+|\d+ %", told)) <= 25


@pytest.mark.parametrize("document", ["README.md", "paper/report.typ"])
@pytest.mark.parametrize(
    "word", ["Allen", "trilith", "Peña", "p̂|hat\\(p\\)", "R̂|hat\\(R\\)", "plan(e|ar)"]
)
def test_results_that_were_asked_for_are_in_readme_and_article(document, word):
    assert re.search(word, (ROOT / document).read_text(encoding="utf-8"))


def test_plane_is_in_the_answer_and_the_abstract():
    answer = README.partition("**Answer")[2].partition("\n\n")[0]
    abstract = (ROOT / "paper/report.typ").read_text(encoding="utf-8").partition("abstract: [")[2]
    assert "planar" in answer
    assert "planar" in abstract.partition("],")[0]


def test_readme_is_short_and_its_files_are_there():
    assert len(README.splitlines()) <= 70
    assert len(README.split()) <= 750
    for path in re.findall(r"\]\(([^)#:]+)\)", README):
        assert (ROOT / path).exists(), path
