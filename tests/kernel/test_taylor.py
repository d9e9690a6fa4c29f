"""The Taylor series of a step: it solves Eq. (23) as printed, and starts without cancellation."""

import math

import numpy as np
import pytest

from topheavy import RockingBlock
from topheavy.kernel import forcing
from topheavy.kernel.forcing import NO_RECORD, SHAPES, equation, ground, next_uplift, pulse_forcing
from topheavy.kernel.outcome import PULSE_ORDER, working_array
from topheavy.kernel.taylor import (
    MAX_ORDER,
    PUSH,
    ROTATION,
    VELOCITY,
    State,
    evaluate,
    expand,
    longest_step,
    oscillator,
)

BLOCK = RockingBlock(2.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
ORDER = MAX_ORDER


def state_of(block, motion, time, side, rotation, velocity):
    """A rocking state under a pulse, in the kernel's terms."""
    value, rate = ground(motion, NO_RECORD, time)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(rotation), math.cos(rotation))
    push = -side * value - oscillator(block).level
    return State(rotation, velocity, sine, cosine, push, -side * rate)


def series(block, motion, time, state, is_straight=False, order=ORDER):
    w = working_array()
    expand(w, order, oscillator(block), state, *equation(motion, time), is_straight)
    return w


def test_oscillator_holds_the_threshold_of_each_equation():
    exact, linear = oscillator(BLOCK), oscillator(BLOCK.linear())
    assert exact.level == BLOCK.uplift_acceleration == math.tan(0.25)
    assert linear.level == BLOCK.linear().uplift_acceleration == 0.25
    assert (exact.cosine, exact.sine) == (math.cos(0.25), math.sin(0.25))
    assert (linear.cosine, linear.sine, linear.flat) == (1.0, 0.0, math.inf)
    assert exact.flat == math.pi / 2
    assert exact.restitution == 0.9


@BOTH
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("shape", sorted(SHAPES))
def test_series_solves_the_equation_of_motion_as_it_is_printed(shape, side, block):
    motion, alpha = pulse_forcing(SHAPES[shape], 0.6, 2.5), block.slenderness
    start = 0.4 * min(motion.end, 6.0)
    straight = shape == "constant"
    state = state_of(block, motion, start, side, 0.1, -0.07)
    w = series(block, motion, start, state, straight)
    for step in (0.0, 0.01, 0.05, 0.1):
        phi = np.polynomial.polynomial.polyval(step, w[ROTATION, : ORDER + 1])
        bend = np.polynomial.polynomial.polyval(
            step, np.polynomial.polynomial.polyder(w[ROTATION, : ORDER + 1], 2)
        )
        a = ground(motion, NO_RECORD, start + step)[0]
        if block.linearised:
            expected = phi - alpha - side * a
        else:  # Eq. (23) for φ = |θ|, in units of p²
            expected = -(math.sin(alpha - phi) + side * a * math.cos(alpha - phi))
        assert bend == pytest.approx(expected, abs=1e-11)


@BOTH
@pytest.mark.parametrize("shape", sorted(SHAPES))
def test_state_at_the_end_of_a_step_is_of_one_piece(shape, block):
    motion = pulse_forcing(SHAPES[shape], 0.6, 2.5)
    start, step = 0.4 * min(motion.end, 6.0), 0.08
    straight = shape == "constant"
    state = state_of(block, motion, start, 1.0, 0.1, -0.07)
    there = evaluate(
        series(block, motion, start, state, straight), ORDER, oscillator(block), step, straight
    )
    value, rate = ground(motion, NO_RECORD, start + step)
    assert there.push == pytest.approx(-value - oscillator(block).level, abs=1e-13)
    assert there.rate == pytest.approx(-rate, abs=1e-11)
    expected = (0.0, 1.0)
    if not block.linearised:
        expected = (math.sin(there.rotation), math.cos(there.rotation))
    assert (there.sine, there.cosine) == pytest.approx(expected, abs=1e-14)
    w = series(block, motion, start, state, straight)
    slope = np.polynomial.polynomial.polyder(w[ROTATION, : ORDER + 1])
    assert there.velocity == pytest.approx(np.polynomial.polynomial.polyval(step, slope), abs=1e-13)
    np.testing.assert_allclose(slope, w[VELOCITY, :ORDER], rtol=1e-14)


@BOTH
@pytest.mark.parametrize("order", [5, 8, 15, 20])
def test_straight_push_is_the_curved_one_without_curvature(block, order):
    motion = forcing.Forcing(forcing.RECORD, 1.0, 1.0, 9.0, 1.0)
    state = State(0.1, -0.07, math.sin(0.1), math.cos(0.1), -0.1, 0.3)
    if block.linearised:
        state = state._replace(sine=0.0, cosine=1.0)
    straight, curved = (
        series(block, motion, 0.0, state, is_straight, order) for is_straight in (True, False)
    )
    used = straight[: VELOCITY + 1, :order]
    np.testing.assert_allclose(used, curved[: VELOCITY + 1, :order], rtol=1e-13, atol=1e-18)
    np.testing.assert_array_equal(curved[PUSH, 2:order], 0.0)
    for is_straight, w in ((True, straight), (False, curved)):
        there = evaluate(w, order, oscillator(block), 0.2, is_straight)
        assert there.push == pytest.approx(-0.04, abs=1e-15)
        assert there.rate == pytest.approx(0.3, rel=1e-15)


