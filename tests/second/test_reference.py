"""The adaptive integration: its verdicts, its accuracy, and that no impact hides inside a step."""

import math

import numpy as np
import pytest

from topheavy import Pulse, RockingBlock
from topheavy.second.motion import COUNTED_PEAK, start
from topheavy.second.reference import _is_eventless, judge, simulate

BLOCK = RockingBlock(2.0, 0.25, 0.9)


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


def test_cases_hold_both_verdicts_and_several_impacts():
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


@pytest.mark.parametrize(("share", "expected"), [(0.9, True), (0.9999, False), (1.1, True)])
def test_peak_between_two_samples_that_may_count_is_looked_for(share, expected):
    """An impact is counted by the peak before it, which may lie above both ends of a step."""
    course, end = start(BLOCK, 0.0, 0.0), share * COUNTED_PEAK * BLOCK.slenderness
    course.rotation, course.rate, course.peak = end, 1e-7, 0.1
    aside = 1e-3 * COUNTED_PEAK * BLOCK.slenderness  # how far a turn may be above the ends
    largest = 8.0 * aside / 0.01**2
    assert _is_eventless(course, 0.01, end, -1e-7, largest) is expected


@pytest.mark.parametrize(("share", "expected"), [(0.9, True), (1.1, False)])
def test_dip_between_two_samples_that_may_reach_the_ground_is_looked_for(share, expected):
    course, end = start(BLOCK, 0.0, 0.0), 0.01 * BLOCK.slenderness
    course.rotation, course.rate, course.peak = end, -1e-7, 0.1
    largest = share * 8.0 * end / 0.01**2  # the chord is above the dip by this share of its height
    assert _is_eventless(course, 0.01, end, 1e-7, largest) is expected
