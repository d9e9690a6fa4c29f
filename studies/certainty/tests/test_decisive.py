"""Cases in which each decisive result of the study is false, or a step would be wrong."""

import math

import numpy as np
import pandas as pd
import pytest

import topheavy
from steps.shared import sweep
from studies.certainty.shapes import FAMILIES, record, single_lobe
from studies.certainty.steps import benefit, extensions, intensities, lowest, restitution, theorem
from studies.certainty.under import HIGHEST, changed, factored, supported
from topheavy import Column, FixedMassColumn, Record, RockingFrame, judge, reference
from topheavy.synthetic.ensemble import Draw

COLUMN = Column(0.5, 3.0)
SIZES = {"half_width": 0.5, "half_height": 3.0}


# No reversal without an impact -------------------------------------------------------------------


def counts(*contradictions):
    return pd.DataFrame({"motions": 1, "contradictions": contradictions})


def test_one_contradiction_refutes_the_theorem():
    assert theorem.counted(counts(0, 0))["holds"]
    assert not theorem.counted(counts(0, 1))["holds"]
    assert not theorem.counted(counts())["holds"]


def test_frames_in_the_wrong_order_contradict_the_theorem():
    """With the lighter frame taken for the heavier, many trials contradict."""
    random, found = np.random.default_rng(4), 0
    for _ in range(60):
        if (one := theorem.trial(random, True)) is not None:
            swapped = theorem.Trial(one.heavier, one.lighter, one.motion)
            assert theorem.at_once(one.lighter, one.motion)
            assert theorem.is_ahead(one)
            found += not theorem.is_ahead(swapped)
    assert found > 20


def test_tiny_bounce_is_an_impact():
    """A spike that lifts the column hardly, and later a pulse that overturns it."""
    level = COLUMN.uplift_acceleration
    samples = np.zeros(400)
    samples[10] = -level * 1.0002
    samples[50:] = 3.0 * level
    shaken = Record(0.01, samples)
    found = judge(COLUMN, shaken)
    assert found.overturned
    assert found.impacts == 0
    assert not theorem.at_once(COLUMN.block(), shaken)
    samples[10] = 0.0
    assert theorem.at_once(COLUMN.block(), Record(0.01, samples))


def test_theorem_covers_what_its_conditions_say():
    block = RockingFrame(COLUMN, 1.0).block()
    for inward, proved in ((0.5, True), (0.9, False)):
        samples = np.repeat([0.0, 1.5, -inward, 0.0], 40)
        one = theorem.Trial(COLUMN.block(), block, Record(0.002, samples))
        assert theorem.peaks(one) == pytest.approx((1.5, inward))
        assert theorem.is_proved(one) is (1.5 * inward < 1.0) is proved
    linear = theorem.Trial(COLUMN.block().linear(), block.linear(), Record(0.002, samples))
    assert theorem.is_proved(linear)


def test_all_shapes_have_the_stated_peak():
    random = np.random.default_rng(1)
    for make in FAMILIES:
        shape = record(make(random), 5.0, COLUMN, make.__name__)
        assert shape.peak_acceleration == pytest.approx(COLUMN.uplift_acceleration)
        assert shape.duration * COLUMN.frequency_parameter == pytest.approx(5.0)


# Minimum overturning acceleration ----------------------------------------------------------------


def test_single_lobe_rises_once_and_falls_once():
    random = np.random.default_rng(2)
    for _ in range(50):
        change = np.sign(np.diff(np.concatenate([[0.0], single_lobe(random), [0.0]])))
        change = change[change != 0.0]
        assert np.count_nonzero(np.diff(change)) == 1
        assert change[0] == 1.0


LOBES = {
    "mass_ratios": [0.0, 1.0, math.inf],
    "lobes": {
        "seed": 7,
        "pulses": 4,
        "slendernesses": [5.0, 20.0],
        "lowest": 1.0,
        "highest": 8.0,
        "resolution": 0.05,
    },
}


def test_second_lobe_is_an_exception(monkeypatch):
    assert lowest.single_lobes(LOBES, 3e-12)["holds"]
    two = [np.array([1.0, 0.0, -1.0])] * 4
    monkeypatch.setattr(lowest, "single_lobe", lambda random: two.pop())
    found = lowest.single_lobes(LOBES, 3e-12)
    assert not found["holds"]
    assert found["exceptions"] > 0


