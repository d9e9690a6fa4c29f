"""Contact forces against Newton and Euler for three turned rectangles, and in their limits."""

import math

import numpy as np
import pytest

import topheavy as th
from topheavy.forces.contact import column_forces, forces_at

SLENDER = th.Column(2.0 * math.sin(0.25), 2.0 * math.cos(0.25))  # α = 0.25
TRILITH = th.Column(0.11, 0.40)
SQUARE = th.Column(0.7, 0.7)
CAP = th.Cap(span=3.1, half_depth=0.35)

TAN = math.tan(0.25)
FRAMES = [
    th.RockingFrame(column, mass_ratio)
    for column in (SLENDER, TRILITH, SQUARE)
    for mass_ratio in (0.0, 0.434, 4.0, math.inf)
]


def of(mass_ratio, rotation, velocity, ground=0.0, *, cap=CAP):
    frame = th.RockingFrame(SLENDER, mass_ratio)
    return forces_at(frame, cap, rotation, velocity, ground)


IDS = [f"α {frame.slenderness:.2f}, γ {frame.mass_ratio:g}" for frame in FRAMES]
STATES = [  # θ/α, θ̇/p, ü_g (g)
    (0.3, 0.1, 0.0),
    (1e-9, 0.2, 0.4),
    (0.9, -0.15, -0.7),
    (1.4, 0.05, 1.3),
]


def angular_acceleration(structure, theta, ground):
    """θ̈ of Eq. (23), which is Eq. (3) for a column."""
    s, lean = math.copysign(1.0, theta), structure.slenderness - abs(theta)
    squared = structure.frequency_parameter**2
    return -squared * (s * math.sin(lean) + ground * math.cos(lean))


def masses(mass_ratio):
    """Of a column and the cap, in a frame of unit mass."""
    if mass_ratio == math.inf:
        return 0.0, 1.0
    return 0.5 / (1 + mass_ratio), mass_ratio / (1 + mass_ratio)


def vector(reaction):
    return np.array([reaction.horizontal, reaction.vertical])


def clockwise(arm, force):
    return arm[1] * force[0] - arm[0] * force[1]


def points_of(column, theta):
    """Centre of the rectangle turned by θ, and its corner under the cap, from the pivot."""
    s = math.copysign(1.0, theta)
    turn = np.array([[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]])
    b, h = column.half_width, column.half_height
    return turn @ [-s * b, h], turn @ [-2 * s * b, 2 * h]


def accelerations(column, theta, rate, second, ground):
    """Accelerations of both points (m/s²), by fourth-order differences of positions in time."""
    step = 2e-3 / column.frequency_parameter
    weights = dict(zip((-2, -1, 0, 1, 2), np.array([-1, 16, -30, 16, -1]) / 12, strict=True))
    upright = points_of(column, math.copysign(1e-300, theta))  # the pivot stays that of this side

    def positions(t):
        angle = theta + rate * t + second * t**2 / 2
        cos, sin = math.cos(angle), math.sin(angle)
        turn = np.array([[cos, sin], [-sin, cos]])
        drift = np.array([ground * th.STANDARD_GRAVITY * t**2 / 2, 0.0])
        return np.array([turn @ point + drift for point in upright])

    return sum(weight * positions(k * step) for k, weight in weights.items()) / step**2


# Newton and euler ---------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES, ids=IDS)
@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("state", STATES)
def test_forces_move_and_turn_all_three_bodies_as_the_frame_rocks(frame, side, state):
    column = frame.column
    theta, rate = side * state[0] * column.slenderness, state[1] * column.frequency_parameter
    ground = state[2]
    second = angular_acceleration(frame, theta, ground)
    mass, beam = masses(frame.mass_ratio)
    forces = forces_at(frame, CAP, theta, rate, ground)
    bases = [vector(forces.base_left), vector(forces.base_right)]
    tops = [vector(forces.top_left), vector(forces.top_right)]
    at_centre, at_cap = accelerations(column, theta, rate, second, ground) / th.STANDARD_GRAVITY
    weight = np.array([0.0, 1.0])
    centre, corner = points_of(column, theta)
    inertia = mass * column.size**2 / 3 / th.STANDARD_GRAVITY
    close = {"rtol": 1e-7, "atol": 1e-8}
    for base_force, top_force in zip(bases, tops, strict=True):
        np.testing.assert_allclose(base_force - top_force, mass * (at_centre + weight), **close)
        moment = clockwise(-centre, base_force) - clockwise(corner - centre, top_force)
        assert moment == pytest.approx(inertia * second, rel=1e-9, abs=1e-11)
    np.testing.assert_allclose(tops[0] + tops[1], beam * (at_cap + weight), **close)
    # The cap does not slide: its contacts are where the corners touched it at θ = 0.
    shift = -side * column.half_width
    arms = [(shift + end * CAP.span / 2, -CAP.half_depth) for end in (-1, 1)]
    moments = [clockwise(arm, force) for arm, force in zip(arms, tops, strict=True)]
    assert sum(moments) == pytest.approx(0.0, abs=1e-12)


# Limits -------------------------------------------------------------------------------------------


def test_light_cap_leaves_two_solitary_columns():
    motion = ([-0.1, 0.2, 0.05], [0.4, -0.3, 0.0], [0.0, 0.8, -0.5])
    column = vector(column_forces(SLENDER, *motion))
    bare = of(0.0, *motion)
    assert np.all(vector(bare.top_left) == 0.0)
    assert np.all(np.isnan(bare.top_left.friction_demand))  # it carries nothing
    assert np.all(np.isfinite(bare.friction_demand))
    for mass_ratio, error in ((0.0, 1e-15), (1e-7, 1e-5)):
        forces = of(mass_ratio, *motion)
        for base_force in (forces.base_left, forces.base_right):
            np.testing.assert_allclose(2 * vector(base_force), column, atol=error)


