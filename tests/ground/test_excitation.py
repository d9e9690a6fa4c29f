"""Segments of ground motion: where they cross a level, and that motions consist of them."""

import math

import numpy as np
import pytest

from tests.cases import SIDES
from topheavy import PULSE_SHAPES, Pulse
from topheavy.ground.excitation import Segment, still


def line(start, stop, first, last):
    return Segment(start, stop, lambda t: first + (last - first) * (t - start) / (stop - start))


# ---------------------------------------------------------------------------- uplift


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
