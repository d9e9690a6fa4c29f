"""Roots of a step polynomial: none that is there is missed, none that is not is found."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import polynomial

from topheavy.kernel.bernstein import (
    MAX_DEGREE,
    MAX_DEPTH,
    first_sign,
    halve,
    isolated_root,
    roots,
    sign_changes,
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


def test_bernstein_form_has_the_same_values():
    w, degree = written([0.3, -1.2, 0.7, 2.5, -0.4])
    for x in (0.0, 0.2, 0.77, 1.0):
        basis = [math.comb(degree, i) * x**i * (1 - x) ** (degree - i) for i in range(degree + 1)]
        expected = polynomial.polyval(x, w[POLYNOMIAL, : degree + 1])
        assert basis @ w[HULL, : degree + 1] == pytest.approx(expected, abs=1e-14)


def test_halves_are_the_polynomial_on_either_side_of_the_middle():
    w, degree = written([0.3, -1.2, 0.7, 2.5, -0.4])
    halve(w, HULL, STACK, degree)
    for row, start in ((STACK, 0.0), (HULL, 0.5)):
        x = np.linspace(0.0, 1.0, 9)
        basis = np.array([math.comb(4, i) * x**i * (1 - x) ** (4 - i) for i in range(5)])
        expected = polynomial.polyval(start + x / 2, w[POLYNOMIAL, : degree + 1])
        np.testing.assert_allclose(w[row, : degree + 1] @ basis, expected, atol=1e-14)


def test_zeros_have_no_sign():
    w = working_array()
    w[HULL, :6] = [0.0, -1.0, 0.0, 0.0, 2.0, 0.0]
    assert sign_changes(w, HULL, 0, 5) == 1
    assert sign_changes(w, HULL, 2, 5) == 0
    assert first_sign(w, HULL, 0, 5) == -1.0
    assert first_sign(w, HULL, 2, 5) == 1.0
    assert first_sign(w, HULL, 5, 5) == 1.0


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


@pytest.mark.parametrize("place", [0.3721, 0.25])
def test_touch_is_no_crossing(place):
    assert found([place**2 + 1e-13, -2 * place, 1.0]).size == 0
    assert found(polynomial.polyfromroots([place + 1e-5j, place - 1e-5j]).real).size == 0
    assert found([0.0625, -0.5, 1.0]).size == 0  # (x − ¼)², exactly


def test_root_at_the_very_middle_of_a_part_is_found_once():
    np.testing.assert_allclose(found(polynomial.polyfromroots([0.5])), [0.5])
    np.testing.assert_allclose(
        found(polynomial.polyfromroots([0.25, 0.5, 0.75])), [0.25, 0.5, 0.75], atol=1e-15
    )
    np.testing.assert_allclose(
        found(-polynomial.polyfromroots([0.5, 0.625])), [0.5, 0.625], atol=1e-15
    )


def test_roots_outside_the_step_are_none_of_its_own():
    assert found(polynomial.polyfromroots([-0.2, 1.1, 1.3])).size == 0
    np.testing.assert_allclose(found(polynomial.polyfromroots([-0.2, 0.4, 1.3])), [0.4])


@pytest.mark.parametrize("zeros", [1, 2, 3])
def test_root_at_the_start_is_divided_out(zeros):
    lead = np.zeros(zeros)
    np.testing.assert_allclose(found([*lead, 0.3, -1.0], zeros), [0.3], rtol=1e-15)
    assert found([*lead, 0.3, 1.0], zeros).size == 0
    np.testing.assert_allclose(
        found([*lead, *polynomial.polyfromroots([0.2, 0.9])], zeros), [0.2, 0.9], rtol=1e-13
    )


def test_way_4_root_however_close_to_the_start_is_found_to_its_last_digits():
    """As after an impact, when the next bounce is a millionth of the step."""
    for place in 10.0 ** -np.arange(1, 15):
        (root,) = found([0.0, place, -1.0, 0.1, 0.02], 1)
        assert root == pytest.approx(place + 0.1 * root**2 + 0.02 * root**3, rel=1e-14)


def test_newton_that_leaves_the_part_is_called_back():
    # steep on one side, flat on the other
    coefficients = polynomial.polysub(polynomial.polypow([0.0, 1.0], 15), [1e-9])
    w, degree = written(coefficients)
    root = isolated_root(w, POLYNOMIAL, 0, degree, 0.0, 1.0, -1.0)
    assert root == pytest.approx(1e-9 ** (1 / 15), rel=1e-14)


def test_many_close_roots_stay_within_the_stack():
    places = 0.3 + 1e-3 * np.arange(4)
    result = found(polynomial.polymul(polynomial.polyfromroots(places), [1.0] * 10))
    np.testing.assert_allclose(result, places, atol=1e-5)
    assert working_array().shape == (STACK + MAX_DEPTH + 1, MAX_DEGREE + 3)