# Uplift -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES[1:], ids=IDS[1:])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_every_contact_needs_tan_alpha_when_the_ground_just_uplifts(frame, sign):
    threshold = frame.uplift_acceleration
    forces = forces_at(frame, CAP, 0.0, 0.0, sign * threshold)
    for contact in forces.contacts:
        if frame.mass_ratio > 0.0 or contact in (forces.base_left, forces.base_right):
            assert contact.friction_demand == pytest.approx(threshold, rel=1e-12)


def test_column_top_contact_opens_once_the_line_of_thrust_leaves_the_span():
    limit = (CAP.span / 2 - SLENDER.half_width) / TAN  # b + d tan α = L/2
    for half_depth, opens in ((0.999 * limit, False), (1.001 * limit, True)):
        forces = of(1.5, 0.0, 0.0, TAN, cap=th.Cap(CAP.span, half_depth))
        assert (forces.top_right.vertical < 0.0) == (forces.least_vertical < 0.0) == opens
        assert forces.top_left.vertical > 0.0
        for demand in (forces.top_right.friction_demand, forces.friction_demand):
            assert math.isinf(demand) == opens


# Impact -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES[:8], ids=IDS[:8])
@pytest.mark.parametrize("before", [0.8, -0.8])
def test_impulses_change_the_momentum_of_all_three_bodies(frame, before):
    column, side = frame.column, math.copysign(1.0, before)
    after = frame.restitution * before
    mass, beam = masses(frame.mass_ratio)
    impulses = th.impact_impulses(frame, CAP, before)
    bases = [vector(impulses.base_left), vector(impulses.base_right)]
    tops = [vector(impulses.top_left), vector(impulses.top_right)]
    old, new = points_of(column, -side * 1e-300), points_of(column, side * 1e-300)

    def velocity(arm, rate):  # of a body that turns clockwise
        return rate * np.array([arm[1], -arm[0]])

    centre, cap = (velocity(n, after) - velocity(o, before) for o, n in zip(old, new, strict=True))
    for base_force, top_force in zip(bases, tops, strict=True):
        np.testing.assert_allclose(base_force - top_force, mass * centre, atol=1e-14)
        moment = clockwise(-new[0], base_force) - clockwise(new[1] - new[0], top_force)
        spin = mass * column.size**2 / 3 * (after - before)
        assert moment == pytest.approx(spin, abs=1e-14)
    np.testing.assert_allclose(tops[0] + tops[1], beam * cap, atol=1e-14)
    shift = -side * column.half_width
    arms = [(shift + end * CAP.span / 2, -CAP.half_depth) for end in (-1, 1)]
    moments = [clockwise(arm, push) for arm, push in zip(arms, tops, strict=True)]
    assert sum(moments) == pytest.approx(0.0, abs=1e-14)


# Bad input ----------------------------------------------------------------------------------------


PULSE = th.Pulse("one-sine", 0.36, period=1.2)
RECORD = th.Record(0.05, 0.36 * np.sin(0.2 * np.arange(60)) * np.hanning(60), "wave")


@pytest.mark.parametrize("motion", [PULSE, RECORD, None], ids=["pulse", "record", "free"])
def test_forces_of_a_response_are_those_of_its_states(motion):
    frame = th.RockingFrame(SLENDER, 2.0)
    start = {} if motion is not None else {"rotation": 0.2}
    response = th.simulate(frame, motion, **start, samples=200)
    assert response.impact_times.size > 1
    forces = th.contact_forces(frame, CAP, response, motion)
    ground = np.zeros(200) if motion is None else motion.excitation(response.time)
    states = forces_at(frame, CAP, response.rotation, response.velocity, ground)
    away = np.abs(response.time[:, None] - response.impact_times).min(axis=1) > 1e-6
    for name, contact in zip(forces.contact.values, states.contacts, strict=True):
        at = forces.sel(contact=name, time=response.time[away])
        assert at.horizontal.values == pytest.approx(
            contact.horizontal[away], abs=1e-9, nan_ok=True
        )
        assert at.vertical.values == pytest.approx(contact.vertical[away], abs=1e-9, nan_ok=True)
    # Both limits at each impact, and the samples of a record, are times of the forces.
    for impact in response.impact_times:
        assert (np.abs(forces.time.values - impact) < 1e-7).sum() == 2
    if motion is RECORD:
        inside = motion.time[motion.time <= response.time[-1]]
        assert np.isin(inside, forces.time.values).all()


def test_largest_friction_is_met_although_the_response_has_few_samples():
    frame = th.RockingFrame(SLENDER, 2.0)
    few, many = (
        th.contact_forces(frame, CAP, th.simulate(frame, RECORD, samples=samples), RECORD)
        for samples in (3, 20_000)
    )
    needed = [float(forces.required_friction.max()) for forces in (few, many)]
    assert needed[0] == pytest.approx(needed[1], rel=2e-3)


def test_forces_end_where_the_frame_overturns():
    frame = th.RockingFrame(SLENDER, 2.0)
    strong = PULSE.scaled(4.0)
    response = th.simulate(frame, strong)
    assert response.overturned
    forces = th.contact_forces(frame, CAP, response, strong)
    ended = np.isnan(forces.vertical).all("contact").values
    assert 0 < ended.sum() < ended.size
