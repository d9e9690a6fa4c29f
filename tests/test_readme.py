"""Every number in the README's findings is one that the workflow published."""

import re
from pathlib import Path

import pandas as pd
import pytest

from replication.claim import JudgedClaim
from replication.ledger import read_judged
from replication.publishing import count_table
from steps import headlines

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "tests" / "reference"


def found() -> str:
    return headlines.found((ROOT / "README.md").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def claims() -> dict[str, JudgedClaim]:
    rows = read_judged(REFERENCE / "claims.json")
    return {row.id: row for row in rows}


def test_every_number_is_published():
    assert list(headlines.headlines(ROOT)) == []


def test_probabilities_at_a_stated_velocity_are_published():
    shares = headlines.probabilities(REFERENCE, headlines.STATED_PGV)
    alone, fixed, free = (f"{100 * shares[support]:.0f} %" for support in ("bare", "fixed", "free"))
    said = " ".join(found().split())
    assert f"overturn {alone} of the 6 m columns alone, {fixed} with their own mass fixed" in said
    assert f"and {free} with it carried freely" in said


def test_two_thirds_of_the_gain_are_had_at_mass_ratio_one():
    share = pd.read_csv(REFERENCE / "mass_ratio.csv").set_index("mass_ratio").share_of_size_gain
    assert "Two thirds of the gain" in found()
    assert share[1.0] == pytest.approx(2 / 3, abs=1e-9)


def test_equations_said_to_be_wrong_are_those_of_their_kind(claims):
    equations = pd.read_csv(REFERENCE / "equations.csv")
    parts = (found().split("Eqs.")[1].split("have")[0], found().split("Eqs.")[2].split("hold")[0])
    for said, fault in zip(parts, ("sign", "convention"), strict=True):
        numbers = {int(n) for n in re.findall(r"\((\d+)\)", said)}
        assert numbers == {int(n) for n in equations[equations.fault == fault].equation}


def test_lowest_amplitude_is_said_to_rise_where_the_ledger_confirms_it(claims):
    assert "minimum overturning acceleration rises with γ" in " ".join(found().split())
    assert claims["reversals_lowest_rises"].verdict == "confirmed"
    assert claims["lowest_amplitude_rises_with_mass"].verdict == "confirmed"


def test_links_lead_somewhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not target.startswith("http"):
            assert (ROOT / target).exists(), f"README.md links to {target}, which does not exist"


def test_motions_of_the_study_are_as_many_as_said():
    motions = headlines.motions(
        REFERENCE, "reversals_medians", mass_ratio=1.0, as_large_as=0
    ).motions
    assert f"Under {motions:.0f} near-fault motions" in found()


def test_table_of_verdicts_counts_the_claims_of_paper_and_studies_apart():
    assert "\n".join(count_table(read_judged(REFERENCE / "claims.json"))) in found()
