"""One history: the steps and their events, and what becomes of the block."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from topheavy import RockingBlock
from topheavy.kernel import forcing
from topheavy.kernel.forcing import NO_RECORD, Forcing, pulse_forcing
from topheavy.kernel.outcome import (
    LANDING,
    NO_RATIOS,
    NOTHING,
    PULSE_ORDER,
    ROTATION,
    TOLERANCE,
    advance,
    after_impact,
    is_certain_to_overturn,
    outcome,
    working_array,
)
from topheavy.kernel.taylor import State, oscillator

few = settings(max_examples=40, deadline=None, derandomize=True, database=None)
STILL = Forcing(forcing.NONE, 0.0, 1.0, 0.0, 1.0)
BLOCK = RockingBlock(1.0, 0.25, 0.9)
shapes = st.sampled_from(sorted(set(forcing.SHAPES) - {"harmonic"}))


def shaken(block, shape, strength, ratio, tolerance=TOLERANCE, record=NO_RECORD):
    """The outcome under a pulse of `strength` times the uplift level, at ω/p = `ratio`."""
    there = oscillator(block)
    motion = pulse_forcing(forcing.SHAPES[shape], strength * there.level, ratio)
    return outcome(working_array(), PULSE_ORDER, tolerance, there, motion, record, NO_RATIOS)


def aloft(block, rotation, velocity, push=None):
    """A block on resting ground, or under a constant push."""
    there = oscillator(block)
    sine, cosine = (0.0, 1.0) if block.linearised else (math.sin(rotation), math.cos(rotation))
    return State(rotation, velocity, sine, cosine, -there.level if push is None else push, 0.0)


def step_from(block, state, longest, zeros=0, peak=0.0):
    w = working_array()
    step = advance(
        w, 20, 1e-16, oscillator(block), STILL, 0.0, longest, state, zeros, peak, True
    )  # fmt: skip
    return *step, w


# ---------------------------------------------------------------------------- one step


def test_way_3_dip_inside_a_step_is_a_landing():
    """Thrown at the ground under an outward push: just too fast, it dips for an instant."""
    block, push, begin = BLOCK.linear(), 0.25, 0.05
    critical = math.sqrt(2 * push * begin + begin**2)
    for factor, event in ((1 - 1e-9, NOTHING), (1 + 1e-9, LANDING)):
        state = aloft(block, begin, -factor * critical, push=push)
        step, found, _, w = step_from(block, state, 0.9)
        assert found == event
        # one step, at both ends of which the polynomial is aloft
        assert np.polynomial.polynomial.polyval(0.9, w[ROTATION, :21]) > 1e-3
        assert (step == 0.9) == (event == NOTHING)


@few
@given(st.floats(1e-12, 1.0))
def test_way_4_fast_bounces_are_not_skipped(fraction):
    """A take-off from φ = 0 lands after 2v/g, however much shorter than a step that is."""
    block = BLOCK.linear()
    velocity = 0.2 * fraction * block.slenderness
    state = aloft(block, 0.0, velocity)
    step, event, _ = advance(
        working_array(), 15, 1e-9, oscillator(block), STILL, 0.0, math.inf, state, 1, 1.0, True
    )
    assert event == LANDING
    assert step == pytest.approx(2 * math.atanh(velocity / block.slenderness), rel=1e-12)


@pytest.mark.parametrize("degrees", [0.1, 3, 5, 8, 14, 20, 35, 80])
@pytest.mark.parametrize("linearised", [False, True])
def test_way_1_uplift_makes_no_impact_of_its_own(degrees, linearised):
    """While |a| is above the level the push is outward: no step up to then may land."""
    block = oscillator(RockingBlock(1.0, math.radians(degrees), 0.9, linearised))
    w = working_array()
    for excess in (1e-9, 1e-6, 1e-3, 0.5, 5.0, 1e3):
        for ratio in (0.3, 1.0, 3.0, 9.0):
            pulse = pulse_forcing(forcing.ONE_SINE, block.level * (1 + excess), ratio)
            time, push, rate, _ = forcing.next_uplift(pulse, NO_RECORD, 0.0, block.level)
            state = State(0.0, 0.0, 0.0, 1.0, push, rate)
            above = 2 * math.acos(1 / (1 + excess)) / ratio
            step, event, peak = advance(
                w, 15, 1e-9, block, pulse, time, above, state, 3, 0.0, False
            )  # fmt: skip
            assert event != LANDING
            assert step > 0.0
            assert peak > 0.0


# ---------------------------------------------------------------------------- impact


def test_way_6_the_side_is_a_state_of_its_own():
    """After an impact φ = 0, and the other side pulls back with its own level."""
    there = oscillator(BLOCK)
    before = State(-1e-17, -0.3, 0.1, 0.99, 0.02 - there.level, 0.5)  # −s a = 0.02
    after = after_impact(there, before)
    assert after[:2] == (0.0, pytest.approx(0.27))
    assert (after.sine, after.cosine) == (0.0, 1.0)
    assert after.push == pytest.approx(-0.02 - there.level)
    assert after.rate == -0.5
    assert after_impact(there, before._replace(velocity=1e-18)).velocity == 0.0


# ---------------------------------------------------------------------------- the whole history


def test_way_7_beyond_alpha_is_survived():
    """Zhang & Makris (2001): it swings past α at an amplitude that it survives."""
    survived = shaken(BLOCK.linear(), "one-sine", 7.1681, 5.0)
    assert not survived.overturned
    assert survived.peak > 1.2 * 0.25
    assert shaken(BLOCK.linear(), "one-sine", 7.1682, 5.0).overturned


def test_way_8_small_bounces_before_the_main_lobe_are_followed():
    block = RockingBlock(1.0, math.radians(14.0), 0.9)
    result = shaken(block, "ricker-symmetric", 2.4, 1.0)
    assert result.impacts == shaken(block, "ricker-symmetric", 2.4, 1.0, 1e-14).impacts > 1


@few
@given(shapes, st.floats(0.5, 8.0), st.floats(1.05, 6.0), st.booleans())
def test_tightening_changes_next_to_nothing(shape, ratio, strength, linearised):
    block = RockingBlock(1.0, 0.25, 0.9, linearised)
    usual, tight, less, more = (
        shaken(block, shape, strength * change, ratio, tolerance).peak
        for tolerance, change in (
            (TOLERANCE, 1.0), (1e-14, 1.0), (1e-14, 1 - 1e-8), (1e-14, 1 + 1e-8),
        )
    )  # fmt: skip
    assume(not np.isnan([usual, tight, less, more]).any())
    # beside what 1e-8 of the amplitude does
    assert abs(usual - tight) < 3e-9 * 0.25 + abs(more - less)


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
        assert (usual.overturned, usual.impacts) == (tight.overturned, tight.impacts)
        if not usual.overturned:
            errors.append(abs(usual.peak - tight.peak) / block.slenderness)
    assert len(errors) > 200
    assert np.quantile(errors, 0.99) < 3e-9


# ---------------------------------------------------------------------------- certain overturning


def test_way_7_overturning_is_never_certain_where_the_ground_could_bring_it_back():
    """Flat before the balance: an exact block that is pulled back by 5 g has none."""
    pulse = pulse_forcing(forcing.CONSTANT, 50.0, 0.1)
    state = aloft(BLOCK, 0.3, 1.0)
    assert not is_certain_to_overturn(oscillator(BLOCK), pulse, NO_RECORD, 1.0, state)
