"""The ground motion in balls: values, complete series, ranges, and the first uplift."""

import math
from itertools import pairwise

import numpy as np
import pytest

from topheavy import Pulse, Record
from topheavy.ground.shapes import ENDING
from topheavy.proven.balls import Undecided, arb, exact, hull, power, precision
from topheavy.proven.forcing import prepared

SHAPES = pytest.mark.parametrize("shape", ENDING)
RECORD = Record(0.02, [0.01, 0.05, -0.3, 0.2, 0.0])


@SHAPES
def test_values_are_those_of_the_pulse(shape):
    pulse = Pulse(shape, 0.7, 3.0)
    forcing = prepared(pulse)
    (piece,) = forcing.pieces
    assert abs(float(piece.stop) - 3.0 * pulse.duration) < 1e-14
    for time in np.linspace(0.0, pulse.duration, 31):
        value = float(forcing.value(piece, exact(3.0) * exact(time)))
        assert value == pytest.approx(pulse.excitation(time), abs=1e-14)


@SHAPES
def test_series_has_all_its_terms(shape):
    """Its sum at a distance is the value there: a series cut short is off by a finite amount."""
    with precision(200):
        forcing = prepared(Pulse(shape, 0.7, 3.0))
        (piece,) = forcing.pieces
        for sigma in (arb("0.1"), arb("1.3"), piece.stop / 2):
            terms = forcing.series(piece, sigma, 60)
            step = arb("0.6")
            total = sum((x * power(step, k) for k, x in enumerate(terms)), arb(0))
            assert abs(total - forcing.value(piece, sigma + step)) < 1e-25


@SHAPES
def test_slope_is_zero_at_the_turns_and_nowhere_else(shape):
    forcing = prepared(Pulse(shape, 1.0, 1.0))
    (piece,) = forcing.pieces
    edges = [float(x) for x in (piece.start, *piece.turns, piece.stop)]
    for turn in piece.turns:
        assert forcing.series(piece, turn, 2)[1].contains(0)
    if shape == "constant":
        return
    for low, high in pairwise(edges):
        inside = np.linspace(low, high, 41)[1:-1]
        signs = {float(forcing.series(piece, arb(x), 2)[1]) > 0 for x in inside}
        assert len(signs) == 1


def test_record_is_linear_between_its_samples_and_largest_from_a_piece_on():
    forcing = prepared(RECORD)
    for number, first in enumerate(RECORD.acceleration[:-1]):
        piece, second = forcing.pieces[number], RECORD.acceleration[number + 1]
        middle = forcing.value(piece, arb(number) + arb("0.5"))
        assert (middle - (exact(first) + exact(second)) / 2).contains(0)
    assert [float(forcing.largest(k)) for k in range(4)] == pytest.approx([0.3, 0.3, 0.3, 0.2])


def test_range_contains_all_samples_on_the_way_and_the_rest_behind_the_end():
    forcing = prepared(RECORD)
    inside = forcing.range(1, arb("1.5"), arb("2.5"))
    assert inside.contains(exact(-0.3))
    assert not inside.contains(exact(0.2))
    assert prepared(Record(0.02, [0.1, 0.2, 0.3])).range(0, arb("0.5"), arb(2)).contains(0)
    behind = prepared(Pulse("constant", 0.4, 1.0)).range(0, arb(3), arb(4))
    assert behind.contains(0)
    assert behind.contains(exact(0.4))


def test_uplift_is_where_the_acceleration_reaches_the_level():
    forcing = prepared(Pulse("one-sine", 0.5, 2.0))
    sigma, sign, jumps = forcing.uplift(forcing.pieces[0], arb(-1), arb("0.25"), arb(0))
    assert (sigma - arb.pi() / 6).contains(0)
    assert sigma.rad() < 1e-14
    assert (sign, jumps) == (-1, False)


def test_ricker_pulse_lifts_first_in_a_side_lobe():
    forcing = prepared(Pulse("ricker-symmetric", 1.0, 1.0))
    sigma, sign, _ = forcing.uplift(forcing.pieces[0], arb(1), arb("0.4"), arb(0))
    assert sign == -1
    assert sigma < forcing.pieces[0].turns[0]
    sigma, sign, _ = forcing.uplift(forcing.pieces[0], arb(1), arb("0.5"), arb(0))
    assert sign == 1
    assert abs(forcing.value(forcing.pieces[0], sigma) - arb("0.5")) < 1e-12


def test_jump_lifts_at_once_and_a_lower_one_later_or_not():
    forcing = prepared(Pulse("one-cosine", 1.0, 1.0))
    lift = forcing.uplift(forcing.pieces[0], arb(1), arb("0.9"), arb(0))
    assert (float(lift[0]), *lift[1:]) == (0.0, 1, True)
    assert forcing.uplift(forcing.pieces[0], arb("0.8"), arb("0.9"), arb(0)) is None


def test_acceleration_that_may_just_reach_the_level_is_undecided():
    forcing = prepared(Pulse("one-sine", 1.0, 1.0))
    for factor in (arb(1), hull(0.9, 1.1)):
        with pytest.raises(Undecided, match="uplift"):
            forcing.uplift(forcing.pieces[0], factor, arb(1), arb(0))


def test_endless_pulse_is_refused():
    with pytest.raises(ValueError, match="'harmonic' goes on forever"):
        prepared(Pulse("harmonic", 1.0, 1.0))
    assert math.isinf(Pulse("harmonic", 1.0, 1.0).duration)
