"""Histories of the kernel from uplift to their end: events, rest, the tail, the trace."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.cases import pulse_forcing
from topheavy import Pulse, Record, RockingBlock, judge, overturned_by, simulate
from topheavy.kernel import forcing
from topheavy.kernel.forcing import (
    NO_RECORD,
    Forcing,
    ground,
    next_uplift,
    pulse_waveform,
)
from topheavy.kernel.grid import outcome_of
from topheavy.kernel.rest import MIN_COUNTED_PEAK, comes_to_rest
from topheavy.kernel.step import (
    LANDING,
    TOLERANCE,
    advance,
    after_impact,
    is_certain_to_overturn,
    with_ground,
    working_array,
)
from topheavy.kernel.taylor import Method, State, evaluate, oscillator

few = settings(max_examples=40, deadline=None, derandomize=True, database=None)
STILL = Forcing(forcing.NONE, 0.0, 1.0, 0.0, 1.0, 0.0, NO_RECORD)
BLOCK = RockingBlock(1.0, 0.25, 0.9)


def shaken(block, shape, strength, ratio, tolerance=TOLERANCE):
    """The outcome under a pulse of `strength` times the uplift level, at ω/p = `ratio`."""
    there, waveform = oscillator(block), pulse_waveform(shape)
    return outcome_of(there, waveform, ratio, strength * there.uplift_level, tolerance=tolerance)


def aloft(block, rotation, velocity):
    """A block on resting ground."""
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(rotation), math.cos(rotation))
    push = -oscillator(block).uplift_level
    return State(0.0, 1.0, rotation, velocity, sine, cosine, push, 0.0, 1.0, 0.0)


@few
@given(st.floats(1e-12, 1.0))
def test_fast_bounces_are_not_skipped(fraction):
    """A take-off from φ = 0 lands after 2v/g, however much shorter than a step that is."""
    block = BLOCK.linear()
    velocity = 0.2 * fraction * block.slenderness
    state = aloft(block, 0.0, velocity)
    method = Method(15, 1e-9, True, 1e-6)
    step, event, _ = advance(
        working_array(), method, oscillator(block), STILL, state, 1, math.inf, 1.0
    )
    assert event == LANDING
    assert step == pytest.approx(2 * math.atanh(velocity / block.slenderness), rel=1e-12)


@pytest.mark.parametrize("degrees", [0.1, 3, 5, 8, 14, 20, 35, 80])
@pytest.mark.parametrize("linearised", [False, True])
def test_uplift_makes_no_impact_of_its_own(degrees, linearised):
    """While |a| is above the level the push is outward: no step up to then may land."""
    block = oscillator(RockingBlock(1.0, math.radians(degrees), 0.9, linearised))
    w = working_array()
    for excess in (1e-9, 1e-6, 1e-3, 0.5, 5.0, 1e3):
        for ratio in (0.3, 1.0, 3.0, 9.0):
            pulse = pulse_forcing("one-sine", block.uplift_level * (1 + excess), ratio)
            time, push, rate, _ = forcing.next_uplift(pulse, 0.0, block.uplift_level)
            state = State(time, 1.0, 0.0, 0.0, 0.0, 1.0, push, rate, 1.0, 0.0)
            above = 2 * math.acos(1 / (1 + excess)) / ratio
            method = Method(15, 1e-9, False, 1e-6)
            step, event, peak = advance(w, method, block, pulse, state, 3, above, 0.0)
            assert event != LANDING
            assert step > 0.0
            assert peak > 0.0


def test_the_side_is_a_state_of_its_own():
    """After an impact φ = 0, and the other side pulls back with its own level."""
    there = oscillator(BLOCK)
    push = 0.02 - there.uplift_level  # −s a = 0.02
    before = State(0.7, 1.0, -1e-17, -0.3, 0.1, 0.99, push, 0.5, 1.0, 0.0)
    after = after_impact(there, before)
    assert after[:4] == (0.7, -1.0, 0.0, pytest.approx(0.27))
    assert (after.sine, after.cosine) == (0.0, 1.0)
    assert after.push == pytest.approx(-0.02 - there.uplift_level)
    assert after.rate == -0.5
    assert after_impact(there, before._replace(velocity=1e-18)).velocity == 0.0


def test_pulse_of_several_cycles_is_the_record_of_its_samples():
    for strength in (1.3, 2.5, 3.5, 9.0):
        pulse = Pulse("one-cosine", strength * BLOCK.slenderness, 3.0, cycles=3)
        time = np.linspace(0.0, pulse.duration, 30_001)
        motions = pulse, Record(time[1], pulse.excitation(time))
        end, sampled = (judge(BLOCK.linear(), motion) for motion in motions)
        assert end[::2] == sampled[::2]  # overturned, number of impacts
        np.testing.assert_allclose(end.peak_rotation, sampled.peak_rotation, rtol=0, atol=1e-5)


def test_peaks_are_good_to_1e_9_alpha_at_the_default_tolerance():
    """99 in 100 of them, on slenderness and pulses that nobody chose."""
    random, errors = np.random.default_rng(4), []
    for _ in range(300):
        block = RockingBlock(1.0, float(random.uniform(0.05, 0.5)), 0.9)
        shape = str(random.choice(["one-sine", "one-cosine", "ricker-antisymmetric"]))
        strength, ratio = float(random.uniform(1.01, 2)), float(random.uniform(1, 8))
        usual, tight = (
            shaken(block, shape, strength, ratio, tolerance) for tolerance in (TOLERANCE, 1e-15)
        )
        assert usual[::2] == tight[::2]  # overturned, number of impacts
        if not usual.overturned:
            errors.append(abs(usual.peak_rotation - tight.peak_rotation) / block.slenderness)
    assert len(errors) > 200
    assert np.quantile(errors, 0.99) < 3e-9


def test_overturning_is_never_certain_where_the_ground_could_bring_it_back():
    """Flat before the balance: an exact block that is pulled back by 5 g has none."""
    pulse = pulse_forcing("constant", 50.0, 0.1)
    state = aloft(BLOCK, 0.3, 1.0)._replace(time=1.0)
    assert not is_certain_to_overturn(oscillator(BLOCK), pulse, state)


RESTING = oscillator(RockingBlock(2.0, 0.2, 0.9))


def landed(block, motion, time, velocity, side=1.0):
    """The state after an impact."""
    state = State(time, side, 0.0, velocity, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)
    return with_ground(block, state, time, ground(motion, time))


def rests(block, motion, *state) -> bool:
    return comes_to_rest(block, motion, landed(block, motion, *state), 1.0, 1e-6)


@pytest.mark.parametrize(
    ("before", "velocity", "expected"),
    [
        (1e-1, 3e-6, True),
        (1e-1, 1e-5, False),
        (3e-2, 3e-7, True),
        (3e-2, 1e-6, False),
        (1e-2, 1e-7, False),
        (1e-6, 1e-9, False),
    ],
)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_rest_is_not_called_when_the_level_is_about_to_be_passed(before, velocity, expected, sign):
    """The velocity alone does not tell: it depends on what is left of the time to the uplift."""
    pulse = pulse_forcing("one-sine", sign * 2 * RESTING.uplift_level, 1.0)
    time = next_uplift(pulse, 0.0, RESTING.uplift_level)[0] - before
    for side in (-1.0, 1.0):
        assert rests(RESTING, pulse, time, velocity, side) == expected


@pytest.mark.parametrize("linearised", [False, True])
def test_what_is_called_rest_does_bounce_to_rest_before_the_next_uplift(linearised):
    """Each bounce is followed, down to nothing, while the ground moves below the level."""
    random, seen, w = np.random.default_rng(11), 0, working_array()
    while seen < 40:
        block = oscillator(
            RockingBlock(
                1.0, float(random.uniform(0.05, 0.4)), float(random.uniform(0, 0.9)), linearised
            )
        )
        pulse = pulse_forcing("one-sine", float(random.uniform(1.0, 3.0)) * block.uplift_level, 2.0)
        first = next_uplift(pulse, 0.0, block.uplift_level)[0]
        time = first * (1 - 10.0 ** float(random.uniform(-4, 0)))
        velocity = block.slenderness * 10.0 ** float(random.uniform(-9, -3))
        side = float(random.choice([-1.0, 1.0]))
        if not rests(block, pulse, time, velocity, side):
            continue
        seen += 1
        begun = velocity
        state, method = landed(block, pulse, time, velocity, side), Method(15, 1e-12, False, 1e-6)
        while state.velocity > 1e-6 * begun:
            state = with_ground(block, state, state.time, ground(pulse, state.time))
            step, event, top = advance(w, method, block, pulse, state, 1, 1.0, 0.0)
            assert event == LANDING
            assert top <= MIN_COUNTED_PEAK * block.slenderness
            state = after_impact(block, evaluate(w, method, block, state, step))
            assert state.time < first


def lifted_by_a_digit(random):
    """A block, and a record whose largest acceleration is the next number above its level."""
    alpha, restitution = random.uniform(0.1, 0.76), float(random.uniform(0.5, 0.999))
    block = RockingBlock(1.0, float(alpha), restitution)
    values = random.uniform(-1.0, 1.0, random.integers(3, 8)) * block.uplift_acceleration
    at = random.integers(1, values.size - 1)
    values[at] = random.choice([-1.0, 1.0]) * np.nextafter(block.uplift_acceleration, 2.0)
    return block, Record(10.0 ** random.uniform(-2.0, 0.5), np.concatenate([[0.0], values, [0.0]]))


@pytest.mark.parametrize("restitution", [None, 0.67])
def test_block_that_is_lifted_by_the_last_digit_of_a_record_comes_to_rest(restitution):
    """Its bounces are over before the clock ticks, and the acceleration may turn in that tick."""
    random = np.random.default_rng(5)
    for _ in range(400):
        block, record = lifted_by_a_digit(random)
        if restitution:
            block = block.with_restitution(restitution)
        end = judge(block, record)
        assert not end.overturned
        assert end.peak_rotation < 1e-12 * block.slenderness
        assert overturned_by(block, record, [1.0]).tolist() == [False]
        assert simulate(block, record, samples=2).outcome == "rests"