SEARCH = {
    "column": SIZES,
    "mass_ratios": [0.0, math.inf],
    "search": {
        "seed": 1,
        "trials": 400,
        "values": 8,
        "highest": 6.0,
        "steps": [0.0001, 0.002, 0.05],
    },
}


def test_fall_on_the_coarse_grid_alone_is_apparent():
    rows, found = lowest.search(SEARCH)
    assert found["holds"]
    assert found["apparent"] == len(rows) > 0
    assert all(row["coarse"] < 1.0 <= row["last"] for row in rows)


def test_fall_on_all_grids_is_found():
    """With the heavier frame first, the minimum falls for nearly every shape."""
    case = SEARCH | {"mass_ratios": [math.inf, 0.0]}
    case["search"] = case["search"] | {"trials": 20}
    _, found = lowest.search(case)
    assert not found["holds"]
    assert found["confirmed"] > 5


# Extensions --------------------------------------------------------------------------------------

SIMILAR = {"column": SIZES, "mass_ratios": [0.0, 4.0], "similarity": {"seed": 3, "pulses": 60}}


def test_frame_with_the_columns_restitution_is_not_similar(monkeypatch):
    assert extensions._of_similar(extensions.similar(SIMILAR)).holds
    own = Column.block
    monkeypatch.setattr(Column, "block", lambda self, restitution=None: own(self))
    assert not extensions._of_similar(extensions.similar(SIMILAR)).holds


def test_stability_is_not_shown_by_pulses_of_several_lobes():
    case = SIMILAR | {"similarity": {"seed": 24, "pulses": 400}}
    found = extensions._of_lobes(extensions.shows_stability(case))
    assert not found["holds"]
    assert found["holds_when"]
    assert found["only_the_frame"] > 0


def test_both_components_keep_their_common_time():
    across = Record(0.01, np.concatenate([np.zeros(300), np.ones(100), np.zeros(300)]))
    up = Record(0.01, np.arange(700.0) / 1000.0)
    one, other = extensions.strongest(across, up, 1.5)
    start = np.flatnonzero(one.acceleration)[0]
    assert other.acceleration[start] == pytest.approx(0.300)


# The impact law ----------------------------------------------------------------------------------


def shaken(random, values):
    return record(random.uniform(-1.0, 1.0, values), random.uniform(2.0, 20.0), COLUMN)


def test_equal_restitutions_are_those_of_the_block():
    random, frame = np.random.default_rng(3), RockingFrame(COLUMN, 1.0)
    for _ in range(100):
        motion = shaken(random, 8).scaled(random.uniform(1.0, 8.0))
        equal = judge(frame, motion, restitutions=[frame.restitution] * 60)
        assert equal.overturned == judge(frame, motion).overturned


def test_each_impact_has_its_own_restitution():
    """Some motions overturn the column, and not if its second impact takes all its speed."""
    random, differ = np.random.default_rng(5), 0
    for _ in range(60):
        motion = shaken(random, 10).scaled(random.uniform(1.5, 4.0))
        stated = []
        for row in ([0.95, 0.95, 0.95], [0.95, 0.0, 0.95]):
            ours, scipys = (
                of.judge(COLUMN, motion, restitutions=row) for of in (topheavy, reference)
            )
            assert (ours.overturned, ours.impacts) == (scipys.overturned, scipys.impacts)
            stated.append(ours.overturned)
        differ += stated[0] != stated[1]
    assert differ > 2


def test_bounces_too_low_to_be_told_apart_take_no_restitution():
    """A train of them comes before the rotation whose impact decides."""
    ground = np.concatenate(
        [np.tile([0.2, 0.2, -0.2, -0.2], 20), [0.0] * 10, [0.5] * 12, [-0.5] * 8]
    )
    motion = Record(0.05, ground)
    for row in ([0.99] * 3 + [0.0] * 200, [0.0] + [0.99] * 200):
        ours, scipys = (of.judge(COLUMN, motion, restitutions=row) for of in (topheavy, reference))
        assert ours.overturned == scipys.overturned
        assert ours.impacts == scipys.impacts < judge(COLUMN, motion).impacts


