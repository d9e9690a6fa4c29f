"""Segments of ground motion: where they cross a level, and that motions consist of them."""

import math

import numpy as np
import pytest

from tests.cases import RECORDS, SIDES
from topheavy import PULSE_SHAPES, Pulse, Record, RockingBlock, read_at2, simulate
from topheavy.ground.excitation import Segment, still


def line(start, stop, first, last):
    return Segment(start, stop, lambda t: first + (last - first) * (t - start) / (stop - start))


# ---------------------------------------------------------------------------- uplift


@SIDES
@pytest.mark.parametrize("level", [1e-9, 0.2, 0.7, 0.999999])
def test_uplift_is_where_the_level_is_crossed(side, level):
    sine = Segment(0.0, math.pi / 2, lambda t: side * math.sin(t))
    assert sine.uplift(0.0, level) == pytest.approx(math.asin(level), rel=1e-14)


@SIDES
@pytest.mark.parametrize(("first", "at"), [(0.0, 3.0), (0.25, 1.0)])
def test_ground_that_only_reaches_the_level_lifts_nothing(side, first, at):
    ground = line(1.0, 3.0, side * first, side * 0.25)
    assert ground.uplift(1.0, 0.25) is None
    assert ground.uplift(1.0, math.nextafter(0.25, 0.0)) == pytest.approx(at, rel=1e-14)


@pytest.mark.parametrize(
    ("ends", "since", "level", "at"),
    [
        *(((-0.5, 0.0), 0.2, 0.3, 0.2), ((0.5, 2.0), 0.2, 0.3, 0.2)),  # beyond it: at once
        # below the level from 0.2 to 0.8
        *(((-0.5, 0.5), 0.0, 0.3, 0.0), ((-0.5, 0.5), 0.25, 0.3, 0.8)),
        # not before the time asked from, and at the crossing itself
        *(((0.0, 1.0), 0.5, 0.5, 0.5), ((0.0, 1.0), 0.6, 0.5, 0.6)),
    ],
)
def test_ground_beyond_the_level_lifts_at_once_and_where_it_rises_beyond_it_again(
    ends, since, level, at
):
    assert line(0.0, 1.0, *ends).uplift(since, level) == pytest.approx(at, rel=1e-14)


# ---------------------------------------------------------------------------- falls_below


@SIDES
@pytest.mark.parametrize(
    ("first", "last", "since", "at"),
    [
        # against the side on which the block stands
        *((0.6, 0.2, 0.0, 1.5), (0.2, 0.6, 0.0, 2.0)),
        # a push that stays up does so to the stop
        *((*ends, 0.0, 2.0) for ends in ((0.3, 0.6), (0.6, 0.3), (0.3, 0.3), (0.4, 0.4))),
        # one that retreats from the level ends where it starts, or is below it already
        *((0.3, 0.1, 0.0, 0.0), (0.3, 0.1, 0.5, 0.5), (0.6, 0.2, 1.8, 1.8)),
        # a rounding below the level, as after an uplift whose instant was found by a root
        (math.nextafter(0.3, 0.0), 0.6, 0.0, 2.0),
        (0.5, -1.5, 0.0, 0.2),  # at the level, not at zero
    ],
)
def test_push_ends_where_it_falls_below_the_level(side, first, last, since, at):
    ground = line(0.0, 2.0, -side * first, -side * last)
    assert ground.falls_below(since, int(side), 0.3) == pytest.approx(at, rel=1e-13)


def test_push_of_a_constant_acceleration_never_falls():
    assert Pulse("constant", 0.3, 2.0).segments(9.0)[0].falls_below(0.0, -1, 0.3) == math.pi / 2


def test_push_that_rounding_leaves_below_the_level_has_ended():
    # The line to the third sample ends 2e-16 above it, and the level lies between the two.
    level = 0.467 + (0.242 - 0.467) / 0.1 * (5 * 0.1 - 4 * 0.1)
    assert level > 0.242
    assert line(0.0, 1.0, 0.242, 0.242).falls_below(0.0, -1, level) == 0.0
    assert line(0.0, 1.0, 0.1, 0.2).falls_below(0.0, -1, level) == 0.0
    record = Record(0.1, np.array([0.0, 0.0, 0.0, 0.0, 0.467, 0.242, 0.242, 0.0]))
    response = simulate(RockingBlock(2.0, level, 0.9, linearised=True), record, samples=2)
    assert response.peak_rotation > 0.0


# ---------------------------------------------------------------------------- largest


@pytest.mark.parametrize(
    ("start", "stop", "largest"),
    [
        *((1.0, 3.0, 0.5), (0.0, 9.0, 0.5), (1.5, 2.0, 0.25)),  # all of it, more, a part
        *((2.5, 9.0, 0.5), (0.0, 1.5, 0.5)),  # over an end
        *((2.0, 2.0, 0.0), (3.0, 4.0, 0.5)),  # an instant, its last one
        *((3.5, 4.0, 0.0), (0.0, 0.5, 0.0)),  # behind it and before
    ],
)
def test_largest_is_over_the_overlap_alone(start, stop, largest):
    through = line(1.0, 3.0, -0.5, 0.5)
    assert through.largest(start, stop) == pytest.approx(largest, abs=1e-15)
    assert still(0.0) == still(-3.0) == still(1e9) == 0.0


def test_least_gravity_of_a_segment_is_that_of_its_lower_end():
    for low, high in ((0.5, 1.5), (1.5, 0.5)):
        segment = Segment(0.0, 1.0, lambda t: 0.0, lambda t, a=low, b=high: a + (b - a) * t)
        found = [segment.least_gravity(*over) for over in ((-1.0, 2.0), (0.0, 0.5), (2.0, 3.0))]
        assert found == [0.5, min(low, 1.0), 1.0]


# ---------------------------------------------------------------------------- whole motions


def without_gap(segments, end):
    edges = [segments[0].start, *(segment.stop for segment in segments)]
    assert (edges[0], edges[-1]) == (0.0, pytest.approx(end, rel=1e-14))
    assert [segment.start for segment in segments] == edges[:-1]
    return segments


@pytest.mark.parametrize("shape", PULSE_SHAPES)
@pytest.mark.parametrize("amplitude", [0.4, -0.4])
@pytest.mark.parametrize("share", [1.0, 0.61, 0.05])
def test_segments_of_a_pulse_have_no_gap_follow_it_and_are_monotone(shape, amplitude, share):
    pulse = Pulse(shape, amplitude, 2.7)
    end = share * (pulse.duration if math.isfinite(pulse.duration) else 7.3 * math.pi)
    for segment in without_gap(pulse.segments(end), end):
        times = np.linspace(segment.start, segment.stop, 1001)
        found = np.array([segment.acceleration(t) for t in times])
        np.testing.assert_allclose(found, pulse.excitation(times), rtol=1e-14, atol=1e-15)
        steps, rounding = np.diff(found), 4e-16
        assert np.all(steps >= -rounding) or np.all(steps <= rounding)
    if math.isfinite(pulse.duration):  # they reach no further
        assert pulse.segments(99.0) == pulse.segments(pulse.duration)


@pytest.mark.parametrize("until", [math.inf, 20.0, 3.14159])
def test_segments_of_a_record_have_no_gap_and_follow_it(until):
    record = read_at2(RECORDS / "el_centro_1940_NS.AT2")
    segments = without_gap(record.segments(until), min(until, record.duration))
    middles = [(segment.start + segment.stop) / 2 for segment in segments]
    found = [segment.acceleration(t) for segment, t in zip(segments, middles, strict=True)]
    np.testing.assert_allclose(found, record.excitation(middles), atol=1e-13)
