"""Forces in frames while they rock, and while they are clamped against uplift."""

import math

import numpy as np
import pytest

import topheavy as th
from tests.cases import COLUMN, RECORDS
from topheavy import STANDARD_GRAVITY, Cap, RockingFrame
from topheavy.bodies.kinematics import cap_acceleration
from topheavy.forces import (
    SECTIONS,
    base_shear_slope,
    centre_height,
    clamped_forces,
    forces_at,
    frame_forces,
    largest_forces,
)

CAP = Cap(5.0, 0.5)
STATES = [(0.05, 0.2, 0.1), (-0.03, 0.1, -0.4), (0.12, -0.3, 0.5), (-1e-9, 0.0, 0.3)]
RATIOS = [0.0, 1.0, 4.0, math.inf]


def angular(frame, theta, ground):
    side, lean = math.copysign(1.0, theta), frame.slenderness - abs(theta)
    return -(frame.frequency_parameter**2) * (side * math.sin(lean) + ground * math.cos(lean))


def particles(theta, rate, second, ground, count=40):
    """Of a column of unit mass: places from the pivot and forces (g included) of its particles."""
    b, h, side = COLUMN.half_width, COLUMN.half_height, math.copysign(1.0, theta)
    nodes, weights = np.polynomial.legendre.leggauss(count)
    across, along = np.meshgrid(b * nodes, h * (1.0 + nodes), indexing="ij")
    mass = np.outer(weights, weights) / 4.0
    t, a = across - side * b, along  # from the pivot, in the axes of the column
    x = t * math.cos(theta) + a * math.sin(theta)
    z = a * math.cos(theta) - t * math.sin(theta)
    pull_x = ground * STANDARD_GRAVITY + second * z - rate**2 * x
    pull_z = STANDARD_GRAVITY - second * x - rate**2 * z
    return along, x, z, mass * pull_x, mass * pull_z


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_base_shear_is_the_inertia_of_all_bodies(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    second = angular(frame, state[0], state[2])
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    pull = particles(*state[:2], second, state[2])[3].sum()
    u, _ = cap_acceleration(COLUMN, *state[:2], second)
    inertia = columns * pull / STANDARD_GRAVITY
    inertia += (1.0 - columns) * (state[2] + u / STANDARD_GRAVITY)
    assert frame_forces(frame, CAP, *state).base_shear == pytest.approx(inertia, abs=1e-12)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_overturning_moment_is_that_of_weight_and_inertia(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = state
    second, side = angular(frame, theta, ground), math.copysign(1.0, theta)
    columns = 0.0 if ratio == math.inf else 1.0 / (1.0 + ratio)
    _, x, z, px, pz = particles(theta, rate, second, ground)
    place = side * COLUMN.half_width + x  # from the axis of the resting column; ± L/2 cancel
    moment = columns * (z * px - place * pz).sum() / STANDARD_GRAVITY
    u, v = cap_acceleration(COLUMN, theta, rate, second)
    lean, double = frame.slenderness - abs(theta), 2.0 * COLUMN.size
    along = side * double * (math.sin(frame.slenderness) - math.sin(lean))
    height = double * math.cos(lean) + CAP.half_depth
    cap = height * (ground + u / STANDARD_GRAVITY) - along * (1.0 + v / STANDARD_GRAVITY)
    moment += (1.0 - columns) * cap
    forces = frame_forces(frame, CAP, *state)
    assert forces.overturning_moment == pytest.approx(moment, abs=1e-11)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("state", STATES)
def test_bending_moment_is_that_of_all_below_the_section(ratio, state):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = state
    weight = 0.0 if ratio == math.inf else 0.5 / (1.0 + ratio)
    second, side = angular(frame, theta, ground), math.copysign(1.0, theta)
    along, x, z, px, pz = particles(theta, rate, second, ground)
    forces, inner = forces_at(frame, CAP, *state), frame_forces(frame, CAP, *state)
    b, height = COLUMN.half_width, 2.0 * COLUMN.half_height
    for place in (0, 1):
        for section in (0.0, 1.0):  # Gauss points lie on either side of no other section
            level = section * height
            t, a = -side * b, level
            at_x = t * math.cos(theta) + a * math.sin(theta)
            at_z = a * math.cos(theta) - t * math.sin(theta)
            below = along < level
            load = (z - at_z) * px - (x - at_x) * pz
            moment = -at_z * forces.horizontal[place] + at_x * forces.vertical[place]
            moment -= weight * load[below].sum() / STANDARD_GRAVITY
            ours = inner.bending_moment[place, SECTIONS.index(section)]
            assert ours == pytest.approx(-moment, abs=1e-11)


@pytest.mark.parametrize(
    ("ratio", "slope"), [(0.0, 0.270270), (1.0, 0.179054), (4.0, 0.090644), (math.inf, 0.027027)]
)
def test_slope_after_uplift_is_the_known_one(ratio, slope):
    frame = RockingFrame(COLUMN, ratio)
    shear = frame_forces(frame, CAP, 0.0, 0.0, np.array([0.2, 0.5])).base_shear
    assert base_shear_slope(frame) == pytest.approx(slope, abs=1e-6)
    assert (shear[1] - shear[0]) / 0.3 == pytest.approx(slope, abs=1e-6)


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_uplift_begins_without_a_jump(ratio, sign):
    frame, level = RockingFrame(COLUMN, ratio), sign * COLUMN.uplift_acceleration
    rests, moves = (frame_forces(frame, CAP, 0.0, 0.0, level * (1 + d)) for d in (-1e-12, 1e-12))
    assert rests.base_shear == pytest.approx(level, rel=1e-9)
    assert rests.overturning_moment == pytest.approx(level * centre_height(frame, CAP), rel=1e-9)
    assert moves.base_shear == pytest.approx(rests.base_shear, rel=1e-9)
    assert moves.overturning_moment == pytest.approx(rests.overturning_moment, rel=1e-9)
    assert np.isnan(rests.bending_moment).all()


@pytest.mark.parametrize("ratio", RATIOS)
def test_largest_forces_are_those_of_arcs_that_move_or_of_all_if_none_does(ratio):
    frame = RockingFrame(COLUMN, ratio)
    theta, rate, ground = 1e-3 * np.random.default_rng(3).normal(size=(3, 50, 3))
    theta[:25], rate[:25], ground[:25] = 0.0, 0.0, 0.99 * COLUMN.uplift_acceleration
    theta[25, 0] = 0.0  # one instant without rotation is not rest
    for arcs, counted in ((slice(None), slice(25, None)), (slice(25), slice(25))):
        whole = frame_forces(frame, CAP, *(each[counted] for each in (theta, rate, ground)))
        bending = np.moveaxis(whole.bending_moment, 0, -1)
        for row, step in zip(
            largest_forces(frame, CAP, theta[arcs], rate[arcs], ground[arcs]), (1, 2), strict=True
        ):
            assert row.tolist() == [
                np.nanmax(np.abs(force[:, ::step]), initial=0.0)
                for force in (whole.base_shear, whole.overturning_moment, bending)
            ]


@pytest.mark.parametrize("ratio", RATIOS)
def test_clamped_frame_is_two_cantilevers_under_their_inertia(ratio):
    """By hand: each column bears its own inertia at h and half that of the cap beam at 2h."""
    record = th.read_record(RECORDS / "el_centro_1940_NS.AT2")
    column, beam = (0.0, 1.0) if ratio == math.inf else (0.5 / (1 + ratio), ratio / (1 + ratio))
    shear, overturning, bending = clamped_forces(RockingFrame(COLUMN, ratio), CAP, record)
    peak = np.abs(record.acceleration).max()
    assert shear == pytest.approx(peak, rel=1e-12)
    assert overturning == pytest.approx(peak * (2 * column * 3.0 + beam * 6.5), rel=1e-12)
    assert bending == pytest.approx(peak * (column * 3.0 + beam / 2 * 6.0), rel=1e-12)
