"""Forces of a frame, derived and of the library, against Newton and Euler for its three bodies."""

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp

import topheavy as th
from derivation import consequences
from derivation.notation import (
    SIDES,
    alpha,
    g,
    gamma,
    ground_acceleration,
)
from steps.shared.newton_euler import COLUMNS, ThreeBodies, accelerations, impact
from tests.cases import COLUMN, RECORDS
from topheavy import STANDARD_GRAVITY
from topheavy.forces.contacts import CONTACTS, forces_at
from topheavy.forces.members import (
    SECTIONS,
    base_shear_slope,
    centre_height,
    clamped_forces,
    frame_forces,
    largest_forces,
)

CAP, WIDE = th.Cap(span=3.1, half_depth=0.35), th.Cap(span=20.0, half_depth=0.25)
NEARLY = 1e7  # γ in place of ∞, for columns of 1 kg


def clockwise(arm, force):
    return arm[1] * force[0] - arm[0] * force[1]


def bodies_of(frame, cap):
    """Return two columns of 1 kg and their cap beam, and the mass of all three."""
    frame = th.RockingFrame(frame.column, min(frame.mass_ratio, NEARLY))
    bodies = ThreeBodies(frame, cap)
    return bodies, 2.0 * (1.0 + frame.mass_ratio)


def three_bodies(sign, frame, cap, lean, rate, ground):
    """Return θ̈, and the forces of the four contacts over the mass."""
    (bodies, mass), rotations = bodies_of(frame, cap), np.isin(np.arange(9), COLUMNS)
    state = sign * lean * rotations, rate * rotations
    second, forces = accelerations(bodies, (sign, sign), *state, ground)
    return second[2], forces / mass


def three_bodies_collide(sign, frame, cap):
    """Return θ̇ after an impact that changes over to `sign`, θ̇ = 1 before, and its impulses."""
    (bodies, mass), column = bodies_of(frame, cap), frame.column
    moved = np.array([column.half_height, -sign * column.half_width])  # of a centre, x and z
    after, impulses = impact(bodies, (sign, sign), np.array([*moved, 1, *moved, 1, *2 * moved, 0]))
    return after[2], impulses / mass


# ---------------------------------------------------------------------------- the derivation


# ---------------------------------------------------------------------------- the library

SLENDER = th.Column(2.0 * math.sin(0.25), 2.0 * math.cos(0.25))  # α = 0.25
RATIOS = [0.0, 0.434, 4.0, math.inf]
EVERY_RATIO = pytest.mark.parametrize("ratio", RATIOS)
FRAMES = [
    th.RockingFrame(column, ratio)
    for column in (SLENDER, th.Column(0.11, 0.40), th.Column(0.7, 0.7))
    for ratio in RATIOS
]
IDS = [f"α {frame.slenderness:.2f}, γ {frame.mass_ratio:g}" for frame in FRAMES]
EVERY_FRAME = pytest.mark.parametrize("frame", FRAMES, ids=IDS)
STATES = [(0.3, 0.1, 0.0), (1e-9, 0.2, 0.4), (0.9, -0.15, -0.7), (1.4, 0.05, 1.3)]  # θ/α, θ̇/p, g


def masses(ratio):
    """Of a column and the cap, in a frame of unit mass."""
    return (0.0, 1.0) if ratio == math.inf else (0.5 / (1 + ratio), ratio / (1 + ratio))


def components(forces):
    return np.stack([forces.horizontal, forces.vertical], axis=-1)


