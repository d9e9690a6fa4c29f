"""Balls: exact decimals, bounds outward, roots enclosed, and python-flint only where it is used."""

import subprocess
import sys
from fractions import Fraction

import pytest

from topheavy.proven.balls import Undecided, arb, bounds, exact, power, precision, root


def test_float_stands_for_the_decimal_that_it_is_printed_as():
    with precision(200):
        assert (exact(0.1) - arb(1) / 10).contains(0)
        assert exact(0.1).rad() < arb(2) ** -190


@pytest.mark.parametrize("number", ["0.1", "-0.1", "0.7", "3.3", "-2.7"])
def test_bounds_are_not_inside_the_ball(number):
    with precision(200):  # in 53 bits the ball's own ends are floats already
        low, high = bounds(arb(number))
    assert Fraction(low) < Fraction(number) < Fraction(high)


def test_ball_that_is_no_number_has_no_bounds():
    with pytest.raises(Undecided, match="enclosure"):
        bounds(arb(-1).sqrt())


@pytest.mark.parametrize("sign", [1, -1])
def test_root_is_enclosed_to_the_last_digits_even_near_a_zero_of_the_slope(sign):
    found = root(
        lambda x: sign * (power(x, 3) - exact(1e-6)), lambda x: sign * 3 * x * x, arb(-1), arb(1)
    )
    assert found.contains(exact(0.01))
    assert found.rad() < 1e-9


@pytest.mark.parametrize("ends", [(0.0, "middle"), ("middle", 7.0)])
def test_root_is_the_one_between_the_ends_where_a_ball_of_them_has_two(ends):
    gap = arb(2) ** -40  # of two zeros; a ball's radius has 30 bits
    low, high = (1 + gap / 2 if end == "middle" else arb(end) for end in ends)
    found = root(lambda x: (x - 1) * (x - 1 - gap), lambda x: 2 * x - 2 - gap, low, high)
    assert (found.contains(1), found.contains(1 + gap)) == (high < 2, low > 0)


def test_ends_of_one_sign_are_undecided():
    with pytest.raises(Undecided, match="root"):
        root(lambda x: x * x - 2, lambda x: 2 * x, arb(-3), arb(3))


def run(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_library_imports_no_flint_until_something_is_proven():
    assert run("import sys, topheavy; sys.exit('flint' in sys.modules)").returncode == 0
