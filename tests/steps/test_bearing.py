"""What the ground bears below a portal that rocks, by the momentum of the whole portal."""

import math

import numpy as np
import pytest

from steps.shared import bearing
from steps.shared.histories import history
from topheavy import Column, MonolithicPortal, Pulse, simulate
from topheavy.second import reference

WIDE = MonolithicPortal(Column(0.5, 3.0), 1.0, 5.0, 0.6)
PULSE = Pulse("one-cosine", 1.0, 2 * math.pi / 1.5)
G = 9.81


def test_normal_force_and_friction_are_those_of_the_moving_centre_of_mass():
    pulse, time = PULSE.scaled(1.6), np.linspace(0.2, 0.5, 4001)
    course = simulate(WIDE, pulse, samples=time)
    lean = WIDE.slenderness - np.abs(course.rotation)
    size = math.hypot(WIDE.half_base, WIDE.centre_height)
    up, across = size * np.cos(lean), -np.sign(course.rotation) * size * np.sin(lean)
    step = time[1] - time[0]
    lift = np.gradient(np.gradient(up, step), step) / G
    push = np.gradient(np.gradient(across, step), step) / G + pulse.excitation(time)
    inner = slice(5, -5)
    normal, required = (1.0 + lift)[inner], np.abs(push / (1.0 + lift))[inner]
    whole = history(WIDE, pulse, 8)
    part = bearing.on_the_ground(
        WIDE,
        type(whole)(
            *(x[None, inner] for x in (time, course.rotation, course.velocity)),
            pulse.excitation(time)[None, inner],
            0,
            "rests",
        ),
    )
    assert part == pytest.approx((normal.min(), required.max()), rel=1e-4)


def test_base_is_pulled_from_where_it_begins_to_be():
    found = bearing.bearing(WIDE, PULSE, 3.0)
    assert 1.6 < found.pulled_from < 1.75
    for side, pulled in ((-1, False), (1, True)):
        motion = PULSE.scaled(found.pulled_from * (1.0 + side * 1e-6))
        for route in (simulate, reference.simulate):
            course = history(WIDE, motion, bearing.SAMPLES, route)
            assert (bearing.on_the_ground(WIDE, course)[0] <= 0.0) is pulled


def test_base_that_bears_has_no_such_peak_and_a_friction():
    found = bearing.bearing(WIDE, PULSE, 1.0)
    assert found.pulled_from == math.inf
    assert math.tan(WIDE.slenderness) < found.friction < 1.0
