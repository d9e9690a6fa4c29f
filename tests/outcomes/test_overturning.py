"""Overturning: maps of pulses and records, intervals and boundaries."""

import math

import numpy as np
import pytest

import topheavy as th
from tests.cases import fate
from topheavy.ground.shapes import FINITE_SHAPES
from topheavy.outcomes.search import SURVIVES, cases_of, intervals_of_many, outcomes_of_factors

BLOCK, COLUMN = th.RockingBlock(2.0, 0.25, 0.9), th.Column(0.5, 2.0)
LINEAR = th.RockingBlock(1.0, 0.25, 0.9, linearised=True)  # of Zhang & Makris (2001)
SINE = th.Pulse("one-sine", 0.25, angular_frequency=5.0)  # of amplitude αg
SHAKING = th.Record(0.02, 0.6 * np.sin(np.linspace(0.0, 40.0, 400)) * np.linspace(1.0, 0.2, 400))


# ---------------------------------------------------------------------------- maps


@pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
@pytest.mark.parametrize("shape", FINITE_SHAPES)
def test_each_cell_of_a_map_is_a_history(block, shape):
    frequencies = [2.5, 6.0, 13.0]
    amplitudes = block.uplift_acceleration * np.array([0.0, 0.9999, 1.01, 1.4, 2.5, 4.0, 9.0])
    outcomes = th.overturning_map(block, shape, frequencies, amplitudes)
    for (i, j), peak in np.ndenumerate(outcomes.peak_rotation.values):
        pulse = th.Pulse(shape, amplitudes[j], angular_frequency=frequencies[i])
        end, whole = th.judge(block, pulse), th.simulate(block, pulse, samples=2)
        cell = (bool(outcomes.overturned[i, j]), int(outcomes.number_of_impacts[i, j]))
        assert cell == fate(end) == fate(whole)
        close = pytest.approx(end.peak_rotation, rel=0, abs=1e-9 * block.slenderness, nan_ok=True)
        assert peak == close
        assert whole.peak_rotation == close
        assert math.isnan(peak) == cell[0]
    assert outcomes.overturned.any()
    assert not outcomes.peak_rotation[:, :2].any()


# ---------------------------------------------------------------------------- intervals

CASES = {
    "Zhang & Makris": (LINEAR, SINE, (1.0, 10.0), 0.05),
    "mirrored": (
        BLOCK,
        th.Pulse("ricker-symmetric", -0.25, angular_frequency=5.0),
        (-5.0, -1.0),
        0.01,
    ),
    "across zero": (BLOCK, SINE, (-6.0, 5.0), 0.02),
    "record": (
        *(BLOCK, th.Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90))),
        *((0.5, 6.0), 0.01),
    ),
}


@pytest.fixture(params=CASES.values(), ids=CASES.keys(), scope="module")
def case(request):
    block, excitation, scale_range, resolution = request.param
    intervals = th.overturning_intervals(block, excitation, scale_range, resolution=resolution)
    return block, excitation, scale_range, resolution, intervals


def last_of(interval, last):
    return (last, last) if interval.upper is None else interval.upper


def test_brackets_have_the_boundary_between_them(case):
    """Of the search's own outcomes, and of single histories to their tolerance."""
    block, excitation, (first, last), resolution, intervals = case
    cases = cases_of([block], excitation, (first, last))
    size = max(abs(first), abs(last))

    def label(scale):
        _, overturned, impacts = outcomes_of_factors(cases, np.zeros(1, int), np.array([scale]))
        return impacts[0] if overturned[0] else SURVIVES

    for interval in intervals:
        inside, outside = (interval.lower[1], last_of(interval, last)[0]), [interval.lower[0]]
        outside += [interval.upper[1]] if interval.upper else []
        assert {label(scale) for scale in inside} == {interval.number_of_impacts}
        assert all(x == first or label(x) != interval.number_of_impacts for x in outside)
        widths = [np.diff(ends)[0] for ends in (interval.lower, interval.upper) if ends]
        assert max(widths) <= max(1.01e-10 * size, resolution / 1024)
        for scale in (inside[0] + 1e-8 * size, inside[1] - 1e-8 * size):
            if inside[0] < scale < inside[1]:
                end = th.judge(block, excitation.scaled(scale))
                assert fate(end) == (True, interval.number_of_impacts)
    narrow = [i.lower[1] - i.lower[0] <= 1.01e-10 * size for i in intervals]
    assert sum(narrow) >= 0.5 * len(intervals)


