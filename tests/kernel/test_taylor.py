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
    ROTATION,
    State,
    evaluate,
    expand,
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
