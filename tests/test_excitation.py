"""Segments of ground motion: where they cross a level, and that motions consist of them."""

import math
from pathlib import Path

import numpy as np
import pytest

from topheavy import PULSE_SHAPES, Pulse, Record, RockingBlock, read_at2, simulate
from topheavy.excitation import Segment, still

RECORDS = Path(__file__).parents[1] / "data" / "records"


def line(start: float, stop: float, first: float, last: float) -> Segment:
    return Segment(start, stop, lambda t: first + (last - first) * (t - start) / (stop - start))


def sine(amplitude: float) -> Segment:
    return Segment(0.0, math.pi / 2, lambda t: amplitude * math.sin(t))


# ---------------------------------------------------------------------------- uplift


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("level", [1e-9, 0.2, 0.7, 0.999999])
def test_uplift_is_where_the_level_is_crossed(sign, level):
    assert sine(sign).uplift(0.0, level) == pytest.approx(math.asin(level), rel=1e-14)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_ground_that_only_reaches_the_level_lifts_nothing(sign):
    rising = line(1.0, 3.0, 0.0, sign * 0.25)
    assert rising.uplift(1.0, 0.25) is None
    assert rising.uplift(1.0, math.nextafter(0.25, 0.0)) == pytest.approx(3.0, rel=1e-14)
    level = line(1.0, 3.0, sign * 0.25, sign * 0.25)
    assert level.uplift(1.0, 0.25) is None
    assert level.uplift(1.0, math.nextafter(0.25, 0.0)) == 1.0


def test_ground_beyond_the_level_lifts_at_once():
    assert line(0.0, 2.0, -0.5, 0.0).uplift(0.4, 0.3) == 0.4
    assert line(0.0, 2.0, 0.5, 2.0).uplift(0.4, 0.3) == 0.4


def test_ground_that_falls_below_the_level_and_rises_beyond_it_again_lifts_there():
    through = line(0.0, 1.0, -0.5, 0.5)  # below the level from 0.2 to 0.8
    assert through.uplift(0.0, 0.3) == 0.0
    assert through.uplift(0.25, 0.3) == pytest.approx(0.8, rel=1e-14)


def test_uplift_is_not_before_the_time_asked_from():
    rising = line(0.0, 1.0, 0.0, 1.0)
    assert rising.uplift(0.5, 0.5) == 0.5  # at the crossing itself
    assert rising.uplift(0.6, 0.5) == 0.6


# ---------------------------------------------------------------------------- falls_below


@pytest.mark.parametrize("side", [1, -1])
def test_push_is_against_the_side_on_which_the_block_stands(side):
    falling = line(0.0, 2.0, -side * 0.6, -side * 0.2)
    assert falling.falls_below(0.0, side, 0.3) == pytest.approx(1.5, rel=1e-14)
    rising = line(0.0, 2.0, -side * 0.2, -side * 0.6)
    assert rising.falls_below(0.0, side, 0.3) == 2.0


@pytest.mark.parametrize("side", [1, -1])
def test_push_that_stays_up_does_so_to_the_stop(side):
    for first, last in ((0.3, 0.6), (0.6, 0.3), (0.3, 0.3), (0.4, 0.4)):
        lasting = line(0.0, 2.0, -side * first, -side * last)
        assert lasting.falls_below(0.0, side, 0.3) == 2.0


@pytest.mark.parametrize("side", [1, -1])
def test_push_that_retreats_from_the_level_ends_where_it_starts(side):
    falling = line(0.0, 2.0, -side * 0.3, -side * 0.1)
    assert falling.falls_below(0.0, side, 0.3) == 0.0
    assert falling.falls_below(0.5, side, 0.3) == 0.5  # is below it already
    through = line(0.0, 2.0, -side * 0.6, -side * 0.2)
    assert through.falls_below(1.8, side, 0.3) == 1.8


@pytest.mark.parametrize("side", [1, -1])
def test_push_that_starts_a_rounding_below_the_level_and_grows_has_not_ended(side):
    # As after an uplift whose instant was found by a root.
    start = math.nextafter(0.3, 0.0)
    assert line(0.0, 2.0, -side * start, -side * 0.6).falls_below(0.0, side, 0.3) == 2.0


