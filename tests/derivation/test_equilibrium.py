"""The equation of motion against Newton–Euler for the three bodies, solved in numbers."""

import numpy as np
import pytest
import sympy as sp

from topheavy.derivation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    equation_of_motion,
    frame_motion,
    lagrange_equation,
)
from topheavy.derivation.notation import (
    F_x1,
    F_x2,
    F_z1,
    F_z2,
    I_o,
    R,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_b,
    m_c,
    velocity,
)


def clockwise(arm, force):
    return arm[1] * force[0] - arm[0] * force[1]


def rigid_body(arm, rotation_rate, rotation_acceleration):
    """Acceleration of a point of a body that turns clockwise about a fixed pivot."""
    return rotation_acceleration * np.array([arm[1], -arm[0]]) - rotation_rate**2 * np.array(arm)


def three_bodies(sign, state, *, spacing=3.0, depth=0.25):
    """Solve the nine balances for θ̈ and the forces: ground 1 and 2, then cap 1 and 2."""
    size, slenderness, column, beam, lean, rate, ground = state
    gravity, inertia = 9.81, column * size**2 / 3
    angle = sign * lean - sign * slenderness  # of the diagonal, clockwise from the vertical
    centre = size * np.array([np.sin(angle), np.cos(angle)])
    loads = np.array([ground, gravity])

    def residual(unknowns):
        second, forces = unknowns[0], unknowns[1:].reshape(4, 2)
        equations = []
        for at_ground, on_cap in zip(forces[:2], forces[2:], strict=True):
            moving = column * (rigid_body(centre, rate, second) + loads)
            equations += [*(at_ground - on_cap - moving)]
            moment = clockwise(-centre, at_ground) - clockwise(centre, on_cap)
            equations.append(moment - inertia * second)
        moving = beam * (rigid_body(2 * centre, rate, second) + loads)
        equations += [*(forces[2] + forces[3] - moving)]
        shift = -sign * size * np.sin(slenderness)
        arms = [(shift - spacing / 2, -depth), (shift + spacing / 2, -depth)]
        equations.append(sum(clockwise(*pair) for pair in zip(arms, forces[2:], strict=True)))
        return np.array(equations)

    constant = residual(np.zeros(9))
    matrix = np.stack([residual(row) - constant for row in np.eye(9)], axis=1)
    return np.linalg.solve(matrix, -constant)


def states(number=8):
    random = np.random.default_rng(20140101)
    for _ in range(number):
        slenderness = random.uniform(0.05, 0.9)
        size, column, beam = random.uniform(0.2, 8, 3)
        yield (
            size,
            slenderness,
            column,
            beam,
            random.uniform(0, 1.5 * slenderness),
            *random.normal(0, 2, 2),
        )


def values(side, state):
    size, slenderness, column, beam, lean, rate, ground = state
    return {
        side.rotation: side.sign * lean,
        R: size,
        alpha: slenderness,
        m_c: column,
        m_b: beam,
        I_o: 4 / 3 * column * size**2,
        gamma: beam / (2 * column),
        g: 9.81,
        velocity: rate,
        ground_acceleration: ground,
    }


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
class TestThreeBodies:
    @pytest.mark.parametrize("route", [equation_of_motion, lagrange_equation])
    def test_motion_of_three_bodies_is_that_of_the_equation(self, side, route):
        for state in states():
            derived = float(sp.N(route(side).rhs.subs(values(side, state))))
            assert derived == pytest.approx(three_bodies(side.sign, state)[0], rel=1e-9)

    def test_forces_of_three_bodies_are_those_derived(self, side):
        motion = frame_motion(side)
        for state in states(4):
            solved = three_bodies(side.sign, state)
            known = values(side, state) | {F_z1: solved[6]}
            derived = [float(sp.N(motion[force].subs(known))) for force in (F_x1, F_x2, F_z2)]
            np.testing.assert_allclose(solved[[5, 7, 8]], derived, rtol=1e-8, atol=1e-9)

    def test_shape_of_the_cap_beam_moves_the_forces_but_not_the_frame(self, side):
        state = next(states())
        slim = three_bodies(side.sign, state, spacing=3.0, depth=0.1)
        stout = three_bodies(side.sign, state, spacing=2.0, depth=0.9)
        assert slim[0] == pytest.approx(stout[0], rel=1e-12)
        assert abs(slim[6] - stout[6]) > 1e-3


def test_frame_without_a_cap_beam_is_housners_column():
    state = (2.0, 0.3, 1.5, 1e-12, 0.1, 0.4, 0.0)
    expected = 3 * 9.81 / (4 * 2.0) * np.sin(0.3 - 0.1)
    assert three_bodies(NEGATIVE.sign, state)[0] == pytest.approx(expected, rel=1e-9)
    assert three_bodies(POSITIVE.sign, state)[0] == pytest.approx(-expected, rel=1e-9)
