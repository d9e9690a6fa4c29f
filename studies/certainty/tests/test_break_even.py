"""Where the benefit of the cap beam ends: sets, limits, and each condition of the findings."""

import math

import numpy as np
import pandas as pd
import pytest

from studies.certainty.changed import COLUMN, FRAME, columns, subjects
from studies.certainty.rated import stated
from studies.certainty.steps import break_even, break_even_pulses, break_even_shard
from studies.certainty.steps.restitution import HIGHEST
from studies.certainty.tests.test_rates import COLUMN as TEMPLE
from studies.certainty.tests.test_rates import ENSEMBLE
from topheavy import Pulse, RockingFrame, overturned_by
from topheavy.synthetic.ensemble import first_draws

CASE = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "sizes": [1.0, 2.0],
    "mass_ratios": [1e-12, 4.0],
    "deficits": {"highest": 1.0, "step": 0.25},
    "raises": {"highest": 0.15, "step": 0.02},
    "run": "default",
    "runs": {"default": {"shards": 2, "motions": 4}},
    "pgv": [0.6, 1.0],
    "scaled": [0.8],
    "bootstrap": {"resamples": 100, "confidence": 0.95},
    "seed": 31,
    "checked": 4,
    "measured": [0.03, 0.05],
}
PULSES = {
    "column": CASE["column"],
    "mass_ratios": [1e-12, 2.0],
    "amplitudes": {"highest": 16.0, "resolution": 0.01},
    "deficit": {"step": 0.05, "bracket": 1e-3},
}


@pytest.fixture(scope="module")
def groups():
    found = [break_even_shard.main(CASE, ENSEMBLE, shard) for shard in ("1-of-2", "2-of-2")]
    return list(break_even.groups(pd.concat(found, ignore_index=True), CASE, ENSEMBLE))


# Structures and gains -----------------------------------------------------------------------------


def test_changed_restitutions_end_at_none_and_at_all():
    small, large = columns(CASE)
    assert large == type(small)(1.0, 6.0)
    under = subjects(small, CASE)
    own = small.restitution
    lowered = [one.block.restitution for one in under if one.mass_ratio == 0.0]
    assert lowered == pytest.approx([own, 0.75 * own, 0.5 * own, 0.25 * own, 0.0])
    assert under[0].block == small.block()
    for gamma in CASE["mass_ratios"]:
        some = [one for one in under if one.mass_ratio == gamma]
        frame = RockingFrame(small, gamma)
        assert some[0].block == frame.block()
        assert some[-1].block.restitution == pytest.approx(HIGHEST)
        for one in some:
            assert one.block.restitution == pytest.approx((1.0 + one.change) * frame.restitution)
    wide = subjects(small, CASE | {"raises": {"highest": 0.02, "step": 0.01}})
    assert [one.change for one in wide[-3:]] == pytest.approx([0.0, 0.01, 0.02])


def test_gain_is_the_difference_of_the_counts(groups):
    """Also in the limits: a frame without a cap beam gains nothing, a column is gained on as is."""
    assert [(one.family, one.under[0].height) for one in groups] == [
        (family, height) for height in (6.0, 12.0) for family in ENSEMBLE["families"]
    ]
    group = groups[0]
    table = break_even.gains(group, CASE)
    records = [d.record() for d in first_draws(ENSEMBLE, 4) if d.family == group.family]
    pgvs = np.array([pgv for *_, pgv in stated(group.column, CASE)])

    def share(structure):
        fell = [
            overturned_by(structure, one, np.array(pgvs) / one.peak_velocity) for one in records
        ]
        return np.mean(fell, axis=0)

    own, frame = TEMPLE.block(), RockingFrame(TEMPLE, 4.0).block()
    for way, change, column, other in (
        (COLUMN, 0.0, own, frame),
        (COLUMN, 0.25, own.with_restitution(0.75 * own.restitution), frame),
        (FRAME, 0.04, own, frame.with_restitution(1.04 * frame.restitution)),
    ):
        rows = table[(table.way == way) & (table.change == change) & (table.mass_ratio == 4.0)]
        assert rows.gain.tolist() == pytest.approx(share(column) - share(other))
        assert ((rows.gain_low <= rows.gain) & (rows.gain <= rows.gain_high)).all()
    without = table[(table.mass_ratio < 1.0) & (table.change == 0.0)]
    assert (without[["gain", "gain_low", "gain_high"]] == 0.0).all(axis=None)
    assert share(own).any()


