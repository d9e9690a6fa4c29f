"""The adaptive integration: its verdicts, its accuracy, and that no impact hides inside a step."""

import math
from dataclasses import replace

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


@pytest.mark.parametrize("linearised", [False, True])
@pytest.mark.parametrize("push", [0.5, -0.5])
def test_constant_push_does_the_work_that_the_motion_gains(push, linearised):
    # Eq. (23) under a constant ü_g has a potential: of the rotation, and of the ground's push.
    block = replace(BLOCK, linearised=linearised)
    history = simulate(
        block, Pulse("constant", push, math.pi / 0.6), samples=np.linspace(0.0, 0.6, 61)
    )
    tilt, lean = np.abs(history.rotation), 0.25 - np.abs(history.rotation)
    if linearised:
        gained = abs(push) * tilt - tilt * (0.25 - tilt / 2)
    else:
        work = math.sin(0.25) - np.sin(lean)
        gained = abs(push) * work - (np.cos(lean) - math.cos(0.25))
    np.testing.assert_allclose(history.velocity**2 / 8, gained, atol=1e-11)
    assert np.all(np.sign(history.rotation[1:]) == -np.sign(push))
    assert np.all(np.sign(history.velocity[1:]) == -np.sign(push))


# ---------------------------------------------------------------------------- inside a step


@pytest.mark.parametrize("tolerance", [1e-11, 1e-6, 1e-3])
def test_grazing_impact_is_met_however_long_the_steps_are(tolerance):
    # Thrown at the ground while it pushes outwards, just hard enough to dip to the other side.
    push, begin = 0.5, 0.05

    def potential(x):
        return x * (0.25 - x / 2) - push * x

    critical = 2.0 * math.sqrt(2 * (potential(0.0) - potential(begin)))
    pulse = Pulse("constant", -push, math.pi / 0.35)
    for factor, impacts in ((0.98, 0), (1.02, 2)):
        response = simulate(
            BLOCK.linear(),
            pulse,
            rotation=begin,
            velocity=-factor * critical,
            duration=0.35,
            tolerance=tolerance,
        )
        assert response.number_of_impacts == impacts


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
