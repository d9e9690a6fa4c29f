"""The steps about motions: what is paired, counted and told."""

import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.special import ndtr

import topheavy as th
from replication.inputs.strict_yaml import read_yaml
from steps.shared import sweep
from studies.reversals.steps import motions_check, motions_fragility
from studies.reversals.subjects import frames_and_columns
from topheavy.ground.synthetic.ensemble import draws, first_draws
from topheavy.risk.ensemble import Ensemble

ROOT = Path(__file__).resolve().parents[3]
STRUCTURES = {"temple": {"half_width": 0.5, "half_height": 3.0}}
CASE = {
    "run": "default",
    "runs": {"default": {"motions": 40, "shards": 2}},
    "seed": 5,
    "families": ["near-fault", "broadband"],
    "scenarios": [
        {"magnitude": 6.5, "distance": 10.0, "site_velocity": 760.0, "directivity": 10.0},
        {"magnitude": 7.0, "distance": 10.0, "site_velocity": 760.0, "directivity": 20.0},
    ],
    "cases": [{"structure": "temple", "share": 0.5, "mass_ratios": [0.0, 1.0, math.inf]}],
    "as_large_as": [1.0],
    "intensities": {"lowest": 0.4, "highest": 2.5, "points": 11},
    "bootstrap": {"resamples": 200, "confidence": 0.9},
    "largest_rise": 0.05,
    "shares_of_gain": [0.5],
    "sample": {"points": 6, "within": 0.01, "second_route": 1},
}


ASKED = frames_and_columns(CASE, STRUCTURES)


@pytest.fixture(scope="module")
def answered() -> dict[str, sweep.Swept]:
    shards = [sweep.sweep(ASKED, CASE, shard) for shard in ("1-of-2", "2-of-2")]
    return {name: sweep.answers(shards, name, CASE, one.motions) for name, one in ASKED.items()}


def test_motions_of_all_scenarios_and_families_differ():
    alike = CASE | {"scenarios": CASE["scenarios"][:1] * 2}
    for case in (CASE, alike):
        first = [draw.record().acceleration[:500] for draw in draws(case) if draw.number == 0]
        assert len({samples.tobytes() for samples in first}) == 4


def test_pairs_count_what_differs():
    light, heavy = np.array([[1, 1, 0], [1, 0, 1]]), np.array([[1, 0, 1], [0, 0, 1]])
    outcomes = np.stack([light, heavy], axis=1) == 1
    under = [
        sweep.Subject({"structure": "temple", "mass_ratio": gamma, "as_large_as": 0.0}, None)
        for gamma in (0.0, 1.0)
    ]
    found = Ensemble(outcomes, None, 50, 1, 0.9)
    case = motions_fragility.Case("broadband", under, 1.0, np.ones(3), found)
    means = found.means_of(motions_fragility.differing(case, outcomes))
    (pair,) = motions_fragility.pairs(case, means).itertuples()
    assert (pair.only_lighter, pair.only_heavier) == pytest.approx((3 / 8, 1 / 8))
    assert pair.reversed == pytest.approx(1 / 4)


def test_shares_hardly_depend_on_the_number_of_levels():
    """Twice as many levels move the published shares by less than half of their intervals."""
    study, config = (
        read_yaml(ROOT / path) for path in ("studies/reversals/config.yaml", "config/config.yaml")
    )
    case = study["motions_ensemble"]
    column = th.Column(**config["structures"]["temple"])
    under = [th.RockingFrame(column, gamma) for gamma in (0.0, 1.0)]
    unit = th.STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    ends = [case["intensities"][end] for end in ("lowest", "highest")]
    count = case["intensities"]["points"]
    pgvs = np.broadcast_to(unit * np.geomspace(*ends, 2 * count - 1), (2, 2 * count - 1))
    table = pd.read_csv(ROOT / "tests/reference/studies/reversals_pairs.csv")
    table = table.query("structure == 'temple' and lighter == 0 and heavier == 1")
    for row in table.itertuples():
        fell = np.array(
            [
                th.overturned_together(under, record, pgvs / record.peak_velocity)
                for draw in first_draws(case, 100)
                if draw.family == row.family
                for record in [draw.record()]
            ]
        )
        light, heavy = fell[:, 0], fell[:, 1]
        for name, cells in (("only_lighter", light & ~heavy), ("only_heavier", heavy & ~light)):
            twice, once = (
                float(motions_fragility.over_levels(cells.mean(axis=0)[::step])) for step in (1, 2)
            )
            width = getattr(row, f"{name}_high") - getattr(row, f"{name}_low")
            assert abs(twice - once) < 0.5 * width


def test_findings_come_with_intervals_around_their_values(answered):
    tables, findings = motions_fragility.main(CASE, STRUCTURES, answered)
    values = {"fragility": "probability", "medians": "median", "pairs": "only_heavier"}
    for name, value in values.items():
        table = tables[name]
        assert (table[f"{value}_low"] <= table[value] + 1e-12).all()
        assert (table[value] <= table[f"{value}_high"] + 1e-12).all()
    cells = 2 * 3 * 40 * 11  # families, pairs, motions, levels
    assert findings["heavier_is_safer"]["cells"] == cells


@pytest.mark.parametrize(
    ("shares", "reason"),
    [
        ([0, 0, 0, 0, 0.5, 1, 1, 1, 1], "1 of the levels have a probability between 0 and 1"),
        (ndtr(np.log(np.geomspace(0.5, 2.0, 9) / 2.5) / 0.5), "passes 1/2 at 2.5, which is"),
    ],
)
def test_median_that_is_not_known_is_not_published(shares, reason):
    levels = np.geomspace(0.5, 2.0, 9)
    known = ndtr(np.log(levels) / 0.5)
    assert motions_fragility.middles(levels, np.array([[known]])) == pytest.approx(1.0)
    with pytest.raises(ValueError, match=f"no median; expected one for each: .*{reason}"):
        motions_fragility.middles(levels, np.array([[known, shares]]))


def test_sample_is_judged_again(answered):
    _, found = motions_check.main(CASE, STRUCTURES, answered, 3e-12)
    assert found["tightened_agrees"]["cells"] + found["tightened_agrees"]["undecided"] == 6
    assert found["second_route_agrees"]["cells"] == 1


def test_sample_of_which_nothing_is_decided_agrees_with_nothing(answered, monkeypatch):
    def sensitive(frame, record, factors, tolerance=None):
        return np.arange(len(factors)) == 1  # a change by a billionth, and only that, overturns

    monkeypatch.setattr(motions_check, "overturned_by", sensitive)
    monkeypatch.setattr(motions_check, "boundary", lambda frame, record, low, high: low)
    _, found = motions_check.main(CASE, STRUCTURES, answered, 3e-12)
    assert [one["cells"] for one in found.values()] == [0, 0]
    assert not any(one.holds for one in found.values())
