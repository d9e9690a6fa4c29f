"""The block with an elastic tendon: its moment by energy, its limits, and its two solvers."""

import math

import numpy as np
import pytest

from topheavy import Column, Pulse, Record, RockingFrame, simulate
from topheavy.restrained import (
    least_stiffness,
    restoring_moment,
    restrained_peak_by_scipy,
    restrained_peaks,
)

COLUMN = Column(0.5, 3.0)
BLOCK = RockingFrame(COLUMN, 1.0).block()
ALPHA, P = BLOCK.slenderness, BLOCK.frequency_parameter
PULSE = Pulse("one-sine", 2.0 * BLOCK.uplift_acceleration, 4.0 * COLUMN.frequency_parameter)
LASTING = PULSE.duration + 8.0 / P
STEP = PULSE.duration / 1000


def test_moment_is_the_derivative_of_the_energy():
    b, kappa, phi, small = math.sin(ALPHA), 1.7, np.linspace(0.01, ALPHA, 7), 1e-6

    def energy(phi):  # over m g R: of a weight at R from the corner, and of a tendon of k = κ/b²
        return np.cos(ALPHA - phi) + kappa / b**2 * 2.0 * (b * np.sin(phi / 2.0)) ** 2

    rise = (energy(phi + small) - energy(phi - small)) / (2.0 * small)
    assert restoring_moment(BLOCK, kappa, phi) == pytest.approx(rise, abs=1e-9)


@pytest.mark.parametrize(("factor", "rises"), [(0.99, False), (1.01, True), (3.0, True)])
def test_stiffness_is_positive_up_to_alpha_above_its_least(factor, rises):
    moment = restoring_moment(BLOCK, factor * least_stiffness(BLOCK), np.linspace(0.0, ALPHA, 999))
    assert bool((np.diff(moment) > 0.0).all()) is rises
    assert moment[0] == pytest.approx(math.sin(ALPHA))  # uplift is that of the free block


def test_slack_tendon_leaves_the_rocking_block():
    expected = simulate(BLOCK, PULSE, duration=LASTING, samples=2).peak_rotation
    (found,) = restrained_peaks(BLOCK, 0.0, PULSE, [1.0], duration=LASTING, time_step=STEP)
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("kappa", [0.5, 1.1, 4.0])
def test_both_solvers_agree_through_impacts(kappa):
    second = Pulse("ricker-symmetric", 2.0 * PULSE.amplitude, PULSE.angular_frequency)
    for pulse in (PULSE, second):
        lasting = pulse.duration + 8.0 / P
        (one,) = restrained_peaks(BLOCK, kappa, pulse, [1.0], duration=lasting, time_step=STEP)
        other = restrained_peak_by_scipy(
            BLOCK, kappa, pulse, duration=lasting, longest_step=10 * STEP
        )
        assert one == pytest.approx(other, rel=1e-3)


def test_both_solvers_lift_a_block_again_that_came_to_rest():
    shock = 1.5 * BLOCK.uplift_acceleration * np.sin(np.linspace(0.0, 2.0 * math.pi, 41))
    twice = Record(0.1 / P, [*shock, *np.zeros(200), *-2.0 * shock])
    block, how = BLOCK.with_restitution(0.3), {"duration": twice.duration + 8.0 / P}
    (one,) = restrained_peaks(block, 1.1, twice, [1.0], **how, time_step=0.01 / P)
    other = restrained_peak_by_scipy(block, 1.1, twice, **how, longest_step=0.05 / P)
    assert one == pytest.approx(other, rel=1e-3)


def test_block_that_is_not_uplifted_stays_at_rest():
    weak = Pulse("one-sine", 0.99 * BLOCK.uplift_acceleration, PULSE.angular_frequency)
    (found,) = restrained_peaks(BLOCK, 1.1, weak, [1.0], duration=LASTING, time_step=STEP)
    assert found == 0.0
    assert restrained_peak_by_scipy(BLOCK, 1.1, weak, duration=LASTING, longest_step=0.1) == 0.0
