"""Roots of a step polynomial: none that is there is missed, none that is not is found."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import polynomial

from topheavy.kernel.bernstein import (
    MAX_DEGREE,
    roots,
    to_bernstein,
)
from topheavy.kernel.outcome import HULL, POLYNOMIAL, ROOTS, STACK, working_array


def written(coefficients) -> tuple[np.ndarray, int]:
    """A working array that holds a polynomial, and its degree."""
    w, degree = working_array(), len(coefficients) - 1
    w[POLYNOMIAL, : degree + 1] = coefficients
    to_bernstein(w, POLYNOMIAL, degree, HULL)
    return w, degree


def found(coefficients, zeros: int = 0, limit: int = MAX_DEGREE) -> np.ndarray:
    w, degree = written(coefficients)
    count = roots(w, POLYNOMIAL, zeros, degree, HULL, STACK, ROOTS, limit)
    return w[ROOTS, :count].copy()


def test_way_2_every_crossing_of_a_long_step_is_found():
    """Three crossings between samples of which hardly any would show them."""
    places = [0.31, 0.33, 0.62]
    coefficients = -polynomial.polyfromroots(places)
    np.testing.assert_allclose(found(coefficients), places, atol=1e-13)
    np.testing.assert_allclose(found(coefficients, limit=1), places[:1], atol=1e-13)
    np.testing.assert_allclose(found(coefficients, limit=2), places[:2], atol=1e-13)


@settings(max_examples=60, deadline=None, derandomize=True, database=None)
@given(
    st.lists(st.floats(0.01, 0.99), min_size=1, max_size=6, unique_by=lambda x: round(x, 2)),
    st.integers(0, 3),
)
def test_way_2_all_simple_roots_are_isolated(places, zeros):
    places = sorted(places)
    factors = polynomial.polymul(polynomial.polyfromroots(places), [1.0, 0.3, 0.7])
    result = found(np.concatenate([np.zeros(zeros), factors]), zeros)
    if min(np.diff([-1.0, *places])) > 2e-3:
        np.testing.assert_allclose(result, places, atol=1e-6)
    else:
        assert (len(places) - len(result)) % 2 == 0


@pytest.mark.parametrize("depth", [1e-6, 1e-10, 1e-14])
@pytest.mark.parametrize("place", [0.3721, 0.5, 0.01])
def test_way_3_a_grazing_impact_between_steps_is_not_missed(place, depth):
    """φ dips below zero within a sliver of the step; at both ends of it φ is positive."""
    result = found([place**2 - depth, -2 * place, 1.0])
    half = math.sqrt(depth)
    np.testing.assert_allclose(result, [place - half, place + half], atol=2e-9)


def test_way_4_root_however_close_to_the_start_is_found_to_its_last_digits():
    """As after an impact, when the next bounce is a millionth of the step."""
    for place in 10.0 ** -np.arange(1, 15):
        (root,) = found([0.0, place, -1.0, 0.1, 0.02], 1)
        assert root == pytest.approx(place + 0.1 * root**2 + 0.02 * root**3, rel=1e-14)
