"""The adaptive integration: its outcomes, its accuracy, and that no impact hides inside a step."""

import math

import numpy as np
import pytest

from topheavy import Pulse, RockingBlock
from topheavy.second.motion import _leaves_wrongly
from topheavy.second.reference import judge, simulate


def seeded_cases(number: int) -> list[tuple[RockingBlock, Pulse]]:
    """Blocks and pulses that lift them, some of which overturn them."""
    random = np.random.default_rng(2014)
    shapes = ("one-sine", "one-cosine", "half-sine", "ricker-symmetric", "ricker-antisymmetric")
    cases = []
    for index in range(number):
        block = RockingBlock(
            random.uniform(0.8, 4.0),
            math.radians(random.uniform(4.0, 25.0)),
            random.uniform(0.5, 0.95),
            linearised=bool(index % 2),
        )
        push = random.uniform(1.05, 6.0) * random.choice([-1, 1]) * block.uplift_acceleration
        omega = random.uniform(2.0, 8.0) * block.frequency_parameter
        cases.append((block, Pulse(shapes[index % 5], push, omega)))
    return cases


CASES = seeded_cases(30)


def test_cases_hold_both_outcomes_and_several_impacts():
    ends = [judge(*case) for case in CASES]
    assert 5 <= sum(end.overturned for end in ends) <= 25
    assert {0, 1, 2} < {end.impacts for end in ends}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case[1].shape)
def test_judge_says_what_simulate_says(case):
    end, response = judge(*case), simulate(*case, samples=2)
    assert end.overturned == response.overturned
    assert end.impacts == response.number_of_impacts
    # simulate goes on to integrate the free rocking that judge has in closed form
    close = 1e-9 * case[0].slenderness
    assert end.peak == pytest.approx(response.peak_rotation, abs=close, nan_ok=True)


@pytest.mark.parametrize("case", CASES[:15], ids=lambda case: case[1].shape)
def test_tighter_tolerance_changes_next_to_nothing(case):
    usual, tight = judge(*case), judge(*case, tolerance=1e-13)
    assert tight.overturned == usual.overturned
    assert tight.impacts == usual.impacts
    assert tight.peak == pytest.approx(usual.peak, abs=1e-8 * case[0].slenderness, nan_ok=True)


def test_block_that_survives_may_pass_alpha_inward_only():
    """Beyond φ = α a free block comes back, or the history ends before it escapes."""
    block = RockingBlock(2.0, 0.25, 0.9)
    assert _leaves_wrongly(block, 0.26, 0.1, outward=False)
    assert not _leaves_wrongly(block, 0.26, -0.1, outward=False)
    assert _leaves_wrongly(block, 0.24, -0.1, outward=True)
    assert not _leaves_wrongly(block, 0.24, 0.1, outward=True)
