"""The shake table of the trilith: the numbers of p. 4, and the thresholds of uplift."""

import math

import numpy as np
import pytest

from steps.trilith import (
    amplitude_to_uplift,
    frequency_to_uplift,
    table_acceleration,
    table_motion,
    thresholds,
)
from topheavy import Column, RockingFrame, simulate

TRILITH = RockingFrame(Column(0.11, 0.40), 0.434)
AMPLITUDE, FREQUENCY = 0.005, 3.3  # m, Hz; p. 4
PASSAGE = [  # what, ours, printed on p. 4, half a unit of its last digit
    ("tan α", math.tan(TRILITH.slenderness), 0.275, 5e-4),
    ("α, degrees", math.degrees(TRILITH.slenderness), 15.38, 5e-3),
    ("R, m", TRILITH.column.size, 0.415, 5e-4),
    ("p, rad/s", TRILITH.column.frequency_parameter, 4.21, 5e-3),
    ("p̂, rad/s", TRILITH.frequency_parameter, 3.79, 5e-3),
    ("p̂/p", TRILITH.frequency_parameter / TRILITH.column.frequency_parameter, 0.9, 5e-2),
    ("ü_g, m/s²", table_acceleration(AMPLITUDE, FREQUENCY) * 9.81, 2.15, 5e-3),
    ("ü_g, g", table_acceleration(AMPLITUDE, FREQUENCY), 0.219, 5e-4),
]


@pytest.mark.parametrize(
    ("ours", "printed", "half"), [row[1:] for row in PASSAGE], ids=[row[0] for row in PASSAGE]
)
def test_number_of_the_passage_is_that_printed(ours, printed, half):
    assert ours == pytest.approx(printed, abs=half)


def test_table_motion_is_the_second_derivative_of_its_displacement():
    motion, omega, step = table_motion(AMPLITUDE, FREQUENCY), 2 * math.pi * FREQUENCY, 1e-4
    times = np.linspace(0.01, 1.0, 57)
    before, now, after = (AMPLITUDE * np.sin(omega * (times + k * step)) for k in (-1, 0, 1))
    expected = (before - 2 * now + after) / step**2 / 9.81
    np.testing.assert_allclose(motion.excitation(times), expected, atol=1e-6)
    assert motion.duration == math.inf


def lifts(amplitude: float, frequency: float) -> bool:
    motion = table_motion(amplitude, frequency)
    return simulate(TRILITH, motion, duration=2 / frequency, samples=2).outcome != "no uplift"


@pytest.mark.parametrize("frequency", [1.0, FREQUENCY, 8.0])
def test_amplitude_to_uplift_is_bracketed_by_simulation(frequency):
    amplitude = amplitude_to_uplift(TRILITH, frequency)
    assert not lifts(amplitude * (1 - 1e-9), frequency)
    assert lifts(amplitude * (1 + 1e-9), frequency)


def test_the_two_thresholds_are_one():
    amplitude = amplitude_to_uplift(TRILITH, FREQUENCY)
    assert frequency_to_uplift(TRILITH, amplitude) == pytest.approx(FREQUENCY, rel=1e-14)


def test_thresholds_are_beside_what_was_tested():
    table = thresholds(TRILITH, {"table_amplitude": AMPLITUDE, "table_frequency": FREQUENCY})
    rise = 0.275 / 0.219  # of the acceleration; that of a frequency is its root
    assert table.tested.tolist() == [5.0, FREQUENCY]
    assert table.to_lift.to_numpy() == pytest.approx([5.0 * rise, FREQUENCY * rise**0.5], rel=2e-3)
