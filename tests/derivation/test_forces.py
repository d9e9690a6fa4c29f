"""Forces by computer algebra: equilibrium, contacts and base shear."""

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp

from derivation import consequences
from derivation.mechanics import (
    equation_of_motion,
    frame_motion,
    lagrange_equation,
    motion_of_columns,
    restitution,
)
from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    F_x1,
    F_x2,
    F_z1,
    F_z2,
    I_o,
    N,
    R,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_b,
    m_c,
    velocity,
    vertical_acceleration,
)
from topheavy import STANDARD_GRAVITY, Cap, Column, RockingFrame
from topheavy import impact_impulses as impulses_of
from topheavy.forces import base_shear_slope
from topheavy.forces import forces_at as forces_of


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


def impact(sign, slenderness, mass_ratio, *, spacing=3.0, depth=0.25):
    """θ̇ after an impact that changes over to the side `sign`, for θ̇ = 1 before, and impulses."""
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
    return np.linalg.solve(matrix, -constant)


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize("slenderness", [0.05, 0.27, 0.8, 1.2])
@pytest.mark.parametrize("mass_ratio", [1e-9, 0.4, 7.0])
def test_impulses_on_three_bodies_give_the_restitution(side, slenderness, mass_ratio):
    derived = restitution(side).subs({alpha: slenderness, gamma: mass_ratio})
    solved = impact(side.sign, slenderness, mass_ratio)[0]
    assert solved == pytest.approx(float(derived), rel=1e-7)


CASES = [(0.05, 0.3), (0.27, 0.434), (0.6, 5.0)]  # α, γ
CAP, SIZE, COLUMN_MASS = Cap(9.0, 0.6), 2.4, 1.7


def frame_of(slenderness, mass_ratio):
    column = Column(SIZE * np.sin(slenderness), SIZE * np.cos(slenderness))
    return RockingFrame(column, mass_ratio)


def components(forces):
    return np.stack([forces.horizontal, forces.vertical], axis=-1).ravel()


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize(("slenderness", "mass_ratio"), CASES)
def test_forces_of_three_bodies_are_the_librarys(side, slenderness, mass_ratio):
    lean, rate, ground = 0.4 * slenderness, 0.3, -0.6
    beam = 2 * mass_ratio * COLUMN_MASS
    state = SIZE, slenderness, COLUMN_MASS, beam, lean, rate, ground * STANDARD_GRAVITY
    shape = {"spacing": CAP.span, "depth": CAP.half_depth}
    _, *solved = three_bodies(side.sign, state, **shape)
    weight = (2 * COLUMN_MASS + beam) * STANDARD_GRAVITY
    frame = frame_of(slenderness, mass_ratio)
    ours = components(forces_of(frame, CAP, side.sign * lean, rate, ground))
    np.testing.assert_allclose(ours * weight, solved, rtol=1e-10, atol=1e-11 * weight)


@pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
@pytest.mark.parametrize(("slenderness", "mass_ratio"), CASES)
def test_impulses_on_three_bodies_are_the_librarys(side, slenderness, mass_ratio):
    """The size of a column of 1 kg and 1 m in `impact`; impulses are per mass of the frame."""
    _, *solved = impact(side.sign, slenderness, mass_ratio, spacing=3.0, depth=0.25)
    column = Column(np.sin(slenderness), np.cos(slenderness))
    ours = components(impulses_of(RockingFrame(column, mass_ratio), Cap(3.0, 0.25), side.sign))
    expected = side.sign * np.array(solved) / (2 * (1 + mass_ratio))
    np.testing.assert_allclose(ours, expected, rtol=1e-10, atol=1e-11)


def test_many_columns_move_as_stated_over_ground_that_moves_up():
    """The equation of N columns against numbers: p̂², the push and the vertical acceleration."""
    values = {N: 5, alpha: 0.2, R: 2.0, g: 9.81, m_c: 1.0, m_b: 7.5, I_o: 16 / 3}
    values |= {vertical_acceleration: -1.7, ground_acceleration: 3.0}
    for side in SIDES:
        motion = motion_of_columns(side).subs(values | {side.rotation: side.sign * 0.05})
        p_squared = 4.0 / 5.5 * 3.0 * 9.81 / 8.0
        stated = side.sign * math.sin(0.15) * (1.0 - 1.7 / 9.81) + 3.0 / 9.81 * math.cos(0.15)
        assert float(motion) == pytest.approx(-p_squared * stated)


@cache
def derived_slope(side):
    return sp.diff(consequences.after_uplift(side), ground_acceleration)


@pytest.mark.parametrize("slenderness", [0.05, math.atan(1 / 6), 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
def test_library_follows_the_derivation(slenderness, ratio):
    frame = RockingFrame(Column(math.sin(slenderness), math.cos(slenderness)), ratio)
    given = {alpha: slenderness, gamma: ratio, g: 1.0}
    for side in SIDES:
        derived = float(derived_slope(side).subs(given))
        assert base_shear_slope(frame) == pytest.approx(derived, rel=1e-12)
