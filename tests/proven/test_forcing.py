"""The ground motion in balls: values, complete series, ranges, and the first uplift."""

from itertools import pairwise

import numpy as np
import pytest

from topheavy import Pulse, Record
from topheavy.ground.shapes import ENDING
from topheavy.proven.balls import arb, exact, power, precision
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


def test_range_contains_all_samples_on_the_way_and_the_rest_behind_the_end():
    forcing = prepared(RECORD)
    inside = forcing.range(1, arb("1.5"), arb("2.5"))
    assert inside.contains(exact(-0.3))
    assert not inside.contains(exact(0.2))
    assert prepared(Record(0.02, [0.1, 0.2, 0.3])).range(0, arb("0.5"), arb(2)).contains(0)
    behind = prepared(Pulse("constant", 0.4, 1.0)).range(0, arb(3), arb(4))
    assert behind.contains(0)
    assert behind.contains(exact(0.4))
