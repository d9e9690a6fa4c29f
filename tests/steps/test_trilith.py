"""The shake table of the trilith: the numbers of p. 4, and the thresholds of uplift."""

import math

import numpy as np
import pytest

from steps.trilith import (
    amplitude_to_uplift,
    frequency_to_uplift,
    table_motion,
    thresholds,
)
from topheavy import Column, RockingFrame

TRILITH = RockingFrame(Column(0.11, 0.40), 0.434)
AMPLITUDE, FREQUENCY = 0.005, 3.3  # m, Hz; p. 4


def test_table_motion_is_the_second_derivative_of_its_displacement():
    motion, omega, step = table_motion(AMPLITUDE, FREQUENCY), 2 * math.pi * FREQUENCY, 1e-4
    times = np.linspace(0.01, 1.0, 57)
    before, now, after = (AMPLITUDE * np.sin(omega * (times + k * step)) for k in (-1, 0, 1))
    expected = (before - 2 * now + after) / step**2 / 9.81
    np.testing.assert_allclose(motion.excitation(times), expected, atol=1e-6)
    assert motion.duration == math.inf


def test_the_two_thresholds_are_one():
    amplitude = amplitude_to_uplift(TRILITH, FREQUENCY)
    assert frequency_to_uplift(TRILITH, amplitude) == pytest.approx(FREQUENCY, rel=1e-14)


def test_thresholds_are_beside_what_was_tested():
    table = thresholds(TRILITH, {"table_amplitude": AMPLITUDE, "table_frequency": FREQUENCY})
    rise = 0.275 / 0.219  # of the acceleration; that of a frequency is its root
    assert table.tested.tolist() == [5.0, FREQUENCY]
    assert table.to_lift.to_numpy() == pytest.approx([5.0 * rise, FREQUENCY * rise**0.5], rel=2e-3)
