"""Steps of the kernel: series, pieces of a record, and roots of polynomials."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import polynomial

from tests.cases import BLOCK, BOTH, pulse_forcing
from topheavy import RockingBlock
from topheavy.ground.shapes import PULSE_SHAPES
from topheavy.kernel.bernstein import MAX_DEGREE, roots, to_bernstein
from topheavy.kernel.forcing import equation, ground
from topheavy.kernel.grid import record_order
from topheavy.kernel.quiet_pieces import derivatives, eighth_derivative
from topheavy.kernel.step import (
    HULL,
    POLYNOMIAL,
    PULSE_ORDER,
    ROOTS,
    STACK,
    TOLERANCE,
    working_array,
)
from topheavy.kernel.taylor import (
    MAX_ORDER,
    ROTATION,
    Method,
    State,
    expand,
    oscillator,
)

ORDER = MAX_ORDER


def state_of(block, motion, time, side, rotation, velocity):
    """A rocking state under a pulse, in the kernel's terms."""
    value, rate, _, _ = ground(motion, time)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(rotation), math.cos(rotation))
    push = -side * value - oscillator(block).uplift_level
    return State(time, side, rotation, velocity, sine, cosine, push, -side * rate, 1.0, 0.0)


def series(block, motion, time, state, is_straight=False, order=ORDER):
    w = working_array()
    method = Method(order, 1e-16, is_straight)
    expand(w, method, oscillator(block), state, equation(motion, time))
    return w


@BOTH
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_series_solves_the_equation_of_motion_as_it_is_printed(shape, side, block):
    motion, alpha = pulse_forcing(shape, 0.6, 2.5), block.slenderness
    start = 0.4 * min(motion.end, 6.0)
    straight = shape == "constant"
    state = state_of(block, motion, start, side, 0.1, -0.07)
    w = series(block, motion, start, state, straight)
    for step in (0.0, 0.01, 0.05, 0.1):
        phi = np.polynomial.polynomial.polyval(step, w[ROTATION, : ORDER + 1])
        bend = np.polynomial.polynomial.polyval(
            step, np.polynomial.polynomial.polyder(w[ROTATION, : ORDER + 1], 2)
        )
        a = ground(motion, start + step)[0]
        if block.linearised:
            expected = phi - alpha - side * a
        else:  # Eq. (23) for φ = |θ|, in units of p²
            expected = -(math.sin(alpha - phi) + side * a * math.cos(alpha - phi))
        assert bend == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize("step", [0.01, 0.05, 0.2])
def test_order_for_a_record_keeps_the_tolerance_of_the_second_derivative(step):
    motion, order = pulse_forcing("constant", 0.6, 2.5), record_order(step)
    w = series(BLOCK, motion, 0.3, state_of(BLOCK, motion, 0.3, -1.0, 0.1, -0.07), True)
    short, full = (
        polynomial.polyval(step, polynomial.polyder(w[ROTATION, : n + 1], 2))
        for n in (order, ORDER)
    )
    assert order < PULSE_ORDER
    assert abs(short - full) < TOLERANCE


few = settings(max_examples=60, deadline=None, derandomize=True, database=None)
ONE_METRE = oscillator(RockingBlock(1.0, 0.25, 0.9))


@few
@given(
    rotation=st.floats(0.01, 0.25),
    velocity=st.floats(-1.0, 1.0),
    push=st.floats(-2.0, 2.0),
    rate=st.floats(-50.0, 50.0),
)
def test_derivatives_are_those_of_the_recurrences(rotation, velocity, push, rate):
    alpha = ONE_METRE.slenderness
    sine, cosine = math.sin(rotation), math.cos(rotation)
    state = State(0.0, 1.0, rotation, velocity, sine, cosine, push, rate, 1.0, 0.0)
    w = working_array()
    expand(w, Method(8, 1e-16, True), ONE_METRE, state, (0.0, 0.0, 0.0))
    tilt, lean = math.cos(alpha - rotation), math.sin(alpha - rotation)
    force = math.sin(rotation) / math.cos(alpha) + push * tilt
    slope = math.cos(rotation) / math.cos(alpha) + push * lean
    terms = force, slope, rate * tilt, rate * lean, velocity
    ours = *derivatives(*terms), eighth_derivative(*terms)
    theirs = [w[ROTATION, n] * math.factorial(n) for n in range(3, 9)]
    size = (1 + abs(push) + abs(rate) + abs(velocity)) ** 6
    assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-13 * size)


def written(coefficients) -> tuple[np.ndarray, int]:
    """A working array that holds a polynomial, and its degree."""
    w, degree = working_array(), len(coefficients) - 1
    w[POLYNOMIAL, : degree + 1] = coefficients
    to_bernstein(w, POLYNOMIAL, degree, HULL)
    return w, degree


def found(coefficients, zero_order: int = 0, limit: int = MAX_DEGREE) -> np.ndarray:
    w, degree = written(coefficients)
    count = roots(w, POLYNOMIAL, zero_order, degree, HULL, STACK, ROOTS, limit)
    return w[ROOTS, :count].copy()


def test_every_crossing_of_a_long_step_is_found():
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
def test_all_simple_roots_are_isolated(places, zero_order):
    places = sorted(places)
    factors = polynomial.polymul(polynomial.polyfromroots(places), [1.0, 0.3, 0.7])
    result = found(np.concatenate([np.zeros(zero_order), factors]), zero_order)
    if min(np.diff([-1.0, *places])) > 2e-3:
        np.testing.assert_allclose(result, places, atol=1e-6)
    else:
        assert (len(places) - len(result)) % 2 == 0


@pytest.mark.parametrize("depth", [1e-6, 1e-10, 1e-14])
@pytest.mark.parametrize("place", [0.3721, 0.5, 0.01])
def test_a_grazing_impact_between_steps_is_not_missed(place, depth):
    """φ dips below zero within a sliver of the step; at both ends of it φ is positive."""
    result = found([place**2 - depth, -2 * place, 1.0])
    half = math.sqrt(depth)
    np.testing.assert_allclose(result, [place - half, place + half], atol=2e-9)


def test_root_however_close_to_the_start_is_found_to_its_last_digits():
    """As after an impact, when the next bounce is a millionth of the step."""
    for place in 10.0 ** -np.arange(1, 15):
        (root,) = found([0.0, place, -1.0, 0.1, 0.02], 1)
        assert root == pytest.approx(place + 0.1 * root**2 + 0.02 * root**3, rel=1e-14)
