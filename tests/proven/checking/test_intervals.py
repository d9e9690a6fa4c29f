"""Interval arithmetic of the checker: rounded outward, and what it gives up."""

from fractions import Fraction
from itertools import product

import pytest
from flint import arb

from topheavy.proven.balls import precision
from topheavy.proven.checking import intervals
from topheavy.proven.checking.intervals import (
    Interval,
    arctangent,
    cosine,
    dot,
    exponential,
    of,
    sine,
)


@pytest.mark.parametrize("number", [-3, -1, 0, 1, 4, 30])
@pytest.mark.parametrize("width", [0, 7])
def test_functions_of_intervals_hold_those_of_the_numbers_inside(number, width):
    intervals.precision(90)
    x = Fraction(number) + Fraction(1, 3)
    interval = of(x).hull(of(x + Fraction(width, 100)))
    pairs = [(sine, arb.sin), (cosine, arb.cos)]
    if number >= 0:
        pairs += [(arctangent, arb.atan), (exponential, lambda y: (-y).exp())]
    with precision(200):
        for mine, true in pairs:
            found = mine(interval)
            for k in range(width + 1):
                y = x + Fraction(k, 100)
                scaled = true(arb(y.numerator) / y.denominator) * intervals.UNIT
                assert found.low <= scaled
                assert found.high >= scaled
            assert width or found.high - found.low < 2**12


def test_arithmetic_of_intervals_is_rounded_outward():
    intervals.precision(8)
    third, seventh = of(Fraction(1, 3)), of(Fraction(-1, 7))
    for found, true in (
        (third, Fraction(1, 3)),
        (third * seventh, Fraction(-1, 21)),
        (third / seventh, Fraction(-7, 3)),
        (third / -3, Fraction(-1, 9)),
        (third - seventh, Fraction(10, 21)),
        ((third * third).root(), Fraction(1, 3)),
        (Interval(-5, 3).size(), Fraction(5, 256)),
    ):
        assert Fraction(found.low, 256) <= true <= Fraction(found.high, 256)
        assert found.high - found.low < 40


def test_sum_of_products_has_the_ends_of_its_corners_whatever_their_signs():
    intervals.precision(0)
    spans = [Interval(a, b) for a in range(-2, 3) for b in range(a, 3)]
    for x, y in product(spans, spans):
        corners = [p * q for p in (x.low, x.high) for q in (y.low, y.high)]
        for found in (x * y, dot([x, of(1), of(9)], [y, of(0)])):
            assert (found.low, found.high) == (min(corners), max(corners))