@EVERY_FRAME
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("state", STATES)
def test_forces_are_those_of_three_bodies(frame, sign, state):
    """Of the contacts, and what follows of them: base shear, overturning and bending moments."""
    column, (lean, rate, ground) = frame.column, state
    lean, rate = lean * column.slenderness, rate * column.frequency_parameter
    _, forces = three_bodies(sign, frame, CAP, lean, rate, ground)
    expected = forces / STANDARD_GRAVITY
    motion = (frame, CAP, sign * lean, rate, ground)
    ours, inner = components(forces_at(*motion)), frame_forces(*motion)
    close = 1e-10 if frame.mass_ratio < math.inf else 1.0 / NEARLY
    np.testing.assert_allclose(ours, expected, rtol=10.0 * close, atol=close)
    assert inner.base_shear == pytest.approx(expected[:2, 0].sum(), abs=close)
    places = sign * column.half_width + CAP.span / 2 * np.array([-1, 1])
    moment = -(places * expected[:2, 1]).sum()
    assert inner.overturning_moment == pytest.approx(moment, abs=close)
    corner = sign * column.half_width * np.array([math.cos(lean), -sign * math.sin(lean)])
    for section, way, pair in ((0.0, 1.0, slice(2)), (1.0, -1.0, slice(2, 4))):
        bending = [-clockwise(way * corner, force) for force in expected[pair]]
        members = inner.bending_moment[:, SECTIONS.index(section)]
        np.testing.assert_allclose(members, bending, atol=close)


@pytest.mark.parametrize("frame", [f for f in FRAMES if f.restitution >= 0.0], ids=repr)
@pytest.mark.parametrize("before", [0.8, -0.8])
def test_impulses_are_those_of_three_bodies(frame, before):
    _, impulses = three_bodies_collide(math.copysign(1.0, before), frame, CAP)
    expected = impulses * before
    ours = components(th.impact_impulses(frame, CAP, before))
    np.testing.assert_allclose(ours, expected, rtol=10.0 / NEARLY, atol=1e-11)


def of(mass_ratio, rotation, velocity, ground=0.0, *, cap=CAP):
    return forces_at(th.RockingFrame(SLENDER, mass_ratio), cap, rotation, velocity, ground)


@EVERY_FRAME
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_every_contact_needs_tan_alpha_when_the_ground_just_uplifts(frame, sign):
    threshold = frame.uplift_acceleration
    forces = forces_at(frame, CAP, 0.0, 0.0, sign * threshold)
    loaded = 4 if frame.mass_ratio > 0.0 else 2
    assert forces.friction_demand[:loaded] == pytest.approx(threshold, rel=1e-12)


def test_column_top_contact_opens_once_the_line_of_thrust_leaves_the_span():
    tan = math.tan(0.25)
    limit = (CAP.span / 2 - SLENDER.half_width) / tan  # b + d tan α = L/2
    for half_depth, opens in ((0.999 * limit, False), (1.001 * limit, True)):
        forces = of(1.5, 0.0, 0.0, tan, cap=th.Cap(CAP.span, half_depth))
        contacts = zip(CONTACTS, forces.vertical, forces.friction_demand, strict=True)
        for contact, vertical, demand in contacts:
            is_open = opens and contact == "top_right"
            assert (vertical < 0.0) == math.isinf(demand) == is_open


PULSE = th.Pulse("one-sine", 0.36, period=1.2)
RECORD = th.Record(0.05, 0.36 * np.sin(0.2 * np.arange(60)) * np.hanning(60), "wave")
HEAVY = th.RockingFrame(SLENDER, 2.0)


@pytest.mark.parametrize("motion", [PULSE, RECORD, None], ids=["pulse", "record", "free"])
def test_forces_of_a_response_are_those_of_its_states(motion):
    start = {} if motion is not None else {"rotation": 0.2}
    response = th.simulate(HEAVY, motion, **start, samples=200)
    assert response.impact_times.size > 1
    forces = th.contact_forces(HEAVY, CAP, response, motion)
    ground = np.zeros(200) if motion is None else motion.excitation(response.time)
    states = forces_at(HEAVY, CAP, response.rotation, response.velocity, ground)
    away = np.abs(response.time[:, None] - response.impact_times).min(axis=1) > 1e-6
    f = forces.sel(time=response.time[away])
    for values, state in ((f.horizontal, states.horizontal), (f.vertical, states.vertical)):
        np.testing.assert_allclose(values.values, state[:, away], atol=1e-9)
    # Both limits at each impact, and the samples of a record, are times of the forces.
    for instant in response.impact_times:
        assert (np.abs(forces.time.values - instant) < 1e-7).sum() >= 2
    if motion is RECORD:
        inside = motion.time[motion.time <= response.time[-1]]
        assert np.isin(inside, forces.time.values).all()


