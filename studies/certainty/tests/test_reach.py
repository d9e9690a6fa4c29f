"""How far the claim reaches: break-even, the whole sample, proven reversals."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from steps.shared import sweep
from steps.shared.second import by_scipy
from studies.certainty.steps import break_even, proven, reach
from studies.certainty.subjects import columns, lowered, stated
from studies.certainty.tests.test_rates import ENSEMBLE
from tests.cases import COLUMN, SIZES
from topheavy import Column, Record, RockingFrame, overturned_by
from topheavy.ground.synthetic.ensemble import first_draws
from topheavy.proven import Outcome

PULSES = {"kind": "pulses", "mass_ratio": 1.0, "overturned": 9, "without_impact": 4}
RECORDS = {"kind": "records", "mass_ratio": 1.0, "overturned": 9, "without_impact": 0}


@pytest.mark.parametrize(
    ("pulses", "records", "holds"),
    [
        ({}, {}, True),
        ({}, {"without_impact": 1}, False),
        ({}, {"overturned": 0}, False),  # nothing was overturned
        ({"without_impact": 0}, {}, False),
    ],
)
def test_no_overturning_in_earthquakes_is_without_an_impact(pulses, records, holds):
    rows = [PULSES | pulses, RECORDS | records]
    found = reach.findings(pd.DataFrame(rows).assign(asked=1, differ=0))
    assert found["none_in_earthquakes"].holds is holds


@pytest.mark.parametrize(("asked", "differ", "holds"), [(3, 0, True), (3, 1, False), (0, 0, False)])
def test_scipy_has_to_agree_in_the_whole_sample(asked, differ, holds):
    found = reach.findings(pd.DataFrame([PULSES, RECORDS]).assign(asked=asked, differ=differ))
    assert found["reach_by_scipy"].holds is holds


CASE = {
    "column": SIZES,
    "sizes": [1.0, 2.0],
    "mass_ratios": [1e-12, 4.0],
    "deficits": {"highest": 1.0, "step": 0.25},
    "motions": 4,
    "pgv": [0.6, 1.0],
    "scaled": [0.8],
    "bootstrap": {"resamples": 100, "confidence": 0.95},
    "seed": 31,
    "checked": 4,
    "measured": [0.03, 0.05],
}


@pytest.fixture(scope="module")
def groups():
    asked = {str(place): lowered(one, CASE) for place, one in enumerate(columns(CASE))}
    shards = [sweep.sweep(asked, ENSEMBLE, "1-of-1")]
    answered = [sweep.answers(shards, name, ENSEMBLE, 4) for name in asked]
    return list(break_even.groups(answered, CASE, ENSEMBLE))


# Structures and gains -----------------------------------------------------------------------------


def test_columns_are_lowered_and_frames_are_not():
    small, large = columns(CASE)
    assert large == type(small)(1.0, 6.0)
    under, own = lowered(small, CASE).subjects, small.restitution
    ratios = [one.block.restitution for one in under if one.labels["mass_ratio"] == 0.0]
    assert ratios == pytest.approx([own, 0.75 * own, 0.5 * own, 0.25 * own, 0.0])
    frames = [one.block for one in under if one.labels["mass_ratio"] > 0.0]
    own = [RockingFrame(small, gamma).block() for gamma in (0.0, *CASE["mass_ratios"])]
    assert [under[0].block, *frames] == own


def test_cells_have_the_benefit_of_the_counts(groups):
    """At each deficit, in the cells in which enough columns and not too many frames overturn."""
    assert [(one.family, one.subjects[0].labels["height"]) for one in groups] == [
        (family, height) for height in (6.0, 12.0) for family in ENSEMBLE["families"]
    ]
    group = groups[0]
    records = [d.record() for d in first_draws(ENSEMBLE, 4) if d.family == group.family]
    levels = stated(group.column, CASE)

    def shares(structure):
        pgvs = np.array([pgv for *_, pgv in levels])
        return np.mean([overturned_by(structure, r, pgvs / r.peak_velocity) for r in records], 0)

    own, frame = COLUMN.block(), shares(RockingFrame(COLUMN, 4.0))
    deficits = np.arange(5) / 4.0
    column = [shares(own.with_restitution((1.0 - d) * own.restitution)) for d in deficits]
    found = [(row, end) for row, end in break_even.ends(group, CASE, 1) if row["mass_ratio"] == 4.0]
    asked = (column[0] >= 0.05) & (frame <= 0.95)
    assert [row["level"] for row, _ in found] == [levels[k][1] for k in np.flatnonzero(asked)]
    assert asked.any()
    for (row, ends), k in zip(found, np.flatnonzero(asked), strict=True):
        assert (row["column"], row["frame"]) == pytest.approx((column[0][k], frame[k]))
        benefits = np.array(column)[:, k] - frame[k]
        assert ends[0] == break_even.end_of(deficits, benefits)
        assert row["coarser"] == break_even.end_of(deficits[::2], benefits[::2])
        assert len(ends) == 101


def test_motions_are_resampled_within_each_earthquake(groups):
    """All columns overturn in one, and all frames in the other: no resample has a benefit."""
    group = groups[0]
    first = group.swept.scenarios == 0
    column = np.array([one.labels["mass_ratio"] == 0.0 for one in group.subjects])
    fell = np.broadcast_to((first[:, None] == column)[..., None], group.swept.outcomes.shape)
    changed = group._replace(swept=replace(group.swept, outcomes=fell))
    for _, ends in break_even.ends(changed, CASE, 1):
        assert (ends == 0.0).all()


OF_SCIPY = [(3, 0, True), (3, 1, False), (0, 0, False)]


@pytest.mark.parametrize(("decided", "differ", "holds"), OF_SCIPY)
def test_scipy_has_to_find_the_sampled_outcomes(groups, given, decided, differ, holds):
    cells = list(break_even.sampled(groups, CASE))
    assert by_scipy(cells) == {"decided": CASE["checked"], "differ": 0}
    given(break_even, by_scipy={"decided": decided, "differ": differ}, groups=groups)
    assert break_even.main(CASE, ENSEMBLE, [])[-1]["break_even_by_scipy"].holds is holds


# Where the benefit ends --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("benefits", "end"),
    [
        ([4, 2, -2, -4], 1.5),
        ([4, 2, 0, -4], 2.0),
        ([4, 1, 3, -4], 1.5 + 1.5 / 3.0),  # the middle two are one block at 1.5 with 2
        ([3, -1, 1, -3], 1.5),  # a benefit that comes back is not the end of one that goes
        ([4, 3, 2, 1], math.inf),
        ([0, 1, -1, -2], 0.5 + 0.5 / 1.5 * 1.5),
        ([-1, -2, -3, -4], 0.0),
    ],
)
def test_benefit_ends_where_its_non_increasing_fit_is_zero(benefits, end):
    found = break_even.end_of(np.arange(4.0), np.array(benefits, dtype=float))
    assert found == pytest.approx(end)


def cells(*ends, coarser=0.0):
    table = pd.DataFrame({"end": ends, "end_low": 0.04, "end_high": 0.14})
    return table.assign(coarser=table.end + coarser)


@pytest.mark.parametrize(
    ("table", "coarser", "broken"),
    [
        (cells(0.05, 0.1), 0.049, set()),
        (cells(0.05, math.inf), 0.0, {"benefit_ends"}),
        (cells(0.05, 0.1), 0.051, {"step_is_fine_enough"}),
    ],
)
def test_what_the_ends_decide(table, coarser, broken):
    median = cells(0.08, coarser=coarser)
    table = table.assign(coarser=table.end + coarser)
    found = break_even.findings(table, median, pd.DataFrame([{"largest": 0.04}]))
    assert {name for name, one in found.items() if not one.holds} == broken
    assert (found["benefit_ends"]["median"], found["benefit_ends"]["least"]) == (0.08, 0.05)
    assert break_even.remains(cells(0.051, 0.1), 0.05).holds
    found = break_even.remains(cells(0.05, 0.1), 0.05)
    assert (found.holds, found["kept"], found["compared"]) == (False, 1, 2)


EXTREME = [(0.0, "overturns", 2), (float("inf"), "overturns", 0)]


def table(extreme=EXTREME, under=(("survives", "survives"), ("overturns", "undecided"))):
    rows = [
        {"record": "extreme", "structure": slope, "mass_ratio": g, "proven": p, "impacts": n}
        for slope, some in (("20°", EXTREME), ("30°", extreme))
        for g, p, n in some
    ]
    rows += [{"record": "a", "by_solver": solver, "proven": found} for solver, found in under]
    return pd.DataFrame(rows)


@pytest.mark.parametrize(
    ("light", "heavy", "holds"),
    [
        (("overturns", 2), ("overturns", 0), True),
        (("survives", 0), ("overturns", 0), True),
        (("overturns", 0), ("overturns", 0), False),
        (("overturns", 2), ("overturns", 1), False),
        (("undecided", -1), ("overturns", 0), False),
        (("overturns", 2), ("undecided", 0), False),
    ],
)
def test_counterexample_overturns_the_heavier_frame_alone_without_impact(light, heavy, holds):
    extreme = [(0.0, *light), (float("inf"), *heavy)]
    assert proven.findings(table(extreme))["beyond_the_theorem"].holds is holds


@pytest.mark.parametrize(
    ("under", "holds"),
    [
        ([("survives", "survives"), ("overturns", "undecided")], True),
        ([("survives", "overturns"), ("overturns", "overturns")], False),
        ([("survives", "undecided")], False),
    ],
)
def test_no_proven_outcome_under_a_record_differs(under, holds):
    found = proven.findings(table(under=under))["reversals_under_records"]
    assert found.holds is holds
    assert found.entries["undecided"] == sum(end == "undecided" for _, end in under)


def test_reversed_pair_of_each_record_is_proven_at_its_own_scale(monkeypatch):
    asked = []

    def outcome(frame, record):
        asked.append((frame.mass_ratio, record.name))
        return Outcome("survives", 0)

    monkeypatch.setattr(proven, "outcome", outcome)
    rows = [("a", "c", gamma, gamma in (1.0, 4.0)) for gamma in (0.0, 1.0, 2.0, 4.0)]
    known = pd.DataFrame(rows, columns=["record", "structure", "mass_ratio", "overturned"])
    records = [Record(0.01, [0.0, 0.1, 0.0], "a")]
    found = list(proven.under_records(known, {"c": Column(0.5, 3.0)}, records))
    assert asked == [(0.0, "a"), (1.0, "a")]
    assert [row["by_solver"] for row in found] == ["survives", "overturns"]