def test_gain_is_resampled_within_each_earthquake(groups):
    """All columns overturn in one, and none in the other: the gain over no frame is one half."""
    group, column = groups[0], [one.mass_ratio == 0.0 for one in groups[0].under]
    first = group.motions.scenario.to_numpy() == 0
    fell = np.broadcast_to((first[:, None] & column)[..., None], group.fell.shape)
    table = break_even.gains(group._replace(fell=fell), CASE)
    assert (table[["gain", "gain_low", "gain_high"]] == 0.5).all(axis=None)


def test_scipy_has_to_find_the_sampled_outcomes(groups):
    assert break_even.confirmed(groups, CASE, ENSEMBLE).holds
    wrong = [one._replace(fell=~one.fell) for one in groups]
    assert not break_even.confirmed(wrong, CASE, ENSEMBLE).holds


# Sets ---------------------------------------------------------------------------------------------

WORDS = {"+": "is positive", "-": "is negative", "0": "includes zero"}


def sets(*signs, way=COLUMN):
    """The sets of comparisons whose interval is positive, undecided or negative at each change."""
    rows = [
        dict(zip(break_even.KEYS, ("a", 6.0, float(number), way, "PGV", 0.6), strict=True))
        | {"change": change / 100, "restitution": 0.9, "column": 0.5, "frame": 0.4}
        | {"interval": WORDS[sign]}
        for number, each in enumerate(signs)
        for change, sign in enumerate(each)
    ]
    return break_even.break_even(pd.DataFrame(rows))


@pytest.mark.parametrize(
    ("signs", "lowest", "highest", "until", "undecided", "connected"),
    [
        ("++00-", 0.02, 0.03, 0.02, 2, True),
        ("+0+0-", 0.01, 0.03, 0.01, 2, False),
        ("+0-0-", 0.01, 0.03, 0.01, 2, False),
        ("++---", math.nan, math.nan, 0.02, 0, True),
        ("+++++", math.nan, math.nan, math.nan, 0, True),
        ("00000", 0.0, 0.04, 0.0, 5, True),
    ],
)
def test_set_of_undecided_changes(signs, lowest, highest, until, undecided, connected):
    (row,) = sets(signs).itertuples()
    found = (row.lowest, row.highest, row.until)
    assert found == pytest.approx((lowest, highest, until), nan_ok=True)
    assert (row.undecided, row.connected, row.largest) == (undecided, connected, 0.04)
    assert (row.unchanged, row.changed_most) == (WORDS[signs[0]], WORDS[signs[-1]])


@pytest.mark.parametrize(
    ("signs", "broken"),
    [
        (("++0-", "00--"), set()),  # where the frame is not safer at first, nothing is asked
        (("++0-", "++++"), {"ends"}),
        (("++0-", "+0+-"), set()),
        (("++0-", "+0+0-"), {"connected"}),
        (("00--",), {"ends", "connected"}),
    ],
)
def test_what_the_sets_decide(signs, broken):
    lowered = break_even.findings(sets(*signs))
    found = {"ends": lowered["deficit_ends_the_benefit"]}
    found["connected"] = lowered["undecided_deficits_are_connected"]
    assert {name for name, one in found.items() if not one.holds} == broken
    raised = break_even.findings(sets(*signs, way=FRAME))["raise_ends_the_benefit"]
    assert raised.holds is ("ends" not in broken)
    assert not break_even.findings(sets(*signs, way=FRAME))["deficit_ends_the_benefit"].holds


