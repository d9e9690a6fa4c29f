"""The short series over the pieces of a record on which nothing happens."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from topheavy import RockingBlock
from topheavy.kernel.forcing import prepare_record, record_forcing
from topheavy.kernel.march import derivatives, march
from topheavy.kernel.outcome import TOLERANCE, at_sample, working_array
from topheavy.kernel.taylor import ROTATION, State, evaluate, expand, oscillator

few = settings(max_examples=60, deadline=None, derandomize=True, database=None)
BLOCK = oscillator(RockingBlock(1.0, 0.25, 0.9))
STEP = 0.01


def rocking(rotation, velocity, forcing, record, piece=0, side=1.0):
    """The block at the first sample of a piece."""
    state = State(rotation, velocity, math.sin(rotation), math.cos(rotation), 0.0, 0.0)
    return at_sample(BLOCK, forcing, record, piece, side, state)


def noise(samples, strength=0.2):
    return strength * np.random.default_rng(7).standard_normal(samples)


def marched(rotation, velocity, samples, *, peak=0.2, step=STEP, tolerance=TOLERANCE):
    record = prepare_record(samples)
    forcing = record_forcing(record, step, 1.0)
    start = rocking(rotation, velocity, forcing, record)
    return march(BLOCK, forcing, record, 0, 1.0, start, tolerance, peak)


@few
@given(
    rotation=st.floats(0.01, 0.25),
    velocity=st.floats(-1.0, 1.0),
    push=st.floats(-2.0, 2.0),
    rate=st.floats(-50.0, 50.0),
)
def test_derivatives_are_those_of_the_recurrences(rotation, velocity, push, rate):
    alpha = BLOCK.slenderness
    state = State(rotation, velocity, math.sin(rotation), math.cos(rotation), push, rate)
    w = working_array()
    expand(w, 8, BLOCK, state, 0.0, 0.0, 0.0, True)
    tilt, lean = math.cos(alpha - rotation), math.sin(alpha - rotation)
    force = math.sin(rotation) / math.cos(alpha) + push * tilt
    slope = math.cos(rotation) / math.cos(alpha) + push * lean
    ours = derivatives(force, slope, rate * tilt, rate * lean, velocity)
    theirs = [w[ROTATION, n] * math.factorial(n) for n in range(3, 8)]
    size = (1 + abs(push) + abs(rate) + abs(velocity)) ** 5
    assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-13 * size)


def test_piece_by_piece_it_is_the_long_series():
    samples = noise(400, 0.05)
    record = prepare_record(samples)
    forcing = record_forcing(record, STEP, 1.0)
    piece, state, peak = marched(0.19, -0.02, samples, peak=0.195)
    assert piece > 20
    slow, w = rocking(0.19, -0.02, forcing, record), working_array()
    highest = 0.195
    for k in range(piece):
        slow = at_sample(BLOCK, forcing, record, k, 1.0, slow)
        expand(w, 14, BLOCK, slow, 0.0, 0.0, 0.0, True)
        slow = evaluate(w, 14, BLOCK, STEP, True)
        highest = max(highest, slow.rotation)
    assert state[:4] == pytest.approx(slow[:4], abs=1e-12)
    assert peak == pytest.approx(highest, abs=1e-12)
    assert state.push == pytest.approx(-samples[piece] - BLOCK.level, abs=1e-15)
