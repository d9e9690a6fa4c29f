"""The equation of motion by computer algebra: geometry, energies and impacts."""

import numpy as np
import pytest
import sympy as sp

from topheavy.derivation import (
    SIDES,
    cap_contact,
    cap_motion,
    centre,
    column_restitution,
    energy_slenderness,
    largest_slenderness,
    restitution,
)
from topheavy.derivation import geometry as derived
from topheavy.derivation.notation import R, acceleration, alpha, gamma, velocity

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
    expression = derived.moment_of_inertia()
    exact = expression.subs({s: values[s.name] for s in expression.free_symbols})
    assert summed == pytest.approx(float(exact), rel=1e-5)


def clockwise(arm, impulse):
    return arm[1] * impulse[0] - arm[0] * impulse[1]


def velocity_after(sign, slenderness, mass_ratio, *, spacing=3.0, depth=0.25):
    """θ̇ after an impact that changes over to the side `sign`, for θ̇ = 1 before."""
    column, beam = 1.0, 2 * mass_ratio
    b, h = np.sin(slenderness), np.cos(slenderness)
    new = np.array([-sign * b, h])  # from the new pivot to the centre; the old pivot is across
    old = np.array([sign * b, h])

    def velocity(arm, rate):
        return rate * np.array([arm[1], -arm[0]])

    def residual(unknowns):
        after, impulses = unknowns[0], unknowns[1:].reshape(4, 2)
        equations = []
        for ground, cap in zip(impulses[:2], impulses[2:], strict=True):
            jump = velocity(new, after) - velocity(old, 1.0)
            equations += [*(ground - cap - column * jump)]
            moment = clockwise(-new, ground) - clockwise(new, cap)
            equations.append(moment - column / 3 * (after - 1.0))
        jump = velocity(2 * new, after) - velocity(2 * old, 1.0)
        equations += [*(impulses[2] + impulses[3] - beam * jump)]
        arms = [(end * spacing / 2 - sign * b, -depth) for end in (-1, 1)]
        equations.append(sum(clockwise(*pair) for pair in zip(arms, impulses[2:], strict=True)))
        return np.array(equations)

    constant = residual(np.zeros(9))
    matrix = np.stack([residual(row) - constant for row in np.eye(9)], axis=1)
    return np.linalg.solve(matrix, -constant)[0]


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize("slenderness", [0.05, 0.27, 0.8, 1.2])
@pytest.mark.parametrize("mass_ratio", [1e-9, 0.4, 7.0])
def test_impulses_on_three_bodies_give_the_restitution(side, slenderness, mass_ratio):
    derived = restitution(side).subs({alpha: slenderness, gamma: mass_ratio})
    solved = velocity_after(side.sign, slenderness, mass_ratio)
    assert solved == pytest.approx(float(derived), rel=1e-7)


@pytest.mark.parametrize("mass_ratio", [0.1, 0.434, 5.0, 300.0])
class TestSlendernessLimits:
    def test_restitution_changes_sign_at_the_largest_slenderness(self, mass_ratio):
        limit = float(largest_slenderness().subs(gamma, mass_ratio))
        assert velocity_after(1, limit - 1e-6, mass_ratio) > 0
        assert velocity_after(1, limit + 1e-6, mass_ratio) < 0

    def test_frame_and_column_lose_alike_at_the_energy_slenderness(self, mass_ratio):
        limit = float(energy_slenderness().subs(gamma, mass_ratio))
        for slenderness, frame_loses_more in ((limit - 1e-6, True), (limit + 1e-6, False)):
            frame = velocity_after(1, slenderness, mass_ratio) ** 2
            column = float(column_restitution().subs(alpha, slenderness)) ** 2
            assert (frame < column) == frame_loses_more
