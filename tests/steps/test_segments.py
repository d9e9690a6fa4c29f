"""Segments of a pulse: where a push ends, and the largest push of a part."""

import math

import pytest

from steps.shared.segments import Segment, sign_change


def line(start, stop, first, last):
    return Segment(start, stop, lambda t: first + (last - first) * (t - start) / (stop - start))


@pytest.mark.parametrize("side", [-1, 1])
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
    assert ground.falls_below(since, side, 0.3) == pytest.approx(at, rel=1e-13)


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


def test_root_that_no_interpolation_helps_to_find():
    assert sign_change(lambda t: math.copysign(1.0, t - 1e-60), 0.0, 1.0) == pytest.approx(1e-60)
