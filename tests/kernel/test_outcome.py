"""Histories of the kernel from uplift to their end: events, rest, the tail, the trace."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.cases import pulse_forcing
from topheavy import Pulse, Record, RockingBlock, judge, overturned_by, simulate
from topheavy.bodies.free_rocking import potential
from topheavy.kernel import forcing
from topheavy.kernel.forcing import (
    NO_RECORD,
    Forcing,
    forcing_of,
    ground,
    next_uplift,
    pulse_waveform,
    record_waveform,
)
from topheavy.kernel.grid import outcome_of, outcomes_of
from topheavy.kernel.rest import MAX_UNCOUNTED_PEAK, comes_to_rest
from topheavy.kernel.step import (
    LANDING,
    PULSE_ORDER,
    TOLERANCE,
    advance,
    after_impact,
    is_certain_to_overturn,
    is_certain_to_survive,
    with_ground,
    working_array,
)
from topheavy.kernel.taylor import IMPACTS, OUTCOME, PEAK, Method, State, evaluate, oscillator

few = settings(max_examples=40, deadline=None, derandomize=True, database=None)
STILL = Forcing(forcing.NONE, 0.0, 1.0, 0.0, 1.0, 0.0, NO_RECORD)
BLOCK = RockingBlock(1.0, 0.25, 0.9)


def shaken(block, shape, strength, ratio, tolerance=TOLERANCE):
    """The outcome under a pulse of `strength` times the uplift level, at ω/p = `ratio`."""
    scaled, waveform = oscillator(block), pulse_waveform(shape)
    return outcome_of(scaled, waveform, ratio, strength * scaled.uplift_level, tolerance=tolerance)


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
    method = Method(15, 1e-9, True)
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
            method = Method(15, 1e-9, False)
            step, event, peak = advance(w, method, block, pulse, state, 3, above, 0.0)
            assert event != LANDING
            assert step > 0.0
            assert peak > 0.0


def test_the_side_is_a_state_of_its_own():
    """After an impact φ = 0, and the other side pulls back with its own level."""
    block = oscillator(BLOCK)
    push = 0.02 - block.uplift_level  # −s a = 0.02
    before = State(0.7, 1.0, -1e-17, -0.3, 0.1, 0.99, push, 0.5, 1.0, 0.0)
    after = after_impact(block, before)
    assert after[:4] == (0.7, -1.0, 0.0, pytest.approx(0.27))
    assert (after.sine, after.cosine) == (0.0, 1.0)
    assert after.push == pytest.approx(-0.02 - block.uplift_level)
    assert after.rate == -0.5
    assert after_impact(block, before._replace(velocity=1e-18)).velocity == 0.0


def test_pulse_of_several_cycles_is_the_record_of_its_samples():
    for strength in (1.3, 2.5, 3.5, 9.0):
        pulse = Pulse("one-cosine", strength * BLOCK.slenderness, angular_frequency=3.0, cycles=3)
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
    method = Method(PULSE_ORDER, TOLERANCE, False, OUTCOME)
    return comes_to_rest(block, motion, landed(block, motion, *state), method, 1.0)


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
@pytest.mark.parametrize("before", [0.3, 1e-1, 1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_rest_is_called_where_bounces_end_long_before_the_uplift(shape, before, sign):
    """On the side with the weaker pull c they last 2v/(c cos α (1 − √r)) at constant acceleration.

    They are over if that is an eighth of the time to the uplift; if it is four times as long, then
    the acceleration passes the level during the bounces, since c only falls until then. A cosine
    passes it in its last quarter, and a pulse's value at its end has to count.
    """
    pulse = pulse_forcing(shape, sign * 2 * RESTING.uplift_level, 1.0)
    begin = 1.4 * math.pi if shape == "one-cosine" else 0.0
    time = next_uplift(pulse, begin, RESTING.uplift_level)[0] - before
    pull = RESTING.uplift_level - abs(ground(pulse, time)[0])
    for side in (-1.0, 1.0):
        for duration, expected in ((before / 8.0, True), (4.0 * before, False)):
            velocity = duration * pull * RESTING.cosine * (1.0 - RESTING.restitution) / 2.0
            assert rests(RESTING, pulse, time, velocity, side) == expected


@pytest.mark.parametrize("linearised", [False, True])
def test_what_is_called_rest_does_bounce_to_rest_before_the_next_uplift(linearised):
    """Each bounce is followed, down to nothing, while the ground moves below the level."""
    random, seen, w = np.random.default_rng(11), 0, working_array()
    while seen < 60:
        alpha, restitution = float(random.uniform(0.05, 0.4)), float(random.uniform(0, 0.98))
        block = oscillator(RockingBlock(1.0, alpha, restitution, linearised))
        shape = str(random.choice(["one-sine", "one-cosine", "ricker-symmetric"]))
        pulse = pulse_forcing(shape, float(random.uniform(1.0, 3.0)) * block.uplift_level, 2.0)
        time = float(random.uniform(0.0, pulse.end))
        first = next_uplift(pulse, time, block.uplift_level)[0]
        velocity = block.slenderness * 10.0 ** float(random.uniform(-9, -1))
        side = float(random.choice([-1.0, 1.0]))
        if not time < first < pulse.end or not rests(block, pulse, time, velocity, side):
            continue
        seen += 1
        begun = velocity
        state, method = landed(block, pulse, time, velocity, side), Method(15, 1e-12, False)
        while state.velocity > 1e-6 * begun:
            state = with_ground(block, state, state.time, ground(pulse, state.time))
            step, event, top = advance(w, method, block, pulse, state, 1, 1.0, 0.0)
            assert event == LANDING
            assert top <= MAX_UNCOUNTED_PEAK * block.slenderness
            state = after_impact(block, evaluate(w, method, block, state, step))
            assert state.time < first


@pytest.mark.parametrize("block", [BLOCK, BLOCK.linear(), RockingBlock(1.0, 1e-3, 1.0)])
@pytest.mark.parametrize("lift", [0.0, 0.5])
def test_survival_is_certain_just_below_the_speed_that_overturns(block, lift):
    """A short push along the motion adds its impulse to the speed: 0.3 of what overturns."""
    scaled, length = oscillator(block), 1e-4
    barrier = math.sqrt(2.0 * potential(scaled, scaled.slenderness))
    pushes = np.zeros(50)
    pushes[:10] = -0.3 * barrier / (9.5 * length)  # g, towards the side 1
    waveform = record_waveform(pushes, lift * np.ones(10))
    motion = forcing_of(waveform, length, 1.0, 1.0)
    for share, certain in ((0.69, True), (0.71, False)):
        speed = share * barrier
        state = State(0.0, 1.0, 0.0, speed, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0)
        state = with_ground(scaled, state, 0.0, ground(motion, 0.0))
        assert is_certain_to_survive(scaled, motion, state, 0, scaled.flat) is certain
        assert not is_certain_to_survive(scaled, motion, state, 0, 0.8 * scaled.slenderness)
    beyond = state._replace(rotation=1.01 * scaled.slenderness, velocity=0.0)
    assert not is_certain_to_survive(scaled, STILL, beyond, 0, scaled.flat)


@pytest.mark.parametrize("kind", ["record", "two records", "ricker-antisymmetric", "one-cosine"])
def test_less_detail_leaves_outcome_and_peak_alone(kind):
    """Survival that is certain, landings that are passed and bounces left out change neither.

    √r = 0 rests at each impact, also under a push that lifts the block to its old side at once.
    """
    random = np.random.default_rng(8)
    blocks = [
        oscillator(RockingBlock(1.0, alpha, restitution, linearised))
        for alpha in (0.002, 0.2, 0.9)
        for restitution in (0.0, 0.5, 0.9, 0.99)
        for linearised in (False, True)
    ]
    index = random.permutation(np.repeat(np.arange(len(blocks)), 20))
    scales, factors = 10.0 ** random.uniform(-0.3, 1.0, index.size), np.zeros(index.size)
    if "record" in kind:
        shaken = np.convolve(random.standard_normal(900), np.ones(12) / 3.0, "same")
        shaken *= np.repeat(random.random(90) < 0.6, 10)  # with pauses
        up = 0.1 * random.standard_normal(400) if kind == "two records" else None
        waveform = record_waveform(np.append(shaken, np.zeros(500)), up, 1.7)
        scales, factors = random.choice([0.01, 0.03], index.size), random.uniform(-1, 1, index.size)
    else:
        waveform = pulse_waveform(kind)
    levels = np.array([block.uplift_level for block in blocks])[index]
    cells = blocks, waveform, index, scales, levels * random.uniform(0.9, 6.0, index.size)
    outcome, peak, impacts = (
        outcomes_of(*cells, vertical_factors=factors, tolerance=1e-13, detail=detail)
        for detail in (OUTCOME, PEAK, IMPACTS)
    )
    assert 0.1 < impacts.overturned.mean() < 0.9
    np.testing.assert_array_equal(outcome.overturned, impacts.overturned)
    np.testing.assert_array_equal(peak.overturned, impacts.overturned)
    assert np.isnan(outcome.peaks).all()
    np.testing.assert_allclose(peak.peaks, impacts.peaks, rtol=1e-6, atol=1e-12)
    over = impacts.overturned
    np.testing.assert_array_equal(outcome.impacts[over] > 0, impacts.impacts[over] > 0)


def lifted_by_a_digit(random):
    """A block, and a record whose largest acceleration is the next number above its level."""
    alpha, restitution = random.uniform(0.1, 0.76), float(random.uniform(0.5, 0.999))
    block = RockingBlock(1.0, float(alpha), restitution)
    values = random.uniform(-1.0, 1.0, random.integers(3, 8)) * block.uplift_acceleration
    place = random.integers(1, values.size - 1)
    values[place] = random.choice([-1.0, 1.0]) * np.nextafter(block.uplift_acceleration, 2.0)
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