def test_linearised_series_is_that_of_the_hyperbolic_functions():
    state = State(0.1, -0.07, 0.0, 1.0, -0.2, 0.0)
    still = forcing.Forcing(forcing.NONE, 0.0, 1.0, 0.0, 1.0)
    w = series(BLOCK.linear(), still, 0.0, state, True)
    there = evaluate(w, ORDER, oscillator(BLOCK.linear()), 0.7, True)
    expected = 0.2 + (0.1 - 0.2) * math.cosh(0.7) - 0.07 * math.sinh(0.7)
    assert there.rotation == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("order", [6, 9, 12])
def test_error_of_a_step_falls_with_the_order_of_the_series(order):
    motion = pulse_forcing(forcing.ONE_SINE, 0.6, 2.5)
    state = state_of(BLOCK, motion, 0.3, -1.0, 0.1, -0.07)
    errors = []
    for step in (0.4, 0.2):
        short, full = (
            evaluate(series(BLOCK, motion, 0.3, state, order=n), n, oscillator(BLOCK), step, False)
            for n in (order, ORDER)
        )
        errors.append(abs(short.rotation - full.rotation))
    assert math.log2(errors[0] / errors[1]) == pytest.approx(order + 1, abs=0.7)


@pytest.mark.parametrize("degrees", [0.1, 3, 5, 8, 14, 20, 35, 80])
@pytest.mark.parametrize("linearised", [False, True])
def test_way_1_uplift_starts_outward_however_slight_the_push(degrees, linearised):
    """At |a| = tan α the first coefficients cancel: grouped otherwise, their sign is chance."""
    block = RockingBlock(2.0, math.radians(degrees), 0.9, linearised)
    level, cosine = block.uplift_acceleration, oscillator(block).cosine
    for excess in (1e-9, 1e-6, 1e-3, 0.5, 5.0, 1e3):
        for shape in (forcing.ONE_SINE, forcing.RICKER_SYMMETRIC, forcing.RICKER_ANTISYMMETRIC):
            pulse = pulse_forcing(shape, level * (1 + excess), 1.7)
            time, push, rate, _ = next_uplift(pulse, NO_RECORD, 0.0, level)
            if time == math.inf:
                continue
            w = series(block, pulse, time, State(0.0, 0.0, 0.0, 1.0, push, rate), order=PULSE_ORDER)
            assert not w[ROTATION, :3].any()
            assert w[ROTATION, 3] == pytest.approx(rate * cosine / 6)
            assert w[ROTATION, 3] > 0.0


# ---------------------------------------------------------------------------- step length


@pytest.mark.parametrize("tolerance", [1e-6, 1e-10, 1e-14])
@pytest.mark.parametrize("shape", [forcing.ONE_SINE, forcing.RICKER_ANTISYMMETRIC])
def test_last_two_terms_of_a_step_are_below_the_tolerance_and_no_shorter_than_that(
    shape, tolerance
):
    motion = pulse_forcing(shape, 0.6, 2.5)
    for time in np.linspace(0.1, 0.9, 9) * motion.end:
        w = series(BLOCK, motion, time, state_of(BLOCK, motion, time, 1.0, 0.1, 0.2))
        step = longest_step(w, ORDER, tolerance, 1e9)
        terms = abs(w[VELOCITY, ORDER - 2 : ORDER]) * step ** np.arange(ORDER - 2, ORDER)
        assert max(terms) == pytest.approx(tolerance, rel=1e-10)
        assert longest_step(w, ORDER, tolerance, 0.5 * step) == 0.5 * step
        assert longest_step(w, ORDER, tolerance, 1.01 * step) == pytest.approx(step)


def test_series_of_nothing_allows_any_step():
    w = working_array()
    assert longest_step(w, ORDER, 1e-12, 7.0) == 7.0
    w[VELOCITY, ORDER - 1] = 1e-300  # every other term may vanish
    assert longest_step(w, ORDER, 1e-12, 1e9) == 1e9
    w[VELOCITY, ORDER - 1], w[VELOCITY, ORDER - 2] = 0.0, 1.0
    assert longest_step(w, ORDER, 1e-18, 7.0) == pytest.approx(1e-18 ** (1 / 18))
    w[VELOCITY, ORDER - 1], w[VELOCITY, ORDER - 2] = 1.0, 0.0
    assert longest_step(w, ORDER, 1e-19, 7.0) == pytest.approx(0.1)
