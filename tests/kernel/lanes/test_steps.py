"""Steps in lanes are those of the scalar kernel, each lane with a history of its own."""

import math

import numpy as np
import pytest
from numba import njit

from topheavy import RockingBlock
from topheavy.kernel.forcing import (
    CONSTANT,
    ONE_COSINE,
    ONE_SINE,
    RICKER_SYMMETRIC,
    equation,
    ground,
    pulse_forcing,
)
from topheavy.kernel.lanes import steps
from topheavy.kernel.lanes.vectors import WIDTH, among, bits, load, rows, store
from topheavy.kernel.outcome import PULSE_ORDER, TOLERANCE, working_array
from topheavy.kernel.taylor import COSINE, PUSH, ROTATION, SINE, VELOCITY, State, expand, oscillator

BLOCK = oscillator(RockingBlock(1.0, 0.25, 0.9))
LINEAR = oscillator(RockingBlock(1.0, 0.25, 0.9, linearised=True))
BOTH = pytest.mark.parametrize("block", [BLOCK, LINEAR], ids=["exact", "linearised"])
ALL = (1 << WIDTH) - 1
RECORD = np.empty((3, 0))


@njit
def step(w, v, block, is_straight):
    block = steps.seated(w, block)
    landed, fallen = steps.advance(w, v, block, PULSE_ORDER, TOLERANCE, is_straight, False, ALL)
    length = w[steps.LENGTH].copy()
    series = w[: 7 * (steps.MAX_ORDER + 1)].copy()
    steps.finish(w, block, PULSE_ORDER, ALL)
    return landed, fallen, length, series


def states(shape, seed, *, on_ground=False, block=BLOCK):
    """Pulses, times and states of as many random rocking blocks as there are lanes."""
    rng, found = np.random.default_rng(seed), []
    while len(found) < WIDTH:
        pulse = pulse_forcing(shape, rng.uniform(0.3, 2.0), rng.uniform(0.5, 8.0))
        time, side = rng.uniform(0.0, 0.9 * pulse.end), rng.choice([-1.0, 1.0])
        rotation = 0.0 if on_ground else rng.uniform(0.001, 1.6) * block.slenderness
        velocity = 10 ** rng.uniform(-6, -0.3) if on_ground else rng.uniform(-0.6, 0.6)
        sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(rotation), math.cos(rotation))
        value, rate = ground(pulse, RECORD, time)
        push = -side * value - block.level
        state = State(rotation, velocity, sine, cosine, push, -side * rate)
        found.append((pulse, time, side, state))
    return found


def filled(cases, block=BLOCK):
    """The working array with a lane for each state."""
    w = rows(steps.ROWS)
    for lane, (pulse, time, side, state) in enumerate(cases):
        steps.still(w, lane)
        steps.seat(w, lane, block)
        steps.lift(w, lane, time, state.push, state.rate, side, pulse.amplitude)
        w[steps.ROTATION, lane], w[steps.VELOCITY, lane] = state.rotation, state.velocity
        w[steps.SINE, lane], w[steps.COSINE, lane] = state.sine, state.cosine
        c, d0, d1 = equation(pulse, 0.0)
        w[steps.C, lane], w[steps.D1, lane] = c, d1
        w[steps.CENTRE, lane] = -d0 / d1 if d1 > 0.0 else 0.0
        w[steps.LONGEST, lane], w[steps.ARC, lane] = pulse.end - time, state.rotation
    return w


@BOTH
@pytest.mark.parametrize("shape", [ONE_SINE, ONE_COSINE, CONSTANT, RICKER_SYMMETRIC])
def test_series_is_that_of_the_scalar_kernel(block, shape):
    cases = states(shape, 1, block=block)
    _, _, _, series = step(filled(cases, block), working_array(), block, False)
    blocks = series.reshape(7, steps.MAX_ORDER + 1, WIDTH)
    for lane, (pulse, time, _, state) in enumerate(cases):
        alone = working_array()
        expand(alone, PULSE_ORDER, block, state, *equation(pulse, time), False)
        kinds = [(0, ROTATION, 16), (1, VELOCITY, 15), (5, PUSH, 15)]
        if not block.linearised:
            kinds += [(2, SINE, 15), (3, COSINE, 15)]
        for ours, theirs, count in kinds:
            size = np.abs(alone[theirs, :count]).max()
            np.testing.assert_allclose(
                blocks[ours, :count, lane], alone[theirs, :count], rtol=1e-9, atol=1e-12 * size
            )


@njit
def root_of_all(w, degree, correction):
    step, start, stop = load(w, steps.LENGTH), load(w, steps.STEP), load(w, steps.TIME)
    slope, sought = load(w, steps.STEP + 1) * step, among(ALL)
    given = (w, steps.STEP, degree, step, start, slope, stop, sought, correction)
    x, is_found = steps.only_root(*given)
    store(w, steps.ARC, x)
    return bits(is_found)


def test_root_is_taken_only_where_the_iteration_is_to_be_trusted():
    """Roots beside a turn, where a correction says little of what is left."""
    rng, kept = np.random.default_rng(6), []
    for _ in range(400):
        w, roots = rows(steps.ROWS), np.empty(WIDTH)
        for lane in range(WIDTH):
            root, gap = rng.uniform(0.3, 1.0), 10.0 ** rng.uniform(-4.0, 0.0)
            others = np.polynomial.Polynomial([3.0, *rng.uniform(-0.6, 0.6, 3)])
            whole = np.polynomial.Polynomial.fromroots([root, root + gap]) * others
            w[steps.STEP : steps.STEP + 6, lane] = whole.coef
            w[steps.LENGTH, lane] = root + 0.5 * gap
            w[steps.TIME, lane], roots[lane] = whole(root + 0.5 * gap), root
        found = root_of_all(w, 5, steps.TURN_CORRECTION)
        off = np.abs(w[steps.ARC] / roots - 1.0)
        kept += [off[lane] for lane in range(WIDTH) if found >> lane & 1]
    assert 0.1 < len(kept) / (400 * WIDTH) < 0.95
    # what Halley's iteration leaves is the square of the bend times the correction
    assert max(kept) < 2.0 * steps.TURN_CORRECTION * 0.1**2
