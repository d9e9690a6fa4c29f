"""What a history asks of the contacts, where the answer is known."""

import numpy as np

from steps.shared.histories import history
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.setting import pulse_on
from topheavy import Cap, Column, RockingFrame

COLUMN, CAP = Column(0.5, 3.0), Cap(span=5.0, half_depth=0.5)
FRAME = RockingFrame(COLUMN, 1.0)


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return pulse_on(COLUMN, {"shape": shape, "frequency_ratio": ratio}, amplitude)


def test_frame_that_stays_at_rest_asks_for_nothing():
    found = demand(FRAME, CAP, history(FRAME, pulse(0.9), 4))
    assert found.outcome == "no uplift"
    assert np.isnan(found.friction)
    assert not found.pulls


def test_error_covers_what_many_more_samples_find():
    shaking = pulse(2.0)
    few, many = (demand(FRAME, CAP, history(FRAME, shaking, n)) for n in (4, 256))
    assert abs(few.whole - many.whole) <= few.friction_error + 1e-12
    assert few.friction_error < 0.02 * few.whole
