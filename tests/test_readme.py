"""Every number in the README's findings is one that the workflow published."""

import json
import re
import shutil
from pathlib import Path

import pandas as pd
import pytest

from replication.inputs.parts import PAPER
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


@pytest.mark.parametrize("study", sorted({part for part, _ in headlines.IN_ORDER} - {PAPER}))
def test_study_that_is_not_published_has_no_numbers(tmp_path, study):
    """And those of the paper and of the other studies need none of its files."""
    gone = shutil.ignore_patterns(f"{study}*")
    left = Path(shutil.copytree(REFERENCE, tmp_path / "reference", ignore=gone))
    rows = json.loads((left / "claims.json").read_text(encoding="utf-8"))
    rows = [row for row in rows if row["study"] != study]
    (left / "claims.json").write_text(json.dumps(rows), encoding="utf-8")
    of_others = [of(REFERENCE) for part, of in headlines.IN_ORDER if part != study]
    assert headlines.numbers(left) == [number for of in of_others for number in of]


def said() -> str:
    return " ".join(found().split())


def test_motions_that_overturn_at_a_stated_velocity_are_published():
    rows = {name: headlines.stated_motions(REFERENCE, name) for name in ("bare", "fixed", "free")}
    family = motions_of_a_family()
    assert all((of.motions == family).all() and len(of) == 2 for of in rows.values())
    alone, fixed, free = (headlines.from_to(of.probability) for of in rows.values())
    assert f"{alone} % overturn a 6 m column alone, {fixed} % the column with its own" in said()
    assert f"and {free} % the frame that carries the same mass freely" in said()


@pytest.mark.parametrize(
    ("shares", "digits", "words"),
    [([0.05, 0.09], 0, "5 to 9"), ([0.26, 0.163], 1, "16.3 to 26.0"), ([0.1], 0, "10 to 10")],
)
def test_range_has_both_its_ends(shares, digits, words):
    assert headlines.from_to(pd.Series(shares), digits) == words


def test_starts_of_the_trilith_are_as_many_as_said():
    starts = pd.read_csv(REFERENCE / "trilith_states.csv")
    assert f"of {len(starts)} starts in motion" in said()
    assert (starts[["rotation", "velocity"]] != 0.0).any(axis=1).all()


def test_measured_records_that_reverse_the_ranking_unscaled_are_published():
    (name, alone), (other, both) = headlines.unscaled(REFERENCE).items()
    assert name.rpartition("_")[0] == other.rpartition("_")[0]  # of one station
    (frame,) = alone[True]
    assert frame > 0.0 in alone[False]
    assert f"one overturns only the 6 m frame with γ = {frame:g}." in said()
    column, *frames = both[True]
    assert column == 0.0
    falls, stands = (" and ".join(f"{gamma:g}" for gamma in of) for of in (frames, both[False]))
    assert f"overturns the 6 m column and its frames with γ = {falls}, but not" in said()
    assert f"but not with γ = {stands}." in said()


def test_floor_of_the_minima_is_that_of_the_search():
    vase = read_yaml(REFERENCE / "config.yaml")["vase"]
    assert vase["floor"] == 1e-3
    assert "narrower than a thousandth of the uplift acceleration are not excluded" in said()
    broken = pd.read_csv(REFERENCE / "vase_exceptions.csv")
    records = broken[broken.kind == "record"]
    assert set(broken.structure) == {"fixed"}
    assert len(set(records.motion)) == 1
    assert "Short pulses and one record reverse the first" in said()


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


def test_benefit_is_said_to_do_what_its_intervals_say():
    rows = pd.read_csv(REFERENCE / "studies" / "certainty_benefit.csv")
    both, alone = (
        rows[rows.way == way].set_index(["factor", "family"]).interval
        for way in ("both", "column alone")
    )
    assert "remains if the coefficients of restitution of column and frame change by" in said()
    assert set(both) == {"is positive"}
    assert "If only that of the column is 10 % lower, the ranking at" in said()
    assert set(alone[0.9]) == {"is negative"}
    assert f"5 % lower, the 95 % interval of the benefit {alone[0.95, 'broadband']} for" in said()
    assert alone[0.95, "near-fault"] == "is positive"


def test_rise_under_each_pulse_of_the_period_is_published():
    rises = headlines.rises_at_one_period(REFERENCE)
    assert len(rises) == 3
    assert f"shapes of pulses of this period, it rises by {headlines.from_to(rises)} %" in said()


def test_portal_is_said_to_overturn_later_where_the_ledger_confirms_it(claims):
    assert "A portal overturns later still" in said()
    assert claims["portal_overturns_last"].verdict == "confirmed"


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


def motions_of_a_family() -> int:
    """Return how many motions each family has, the same in all."""
    rows = headlines.motions(REFERENCE, "reversals_medians", mass_ratio=1.0, as_large_as=0)
    (found,) = set(rows.motions)
    return found


def test_motions_of_the_study_are_as_many_as_said():
    assert f"Under two families of {motions_of_a_family()} motions each" in found()


def test_table_of_verdicts_counts_the_claims_of_paper_and_studies_apart():
    assert "\n".join(count_table(read_judged(REFERENCE / "claims.json"))) in found()


def test_run_takes_as_long_as_said():
    """Figures and documents, which the published costs leave out, take up to two minutes more."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    least, most = map(int, re.search(r"# (\d+) to (\d+) minutes on two cores", readme).groups())
    minutes = pd.read_csv(ROOT / "docs" / "costs.csv").seconds.sum() / 2 / 60
    assert least - 2 <= minutes <= most