TEMPLE, BAY = th.Column(0.5, 3.0), th.Cap(span=5.0, half_depth=0.5)


@pytest.mark.parametrize("ratio", [0.25, 1.0, 4.0, math.inf])
def test_forces_of_every_overturned_response_are_known(ratio):
    """The repetition of a response may end one rounding before or after it lies flat."""
    frame = th.RockingFrame(TEMPLE, ratio)
    for amplitude in np.linspace(0.17, 0.6, 60):
        pulse = th.Pulse("one-sine", amplitude, angular_frequency=2.5)
        forces = th.contact_forces(frame, BAY, th.simulate(frame, pulse, samples=50), pulse)
        assert np.isfinite(forces.vertical.values).any()


@pytest.mark.parametrize("structure", [TEMPLE, th.FixedMassColumn(TEMPLE, 1.0)], ids=repr)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_force_of_one_contact_is_that_of_newton_and_euler(structure, sign):
    """By hand: θ̈ by moments about the edge, then the acceleration of the centre of gravity."""
    if structure is TEMPLE:
        b, h, inertia = 0.5, 3.0, 4 / 3 * (0.25 + 9)
    else:  # half of the weight at 3 m, half of it at 6 m
        b, h, inertia = 0.5, 4.5, 0.5 * (4 / 3 * (0.25 + 9)) + 0.5 * (0.25 + 36)
    theta, rate, ground, g = sign * 0.06, 0.4, -0.35, STANDARD_GRAVITY
    x = -sign * b * math.cos(theta) + h * math.sin(theta)  # from the pivot to the centre
    z = sign * b * math.sin(theta) + h * math.cos(theta)
    second = g * (x - ground * z) / inertia  # clockwise, as θ
    force = (
        ground * g + second * z - rate**2 * x,
        g - second * x - rate**2 * z,
    )
    ours = forces_at(structure, None, theta, rate, ground)
    assert ours.horizontal / ours.vertical == pytest.approx(force[0] / force[1], rel=1e-12)
    assert ours.vertical == pytest.approx(force[1] / g, rel=1e-12)


def test_frame_without_weight_on_it_has_half_the_force_of_a_column_at_each_base():
    frame, motion = th.RockingFrame(TEMPLE, 0.0), (0.05, -0.2, 0.3)
    single, pair = forces_at(TEMPLE, None, *motion), forces_at(frame, BAY, *motion)
    np.testing.assert_allclose(components(pair)[:2], components(single).repeat(2, 0) / 2)


@pytest.mark.parametrize("structure", [TEMPLE, th.RockingFrame(TEMPLE, 0.25)], ids=repr)
@pytest.mark.parametrize("amplitude", [0.25, 0.32, 0.5])
def test_extremes_are_met_to_1e_4(structure, amplitude):
    pulse, cap = (
        th.Pulse("one-sine", amplitude, angular_frequency=3.0),
        BAY if structure is not TEMPLE else None,
    )
    few, fine = (
        th.contact_forces(structure, cap, th.simulate(structure, pulse, samples=samples), pulse)
        for samples in (2, 200_000)
    )
    np.testing.assert_allclose(few.vertical.min("time"), fine.vertical.min("time"), atol=1e-4)
    friction = (forces.required_friction.max("time") for forces in (few, fine))
    np.testing.assert_allclose(*friction, rtol=1e-4)
    assert few.time.size < 3000


