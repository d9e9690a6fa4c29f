"""The equation of motion by computer algebra: geometry, energies and impacts."""

import numpy as np
import pytest
import sympy as sp

from derivation.mechanics import (
    cap_contact,
    cap_motion,
    centre,
    kinetic_energy,
    moment_of_inertia,
    potential_energy,
)
from derivation.notation import (
    SIDES,
    I_o,
    R,
    acceleration,
    alpha,
    g,
    ground_velocity,
    m_b,
    m_c,
    velocity,
)

HALF_WIDTH, HALF_HEIGHT = 0.31, 1.27
SIZE, SLENDERNESS = np.hypot(HALF_WIDTH, HALF_HEIGHT), np.arctan2(HALF_WIDTH, HALF_HEIGHT)
CORNERS = np.array([[-1, 0], [1, 0], [1, 2], [-1, 2]]) * [HALF_WIDTH, HALF_HEIGHT]


def turned_rectangle(rotation, axis=0.0):
    """Corners of the column, turned clockwise about the bottom corner that it leans over."""
    upright = CORNERS + np.array([axis, 0])
    pivot = upright[1] if rotation > 0 else upright[0]
    c, s = np.cos(rotation), np.sin(rotation)
    return pivot + (upright - pivot) @ np.array([[c, -s], [s, c]])


def evaluate(expression, side, rotation, rate=0.0, second=0.0):
    values = {side.rotation: rotation, alpha: SLENDERNESS, R: SIZE}
    return float(sp.N(expression.subs(values | {velocity: rate, acceleration: second})))


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize("lean", [0.02, 0.11, 0.2])
class TestTurnedRectangles:
    def test_column_stands_on_its_pivot_and_carries_with_its_highest_corner(self, side, lean):
        corners = turned_rectangle(side.sign * lean)
        lowest, highest = corners[corners[:, 1].argmin()], corners[corners[:, 1].argmax()]
        assert lowest[1] == pytest.approx(0, abs=1e-15)
        arm = [evaluate(x, side, side.sign * lean) for x in cap_contact(side)]
        np.testing.assert_allclose(highest - lowest, arm, rtol=1e-12)
        to_centre = [evaluate(x, side, side.sign * lean) for x in centre(side)]
        np.testing.assert_allclose(corners.mean(axis=0) - lowest, to_centre, rtol=1e-12)

    def test_cap_beam_stays_level_and_moves_with_the_highest_corners(self, side, lean):
        rests, tops = [], []
        for axis in (-2.0, 2.0):
            corners = turned_rectangle(side.sign * lean, axis)
            which = corners[:, 1].argmax()
            tops.append(corners[which])
            rests.append((CORNERS + np.array([axis, 0]))[which])
        first, second = np.subtract(tops, rests)
        np.testing.assert_allclose(first, second, rtol=1e-12)
        motion = cap_motion(side)
        derived = [evaluate(x, side, side.sign * lean) for x in (motion.u, motion.v)]
        np.testing.assert_allclose(first, derived, rtol=1e-12)

    def test_velocities_and_accelerations_by_finite_differences(self, side, lean):
        start, rate, second, step = side.sign * lean, 0.7, -1.9, 1e-4

        def top(time):
            corners = turned_rectangle(start + rate * time + second * time**2 / 2)
            return corners[corners[:, 1].argmax()]

        before, now, after = top(-step), top(0.0), top(step)
        motion = cap_motion(side)
        velocities = [evaluate(x, side, start, rate, second) for x in (motion.u_dot, motion.v_dot)]
        np.testing.assert_allclose((after - before) / (2 * step), velocities, rtol=1e-6)
        seconds = [evaluate(x, side, start, rate, second) for x in (motion.u_ddot, motion.v_ddot)]
        np.testing.assert_allclose((after - 2 * now + before) / step**2, seconds, rtol=1e-5)


def test_moment_of_inertia_by_summing_small_pieces():
    mass, pieces = 2.3, 400
    x = (np.arange(pieces) + 0.5) / pieces * 2 * HALF_WIDTH
    z = (np.arange(pieces) + 0.5) / pieces * 2 * HALF_HEIGHT
    summed = mass * (np.mean(x**2) + np.mean(z**2))
    values = {"m": mass, "b": HALF_WIDTH, "h": HALF_HEIGHT}
    expression = moment_of_inertia()
    exact = expression.subs({s: values[s.name] for s in expression.free_symbols})
    assert summed == pytest.approx(float(exact), rel=1e-5)


COLUMN, BEAM, GRAVITY = 0.9, 2.2, 9.81
PARAMETERS = {
    R: SIZE,
    alpha: SLENDERNESS,
    m_c: COLUMN,
    m_b: BEAM,
    I_o: 4 / 3 * COLUMN * SIZE**2,
    g: GRAVITY,
}


def centre_and_cap(rotation):
    """The column's centre and its carrying corner, from the pivot's place when upright."""
    sign = np.sign(rotation)
    angle = rotation - sign * SLENDERNESS
    arm = SIZE * np.array([np.sin(angle), np.cos(angle)])
    pivot = np.array([sign * SIZE * np.sin(SLENDERNESS), 0])
    return pivot + arm, pivot + 2 * arm


def energies(rotation, rate, ground):
    step = 1e-6
    ahead, behind = (centre_and_cap(rotation + way * rate * step) for way in (1, -1))
    moved = [(a - b) / (2 * step) + [ground, 0] for a, b in zip(ahead, behind, strict=True)]
    centre, cap = (velocity @ velocity for velocity in moved)
    kinetic = COLUMN * centre + COLUMN * SIZE**2 / 3 * rate**2 + BEAM * cap / 2
    here, upright = centre_and_cap(rotation), centre_and_cap(np.sign(rotation) * 1e-12)
    rises = [now[1] - then[1] for now, then in zip(here, upright, strict=True)]
    return kinetic, GRAVITY * (2 * COLUMN * rises[0] + BEAM * rises[1])


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize(("lean", "rate", "ground"), [(0.05, 0.3, 0.0), (0.25, -0.8, 0.6)])
def test_energies_are_those_of_turned_rectangles(side, lean, rate, ground):
    values = PARAMETERS | {side.rotation: side.sign * lean, velocity: rate, ground_velocity: ground}
    derived = [float(sp.N(e(side).subs(values))) for e in (kinetic_energy, potential_energy)]
    np.testing.assert_allclose(derived, energies(side.sign * lean, rate, ground), rtol=1e-7)