def test_no_interval_wider_than_the_resolution_is_missed(case):
    """A scan five times as fine: runs of like outcome wider than the resolution are all there."""
    block, excitation, (first, last), resolution, intervals = case
    fine = np.linspace(first, last, 5 * math.ceil((last - first) / resolution) + 1)
    ends = [th.judge(block, excitation.scaled(scale)) for scale in fine]
    labels = [end.number_of_impacts if end.overturned else SURVIVES for end in ends]
    changes = np.flatnonzero(np.diff(labels)) + 1
    runs = zip([0, *changes], [*changes - 1, len(fine) - 1], strict=True)
    wide = [(a, b) for a, b in runs if fine[b] - fine[a] > resolution]
    assert len(wide) >= 2
    for a, b in wide:
        low, high = fine[a], fine[b]
        middle = [i for i in intervals if i.lower[0] < high and last_of(i, math.inf)[1] > low]
        if labels[a] == SURVIVES:  # only what is narrower than the resolution is wrongly labelled
            for i in middle:
                assert min(last_of(i, last)[0], high) - max(i.lower[1], low) <= 1e-9
        else:
            (holding,) = (i for i in middle if i.number_of_impacts == labels[a])
            assert holding.lower[0] <= low
            assert last_of(holding, math.inf)[1] >= high


def test_intervals_of_many_are_those_of_each_alone():
    """To the last bit, in their order; a finer search adds what lies below the first."""
    blocks = [BLOCK, LINEAR, COLUMN, BLOCK]
    motions = [
        SINE,
        SINE.scaled(0.9),
        SHAKING,
        th.Pulse("ricker-symmetric", 0.3, angular_frequency=6.0),
    ]
    settings, ends = {"resolution": 0.05, "most_impacts": 1}, (0.5, 6.0)
    several = intervals_of_many(blocks, motions, ends, **settings)
    for block, motion, intervals in zip(blocks, motions, several, strict=True):
        assert intervals == th.overturning_intervals(block, motion, ends, **settings)
    assert len({intervals[0].lower for intervals in several}) == 4
    below = 1.01 * min(intervals[0].lower[0] for intervals in several)
    finer = intervals_of_many(blocks, motions, ends, **settings, finer=(below, 0.001))
    for block, motion, coarse, united in zip(blocks, motions, several, finer, strict=True):
        first = coarse[0].lower[0]
        settings = {"resolution": 0.001, "most_impacts": 1}
        lower = th.overturning_intervals(block, motion, (0.5, first), **settings)
        assert united == (lower if first < below else []) + coarse


def test_factors_on_several_structures_have_the_outcomes_of_judge():
    several, factors = [COLUMN, BLOCK, LINEAR], np.linspace(0.2, 3.0, 23)
    outcomes = th.overturned_by(several, SHAKING, factors)
    for structure, row in zip(several, outcomes, strict=True):
        single = [th.judge(structure, SHAKING.scaled(factor)).overturned for factor in factors]
        assert row.tolist() == single == th.overturned_by(structure, SHAKING, factors).tolist()
    assert 0.2 < outcomes.mean() < 0.8
    peaks = th.peak_rotations(several, SHAKING, factors)
    for structure, row, overturned in zip(several, peaks, outcomes, strict=True):
        np.testing.assert_array_equal(np.isnan(row), overturned)
        np.testing.assert_array_equal(row, th.peak_rotations(structure, SHAKING, factors))
        expected = [th.judge(structure, SHAKING.scaled(factor)).peak_rotation for factor in factors]
        np.testing.assert_allclose(row, expected, rtol=0, atol=1e-8)


MINE = th.Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90), "mine")
PEAKS = np.array([0.0, 0.2, 0.26, 0.4, 0.6, 0.9, 1.4, 2.5])


#: A structure whose lengths are all multiplied, by the factor.
SIMILAR = {
    "block": lambda k: th.RockingBlock(COLUMN.frequency_parameter / math.sqrt(k), 0.25, 0.9),
    "frame": lambda k: th.RockingFrame(th.Column(0.5 * k, 2.0 * k), 1.5),
    "vase": lambda k: th.FixedMassColumn(th.Column(0.5 * k, 2.0 * k), 1.0, 1.2 * k, 0.4 * k),
    "portal": lambda k: th.MonolithicPortal(th.Column(0.5 * k, 2.0 * k), 1.0, 3.0 * k, 0.4 * k),
}


@pytest.mark.parametrize("similar", SIMILAR.values(), ids=SIMILAR)
def test_each_cell_is_the_history_of_a_similar_structure(similar):
    factors = np.array([0.3, 1.0, 2.0, 7.0])
    outcomes = th.overturning_map(similar(1.0), MINE, factors * COLUMN.size, PEAKS)
    assert outcomes.sizes == {"size": 4, "peak_acceleration": PEAKS.size}
    for i, k in enumerate(factors):
        structure = similar(k)
        p = structure.block().frequency_parameter
        assert float(outcomes.frequency_parameter[i]) == pytest.approx(p, rel=1e-14)
        for j, peak in enumerate(PEAKS):
            cell = outcomes.isel(size=i, peak_acceleration=j)
            end = th.judge(structure, MINE.scaled(peak / MINE.peak_acceleration))
            assert fate(cell) == fate(end)
            close = 1e-8 * structure.block().slenderness
            np.testing.assert_allclose(
                float(cell.peak_rotation), end.peak_rotation, rtol=0, atol=close
            )
    assert outcomes.overturned.any()
    assert (outcomes.overturned == np.isnan(outcomes.peak_rotation)).all()
    assert not outcomes.peak_rotation[:, 0].any()
