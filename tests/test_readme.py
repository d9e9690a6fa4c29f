"""Every number in the README's findings is one that the workflow published."""

import json
import re
from pathlib import Path

import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import JudgedClaim
from replication.judging.ledger import read_judged
from replication.pages.edition import count_table
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


def said() -> str:
    return " ".join(found().split())


def test_motions_that_overturn_at_a_stated_velocity_are_published():
    rows = headlines.stated_motions(REFERENCE, headlines.STATED_PGV)
    alone, fixed, free = rows.fell[["bare", "fixed", "free"]]
    assert (rows.motions == rows.motions["bare"]).all()
    assert f"Of {rows.motions['bare']} near-fault motions scaled" in said()
    assert f"{alone} overturn a 6 m column alone, {fixed} the column with its own mass" in said()
    assert f"and {free} the frame that carries the same mass freely" in said()


def test_judged_claims_of_the_paper_are_as_many_as_said(claims):
    rows = [claim for claim in claims.values() if not claim.study]
    judged = [claim for claim in rows if claim.verdict != "not tested"]
    assert f"We judged {len(judged)} of their {len(rows)} claims, and refuted none" in said()
    assert not [claim.id for claim in rows if claim.verdict == "refuted"]


def test_window_of_the_map_is_that_of_the_study():
    study = read_yaml(REFERENCE / "studies" / "reversals.yaml")["pulses"]
    ends = study["grids"][study["grid"]]
    frequencies, amplitudes = (
        f"{axis['lowest']:g} to {axis['highest']:g} times"
        for axis in (ends["frequency_ratios"], ends["amplitudes"])
    )
    assert f"pulses of {frequencies} the frequency parameter" in said()
    assert f"and of {amplitudes} the uplift acceleration" in said()


def test_interval_of_the_benefit_includes_zero_where_it_is_said_to():
    found = json.loads((REFERENCE / "findings" / "certainty_restitution.json").read_text("utf-8"))
    rows = [
        row
        for row in found["probability_falls_apart"]["changes"]
        if row["way"] == "column alone" and row["factor"] == 0.9
    ]
    assert "only that of the column is 10 % lower, the 95 % interval of the benefit" in said()
    assert rows
    assert all(row["less_low"] <= 0.0 < row["less_high"] for row in rows)


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
    assert "minimum overturning acceleration rises with γ" in said()
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


def test_run_takes_as_long_as_said():
    """Figures and documents, which the published costs leave out, take up to two minutes more."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    least, most = map(int, re.search(r"# (\d+) to (\d+) minutes on two cores", readme).groups())
    minutes = pd.read_csv(ROOT / "docs" / "costs.csv").seconds.sum() / 2 / 60
    assert least - 2 <= minutes <= most
