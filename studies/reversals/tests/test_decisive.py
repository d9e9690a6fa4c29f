"""Each result that a claim of the study depends on, in a small case in which it is false."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.judging.findings import read_findings
from steps.shared.spectra_compared import Spectra
from studies.reversals.steps import motions_fragility, motions_records, pulses
from studies.reversals.subjects import frames_and_columns
from topheavy import STANDARD_GRAVITY, Column, Record
from topheavy.risk.ensemble import Ensemble

STUDY = Path(__file__).resolve().parents[1]
CASE = {
    "slendernesses": [14.0],
    "shapes": ["one-sine"],
    "mass_ratios": [0.0, 1.0],
    "frequency_ratios": {"lowest": 2.0, "highest": 4.0, "points": 3},
    "amplitudes": {"lowest": 1.0, "highest": 6.0, "resolution": 0.05},
    "finer": {"below": 1.3, "resolution": 0.01},
}
ENSEMBLE = {
    "run": "default",
    "runs": {"default": {"motions": 1}},
    "intensities": {"lowest": 1.0, "highest": 2.0, "points": 2},
    "cases": [{"structure": "temple", "share": 1.0, "mass_ratios": [0.0, 1.0, math.inf]}],
    "as_large_as": [],
}
STRUCTURES = {"temple": {"half_width": 0.5, "half_height": 3.0}}


def spectra(*rows):
    """Spectra of known intervals: γ, frequency, lower, upper, mode."""
    table = pd.DataFrame(rows, columns=["mass_ratio", "frequency_ratio", "lower", "upper", "mode"])
    return Spectra(CASE, table.assign(slenderness_deg=14.0, shape="one-sine", linearised=False))


BOTH = [(gamma, ratio, 2.0, 4.0, "without impact") for gamma in (0.0, 1.0) for ratio in (2.0, 3.0)]


@pytest.mark.parametrize(
    ("mode", "holds"), [("with impact", True), ("without impact", False)], ids=str
)
def test_one_reversal_without_an_impact_is_an_exception(mode, holds):
    found = pulses.without_impact(spectra(*BOTH, (1.0, 4.0, 3.0, 3.5, mode)), [(0.0, 1.0)])
    assert found["holds"] is holds
    assert found["widest"] == (0.0 if holds else 0.5)
    assert found["compared"] == (2 if holds else 3)


def test_error_of_a_mean_share_is_that_of_a_rule_of_second_order():
    exact, fault = 0.1, 1e-3
    rows = pd.DataFrame(
        {"helps": [exact + fault], "helps_by_two": [exact + 4 * fault]}
        | {"helps_by_four": [exact + 16 * fault]}
    )
    for same in (rows, rows.assign(helps_by_two=rows.helps), rows.assign(helps_by_four=rows.helps)):
        mean, error = pulses.mean(same, "helps")
        assert mean == pytest.approx(exact + fault)
        assert error == pytest.approx(2.0 * fault)


def less(*bounds):
    return pd.DataFrame(bounds, columns=["less", "less_low", "less_high"])


@pytest.mark.parametrize(
    ("low", "high", "holds"),
    [(0.01, 0.03, True), (-0.04, 0.0, True), (-0.06, -0.01, False), (-0.3, 0.5, False)],
)
def test_rise_that_no_interval_excludes_is_not_denied(low, high, holds):
    table = less((0.02, 0.01, 0.03), (0.5 * (low + high), low, high))
    found = motions_fragility.never_rises(table, 0.05)
    assert found["holds"] is holds
    assert found["words"] == ("exclude" if holds else "do not exclude")


def ensemble(*outcomes):
    """Frames of γ = 0, 1 and ∞, each with its outcomes over motions, and the means over these."""
    under = frames_and_columns(ENSEMBLE, STRUCTURES)["temple"].subjects
    fell = np.stack([np.array(one, dtype=bool)[:, None] for one in outcomes], axis=1)
    found = Ensemble(fell, None, 200, 1, 0.95)
    case = motions_fragility.Case("broadband", under, 1.0, np.ones(1), found)
    return case, [found.means(), *found.means_of(motions_fragility.differing(case, fell))]


@pytest.mark.parametrize("rising", [False, True])
def test_heavier_frame_that_overturns_more_often_is_noticed(rising):
    often, seldom = [1, 1, 1, 0] * 50, [1, 0, 0, 0] * 50
    order = (seldom, often, often) if rising else (often, seldom, seldom)
    found, (means, *of_pairs) = ensemble(*order)
    table = motions_fragility.falls(found, means)
    assert motions_fragility.never_rises(table, 0.05)["holds"] is not rising
    assert table.less.iloc[0] == pytest.approx(-0.5 if rising else 0.5)
    pair = motions_fragility.pairs(found, of_pairs).iloc[0]
    assert (pair.reversed_high < 0.5) == (not rising)


def test_small_rises_that_add_up_are_noticed():
    fell = [[1] * number + [0] * (100 - number) for number in (40, 44, 48)]
    found, (means, *_) = ensemble(*fell)
    table = motions_fragility.falls(found, means)
    assert sorted(table.less.round(9)) == [-0.08, -0.04, -0.04]


def test_remark_gives_the_published_limits():
    rows = read_yaml(STUDY / "claims.yaml")
    remark = next(row for row in rows if row["id"] == "reversals_fragility")["remark"]
    reference = STUDY.parents[1] / "tests" / "reference"
    found = read_findings(reference / "findings" / "reversals_motions.json")
    rise = found["fragility_never_rises"]["largest_rise_not_excluded"]
    least = pd.read_csv(reference / "studies" / "reversals_medians.csv").motions.min()
    half_width = 1.96 * math.sqrt(0.25 / least)
    told = remark.replace("\n", " ")
    assert f"do not exclude {100 * rise:.1f} points" in told
    assert f"{least} motions, is known to {100 * half_width:.1f} points" in told


def test_all_frames_of_a_structure_are_shaken_alike():
    column = Column(**STRUCTURES["temple"])
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    assert frames_and_columns(ENSEMBLE, STRUCTURES)["temple"].levels == pytest.approx(
        [unit, 2.0 * unit]
    )


def test_outcome_that_a_billionth_of_the_record_changes_is_undecided(monkeypatch):
    def overturned_by(frame, record, factors, tolerance=None):
        return np.asarray(factors) > 2.0 * LEVEL

    monkeypatch.setattr(motions_records, "overturned_by", overturned_by)
    record = Record(0.1, np.array([0.0, 1.0, 0.0]), "sharp")
    row = motions_records.row(record, 10.0, 2.0, 1.0, np.array([1.0, 2.0, 3.0]), 3e-12)
    assert row["outcomes"] == "s?f"


LEVEL = motions_records.column_of(10.0, 2.0).uplift_acceleration