def test_library_takes_its_own_restitution_where_none_is_given():
    motion = record(np.array([1.0, -1.0, 0.8, -0.9]), 12.0, COLUMN).scaled(2.0)
    for of in (topheavy, reference):
        assert repr(of.judge(COLUMN, motion, restitutions=[])) == repr(of.judge(COLUMN, motion))
        with pytest.raises(ValueError, match=r"restitutions is 1\.2"):
            of.judge(COLUMN, motion, restitutions=[1.2])


def test_factor_never_brings_restitution_above_the_highest():
    own = COLUMN.block()
    assert changed(own, 1.05).restitution == HIGHEST == 0.995
    assert changed(own, 0.9).restitution == pytest.approx(0.9 * own.restitution)
    assert changed(own, 1.0) == own


def test_factors_are_applied_to_column_and_frame_as_named():
    found = restitution.pairs([0.9, 1.0])
    assert found["both", 0.9] == (0.9, 0.9)
    assert found["frame alone", 0.9] == (1.0, 0.9)
    assert found["column alone", 0.9] == (0.9, 1.0)


PULSES = {
    "slendernesses": [14.0],
    "shapes": ["one-sine"],
    "frequency_ratios": {"lowest": 2.0, "highest": 6.0, "points": 5},
    "amplitudes": {"lowest": 1.0, "highest": 10.0, "resolution": 0.05, "finer": 0.0005},
    "levels": 501,
    "factors": [0.7, 1.0],
}


def test_lowered_restitution_of_the_column_alone_reverses_the_order():
    table = restitution.under_pulses(PULSES).set_index(["way", "factor"])
    assert table.falls["both", 1.0] == table.falls["both", 0.7] == 0
    assert table.falls["column alone", 0.7] > 0
    assert table.harms["column alone", 0.7] > table.harms["both", 0.7]
    assert table.helps["frame alone", 0.7] > table.helps["both", 1.0]


BENEFIT = {"column": SIZES, "mass_ratio": 1.0, "factors": [0.9, 1.0], "pgv": 0.6, "motions": 1}


def test_restitution_is_lowered_of_both_or_of_one_alone():
    own = RockingFrame(COLUMN, 1.0)
    found = {one.labels["structure"]: one.block for one in factored(BENEFIT).subjects}
    for (way, factor), (column, frame) in benefit.compared([0.9, 1.0]).items():
        lowered = 1.0 if way == "frame alone" else factor
        assert found[column].restitution == pytest.approx(lowered * COLUMN.restitution)
        lowered = 1.0 if way == "column alone" else factor
        assert found[frame].restitution == pytest.approx(lowered * own.restitution)
    assert found["frame"] == own.block()
    ways = [("both", 0.9), ("both", 1.0), ("column alone", 0.9), ("frame alone", 0.9)]
    assert list(benefit.compared([0.9, 1.0])) == ways


# Stated intensities ------------------------------------------------------------------------------


STRUCTURES = {"temple": SIZES}


def test_supports_carry_the_same_mass():
    case = {"columns": [{"structure": "temple", "scaled": 2.0, "mass_ratio": 1.5}]}
    asked = supported(case | {"pgv": [0.4], "motions": 1}, STRUCTURES, "pgv").subjects
    column = Column(1.0, 6.0)
    same = column, RockingFrame(column, 1.5), FixedMassColumn(column, 1.5)
    assert [one.block for one in asked] == [one.block() for one in same]
    assert {one.labels["structure"] for one in asked} == {"12 m temple"}
    assert [one.labels["support"] for one in asked] == ["bare", "free", "fixed"]


def test_ample_stability_needs_the_upper_end_of_the_interval():
    asked = sweep.Asked([sweep.Subject({"support": "free"}, COLUMN.block())], np.array([0.6]), 30)
    draws = [Draw("a", 0, number, 0, None) for number in range(30)]
    swept = sweep.Swept(draws, np.ones(30), np.zeros((30, 1, 1), dtype=bool))
    table = intensities.probabilities({"pgv": (asked, swept)}, ["a"], 0.95)
    assert table.probability.item() == 0.0
    assert intensities.worst(table) > 0.1  # thirty survivors do not show 10 %