def test_benefit_remains_up_to_a_deficit():
    table = sets("+++0-", "++++-", "00---")
    assert break_even.remains(table, 0.02).holds
    assert not break_even.remains(table, 0.03).holds
    assert break_even.remains(table, 0.03)["kept"] == 1
    assert not break_even.remains(sets("++---"), 0.02).holds  # it reverses without an undecided one
    assert not break_even.remains(sets("00---"), 0.0).holds  # nothing to remain


# Pulses -------------------------------------------------------------------------------------------


def under(shape, ratio):
    pulse = Pulse(shape, TEMPLE.uplift_acceleration, ratio * TEMPLE.frequency_parameter)
    rows = break_even_pulses.compared(TEMPLE, pulse, PULSES)
    assert all(row["by_scipy"] for row in rows)
    return pulse, *rows


def test_minima_are_equal_between_the_deficits():
    pulse, same, row = under("one-cosine", 2.7)
    assert same["kind"] == break_even_pulses.NOT_ABOVE  # a frame without a cap beam is its column
    assert same["frame"] == pytest.approx(same["column"], rel=1e-9)
    assert row["kind"] == break_even_pulses.EQUAL
    assert row["deficit_high"] - row["deficit_low"] <= 1e-3
    assert row["column_low"] < row["frame"] <= row["column_high"]
    block, scales = TEMPLE.block(), np.linspace(1.0, row["frame"], 2000)
    for end, falls in (("low", True), ("high", False)):
        lower = block.with_restitution((1.0 - row[f"deficit_{end}"]) * block.restitution)
        assert overturned_by(lower, pulse, scales).any() == falls


def test_scipy_has_to_find_a_minimum_on_both_sides():
    pulse = Pulse("one-cosine", TEMPLE.uplift_acceleration, 2.0 * TEMPLE.frequency_parameter)
    minima = break_even_pulses.Minima(TEMPLE, pulse, PULSES)
    found = minima.of(TEMPLE)
    sides = [minima.by_scipy(TEMPLE, place * found) for place in (0.999, 1.0, 1.001)]
    assert sides == [False, True, False]


def test_no_restitution_matters_under_a_pulse_of_one_lobe():
    """Theorem 3: it overturns without an impact, and the frame from a higher amplitude on."""
    _, _, row = under("half-sine", 3.0)
    assert row["kind"] == break_even_pulses.ONCE
    assert row["without_impact"] == row["column_low"] == row["column_high"] < row["frame"]


def test_column_that_loses_all_may_still_overturn_first():
    _, _, row = under("ricker-antisymmetric", 3.0)
    assert row["kind"] == break_even_pulses.RESTED
    assert row["rested"] < row["frame"] < row["without_impact"]


@pytest.mark.parametrize(
    ("change", "broken"),
    [
        ({}, set()),
        ({"kind": break_even_pulses.ONCE, "deficit_low": math.nan}, {"deficit_exists"}),
        ({"kind": break_even_pulses.BEYOND, "deficit_low": math.nan}, set()),
        ({"deficit_low": 0.04}, {"deficit_exceeds_measured"}),
        (
            {"kind": break_even_pulses.NOT_ABOVE, "deficit_low": math.nan},
            {"deficit_exists", "deficit_exceeds_measured"},
        ),
        ({"kind": break_even_pulses.ONCE, "rested": 1.5, "deficit_low": 9.0}, {"deficit_exists"}),
        ({"by_scipy": False}, {"minima_by_scipy"}),
    ],
)
def test_one_pulse_is_enough_to_refute(change, broken):
    row = {"mass_ratio": 1.0, "kind": break_even_pulses.EQUAL, "by_scipy": True, "changes": 1}
    row |= {"deficit_low": 0.1, "deficit_high": 0.101, "frame": 2.0, "column_high": 2.001}
    row |= {"rested": 3.0}
    table = pd.DataFrame([row, row | change])
    found = break_even_pulses.findings(table)
    found["deficit_exceeds_measured"] = break_even_pulses.beyond(table, 0.05)
    assert {name for name, one in found.items() if not one.holds} == broken
    rests_longer = change.get("rested") == 1.5 or "deficit_exists" not in broken
    assert found["deficit_exists"].holds_when is rests_longer
