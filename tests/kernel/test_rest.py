"""Way 5: a train of bounces ends by proof. What is called rest comes to rest, and in time."""

import numpy as np
import pytest

from topheavy import Record, RockingBlock, judge, overturned_by, simulate
from topheavy.kernel import forcing
from topheavy.kernel.forcing import (
    NO_RECORD,
    ground,
    next_uplift,
    pulse_forcing,
)
from topheavy.kernel.outcome import LANDING, advance, after_impact, renewed, working_array
from topheavy.kernel.rest import LAST_BOUNCE, comes_to_rest
from topheavy.kernel.taylor import State, evaluate, oscillator

BLOCK = oscillator(RockingBlock(2.0, 0.2, 0.9))


def rests(block, motion, time, velocity, side=1.0, peak=1.0, record=NO_RECORD) -> bool:
    push = -side * ground(motion, record, time)[0] - block.level
    return comes_to_rest(block, motion, record, time, velocity, push, side, peak)


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
def test_way_5_rest_is_not_called_when_the_level_is_about_to_be_passed(
    before, velocity, expected, sign
):
    """The velocity alone does not tell: it depends on what is left of the time to the uplift."""
    pulse = pulse_forcing(forcing.ONE_SINE, sign * 2 * BLOCK.level, 1.0)
    time = next_uplift(pulse, NO_RECORD, 0.0, BLOCK.level)[0] - before
    for side in (-1.0, 1.0):
        assert rests(BLOCK, pulse, time, velocity, side) == expected


@pytest.mark.parametrize("linearised", [False, True])
def test_way_5_what_is_called_rest_does_bounce_to_rest_before_the_next_uplift(linearised):
    """Each bounce is followed, down to nothing, while the ground moves below the level."""
    random, seen, w = np.random.default_rng(11), 0, working_array()
    while seen < 40:
        block = oscillator(
            RockingBlock(
                1.0, float(random.uniform(0.05, 0.4)), float(random.uniform(0, 0.9)), linearised
            )
        )
        pulse = pulse_forcing(forcing.ONE_SINE, float(random.uniform(1.0, 3.0)) * block.level, 2.0)
        first = next_uplift(pulse, NO_RECORD, 0.0, block.level)[0]
        time = first * (1 - 10.0 ** float(random.uniform(-4, 0)))
        velocity = block.slenderness * 10.0 ** float(random.uniform(-9, -3))
        side = float(random.choice([-1.0, 1.0]))
        if not rests(block, pulse, time, velocity, side):
            continue
        seen += 1
        begun = velocity
        state = State(0.0, velocity, 0.0, 1.0, 0.0, 0.0)
        while state.velocity > 1e-6 * begun:
            state = renewed(block, pulse, NO_RECORD, time, side, state)
            step, event, top = advance(
                w, 15, 1e-12, block, pulse, time, 1.0, state, 1, 0.0, False
            )  # fmt: skip
            assert event == LANDING
            assert top <= LAST_BOUNCE * block.slenderness
            state = after_impact(block, evaluate(w, 15, block, step, False))
            time, side = time + step, -side
            assert time < first


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
        found = judge(block, record)
        assert not found.overturned
        assert found.peak < 1e-12 * block.slenderness
        assert overturned_by(block, record, [1.0]).tolist() == [False]
        assert simulate(block, record, samples=2).outcome == "rests"