def test_push_of_a_constant_acceleration_never_falls():
    assert Pulse("constant", 0.3, 2.0).segments(9.0)[0].falls_below(0.0, -1, 0.3) == math.pi / 2


def test_push_that_changes_its_sign_ends_at_the_level_not_at_zero():
    assert line(0.0, 1.0, 0.5, -0.5).falls_below(0.0, -1, 0.3) == pytest.approx(0.2, rel=1e-13)


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
        (1.0, 3.0, 0.5),  # all of it
        (0.0, 9.0, 0.5),  # and more
        (1.5, 2.0, 0.25),  # a part
        (2.5, 9.0, 0.5),  # over the stop
        (0.0, 1.5, 0.5),  # over the start
        (2.0, 2.0, 0.0),  # one instant
        (3.0, 4.0, 0.5),  # its last instant
        (3.5, 4.0, 0.0),  # behind it
        (0.0, 0.5, 0.0),  # before it
    ],
)
def test_largest_is_over_the_overlap_alone(start, stop, largest):
    through = line(1.0, 3.0, -0.5, 0.5)
    assert through.largest(start, stop) == pytest.approx(largest, abs=1e-15)


def test_ground_at_rest_is_still_at_any_time():
    assert still(0.0) == still(-3.0) == still(1e9) == 0.0


# ---------------------------------------------------------------------------- whole motions


def spans(pulse: Pulse, share: float):
    whole = pulse.duration if math.isfinite(pulse.duration) else 7.3 * math.pi
    return pulse.segments(share * whole), share * whole


@pytest.mark.parametrize("shape", PULSE_SHAPES)
@pytest.mark.parametrize("amplitude", [0.4, -0.4])
@pytest.mark.parametrize("share", [1.0, 0.61, 0.05])
def test_segments_of_a_pulse_have_no_gap_and_follow_it(shape, amplitude, share):
    pulse = Pulse(shape, amplitude, 2.7)
    segments, end = spans(pulse, share)
    edges = [segments[0].start, *(segment.stop for segment in segments)]
    assert edges[0] == 0.0
    assert edges[-1] == end
    assert [segment.start for segment in segments] == edges[:-1]
    for segment in segments:
        for time in np.linspace(segment.start, segment.stop, 7):
            expected = pytest.approx(pulse.excitation(time), rel=1e-14, abs=0.0)
            assert segment.acceleration(time) == expected


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_segments_of_a_pulse_are_monotone(shape):
    for segment in spans(Pulse(shape, 0.4, 2.7), 1.0)[0]:
        times = np.linspace(segment.start, segment.stop, 4001)
        steps = np.diff([segment.acceleration(t) for t in times])
        rounding = 4e-16
        assert np.all(steps >= -rounding) or np.all(steps <= rounding)


def test_segments_reach_no_further_than_the_pulse():
    pulse = Pulse("one-sine", 0.4, 2.7)
    assert pulse.segments(99.0) == pulse.segments(pulse.duration)
    assert pulse.segments(99.0)[-1].stop == pulse.duration


@pytest.mark.parametrize("until", [math.inf, 20.0, 3.14159])
def test_segments_of_a_record_have_no_gap_and_follow_it(until):
    record = read_at2(RECORDS / "el_centro_1940_NS.AT2")
    segments = record.segments(until)
    edges = [segments[0].start, *(segment.stop for segment in segments)]
    assert edges[0] == 0.0
    assert edges[-1] == pytest.approx(min(until, record.duration), rel=1e-14)
    assert [segment.start for segment in segments] == edges[:-1]
    middles = [(segment.start + segment.stop) / 2 for segment in segments]
    found = [segment.acceleration(t) for segment, t in zip(segments, middles, strict=True)]
    np.testing.assert_allclose(found, record.excitation(middles), atol=1e-13)


def test_least_gravity_of_a_segment_is_that_of_its_lower_end():
    for low, high in ((0.5, 1.5), (1.5, 0.5)):
        segment = Segment(0.0, 1.0, lambda t: 0.0, lambda t, a=low, b=high: a + (b - a) * t)
        assert segment.least_gravity(-1.0, 2.0) == 0.5
        assert segment.least_gravity(0.0, 0.5) == min(low, 1.0)
        assert segment.least_gravity(2.0, 3.0) == 1.0
