"""The first step of the study."""

import math

import pytest

from studies.skeleton.steps.gain import lowest
from topheavy import Column, Pulse, RockingFrame

COLUMN = Column(0.5, 3.0)
BLOCK = RockingFrame(COLUMN, 1.0).block()
AMPLITUDES = {"lowest": 1.0, "highest": 12.0, "floor": 0.01}


def pulse(period):
    return Pulse("constant", COLUMN.uplift_acceleration, 2 * math.pi / period)


def test_very_long_pulse_overturns_from_uplift_on():
    assert lowest(BLOCK, pulse(60.0), AMPLITUDES)[0] == pytest.approx(1.0)


def test_pulse_that_overturns_at_no_amplitude_is_refused():
    with pytest.raises(ValueError, match="expected a higher one"):
        lowest(BLOCK, pulse(0.01), AMPLITUDES)