def test_forces_until_alpha_end_where_an_overturning_frame_passes_it_for_good():
    frame, strong = th.RockingFrame(TEMPLE, 1.0), th.Pulse("one-sine", 0.5, angular_frequency=2.5)
    response = th.simulate(frame, strong, samples=5000)
    forces = th.contact_forces(frame, BAY, response, strong, until_alpha=True)
    last = float(forces.time[np.isfinite(forces.vertical).all("contact")][-1])
    lean = np.interp(last, response.time, np.abs(response.rotation))
    assert response.overturned
    assert lean == pytest.approx(frame.slenderness, rel=1e-4)


@cache
def derived_slope(side):
    return sp.diff(consequences.after_uplift(side), ground_acceleration)


@pytest.mark.parametrize("slenderness", [0.05, math.atan(1 / 6), 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
def test_base_shear_grows_after_uplift_as_derived(slenderness, ratio):
    frame = th.RockingFrame(th.Column(math.sin(slenderness), math.cos(slenderness)), ratio)
    numbers = {alpha: slenderness, gamma: ratio, g: 1.0}
    shear = frame_forces(frame, CAP, 0.0, 0.0, np.array([1.0, 1.5])).base_shear
    assert (shear[1] - shear[0]) / 0.5 == pytest.approx(base_shear_slope(frame), rel=1e-9)
    for side in SIDES:
        derived = float(derived_slope(side).subs(numbers))
        assert base_shear_slope(frame) == pytest.approx(derived, rel=1e-12)


@EVERY_RATIO
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_uplift_begins_without_a_jump(ratio, sign):
    frame, level = th.RockingFrame(COLUMN, ratio), sign * COLUMN.uplift_acceleration
    rests, moves = (frame_forces(frame, CAP, 0.0, 0.0, level * (1 + d)) for d in (-1e-12, 1e-12))
    for forces in (rests, moves):
        assert forces.base_shear == pytest.approx(level, rel=1e-9)
        height = centre_height(frame, CAP)
        assert forces.overturning_moment == pytest.approx(level * height, rel=1e-9)
    assert np.isnan(rests.bending_moment).all()


@EVERY_RATIO
def test_largest_forces_are_those_of_arcs_that_move_or_of_all_if_none_does(ratio):
    frame = th.RockingFrame(COLUMN, ratio)
    theta, rate, ground = 1e-3 * np.random.default_rng(3).normal(size=(3, 50, 3))
    theta[:25], rate[:25], ground[:25] = 0.0, 0.0, 0.99 * COLUMN.uplift_acceleration
    theta[25, 0] = 0.0  # one instant without rotation is not rest
    for arcs, counted in ((slice(None), slice(25, None)), (slice(25), slice(25))):
        whole = frame_forces(frame, CAP, *(values[counted] for values in (theta, rate, ground)))
        bending = np.moveaxis(whole.bending_moment, 0, -1)
        for row, step in zip(
            largest_forces(frame, CAP, theta[arcs], rate[arcs], ground[arcs]), (1, 2), strict=True
        ):
            assert row.tolist() == [
                np.nanmax(np.abs(force[:, ::step]), initial=0.0)
                for force in (whole.base_shear, whole.overturning_moment, bending)
            ]


@EVERY_RATIO
def test_clamped_frame_is_two_cantilevers_under_their_inertia(ratio):
    """By hand: each column bears its own inertia at h and half that of the cap beam at 2h."""
    record = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
    column, beam = masses(ratio)
    shear, overturning, bending = clamped_forces(th.RockingFrame(COLUMN, ratio), CAP, record)
    peak = np.abs(record.acceleration).max()
    assert shear == pytest.approx(peak, rel=1e-12)
    height = 6.0 + CAP.half_depth
    assert overturning == pytest.approx(peak * (2 * column * 3.0 + beam * height), rel=1e-12)
    assert bending == pytest.approx(peak * (column * 3.0 + beam / 2 * 6.0), rel=1e-12)
