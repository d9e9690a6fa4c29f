"""What a history asks of the contacts, where the answer is known."""

import math

import numpy as np
import pytest

from steps.shared.histories import history
from studies.mechanism.steps.demand import demand, impact_demand
from studies.mechanism.steps.setting import pulse_on
from topheavy import Cap, Column, RockingFrame, simulate

COLUMN, CAP = Column(0.5, 3.0), Cap(span=5.0, half_depth=0.5)
FRAME = RockingFrame(COLUMN, 1.0)
TAN = COLUMN.uplift_acceleration


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return pulse_on(COLUMN, {"shape": shape, "frequency_ratio": ratio}, amplitude)


def test_frame_that_stays_at_rest_asks_for_nothing():
    found = demand(FRAME, CAP, history(FRAME, pulse(0.9), 4))
    assert found.outcome == "no uplift"
    assert np.isnan(found.friction)
    assert not found.pulls


def test_mirrored_shaking_asks_for_the_same():
    one, other = (demand(FRAME, CAP, history(FRAME, pulse(a), 8)) for a in (2.0, -2.0))
    assert one.whole == pytest.approx(other.whole, rel=1e-9)
    assert one.least == pytest.approx(other.least, rel=1e-9)


def test_forces_are_looked_at_right_beside_every_impact():
    shaking = pulse(2.0)
    impacts = simulate(FRAME, shaking, samples=2).impacts
    times = history(FRAME, shaking, 2).time.ravel()
    for time in impacts[:-1]:
        beside = times[np.abs(times - time) < 1e-8] - time
        assert beside.min() < 0.0 < beside.max()


def test_history_that_overturns_ends_as_the_rotation_passes_alpha_for_good():
    course = history(FRAME, pulse(8.0, ratio=2.0), 4)
    assert course.outcome == "overturned"
    assert abs(course.rotation[-1, -1]) == pytest.approx(FRAME.slenderness, rel=1e-4)
    assert np.isfinite(course.rotation).all()


def test_error_covers_what_many_more_samples_find():
    shaking = pulse(2.0)
    few, many = (demand(FRAME, CAP, history(FRAME, shaking, n)) for n in (4, 256))
    assert abs(few.whole - many.whole) <= few.friction_error + 1e-12
    assert few.friction_error < 0.02 * few.whole


def test_solitary_column_at_the_start_of_a_one_cosine():
    # Zhang & Makris (2001): about twice tan α for 6 α g and α = 0.25; less as it moves on.
    column = Column(math.sin(0.25), math.cos(0.25))
    alone = RockingFrame(column, 0.0)
    spec = {"shape": "one-cosine", "frequency_ratio": 8.0}
    found = demand(alone, CAP, history(alone, pulse_on(column, spec, 6 * 0.25 / math.tan(0.25)), 8))
    assert found.friction >= 1.99 * math.tan(0.25)


def test_impact_of_massless_columns_asks_for_the_slope_of_the_diagonal():
    friction, least = impact_demand(RockingFrame(COLUMN, math.inf), CAP)
    assert friction == pytest.approx(TAN)
    assert 0.0 < least < 0.5
