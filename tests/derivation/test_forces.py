"""Forces by computer algebra: equilibrium, contacts and base shear."""

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp

from topheavy import STANDARD_GRAVITY, Cap, Column, RockingFrame, base_shear_slope
from topheavy import contact_forces as forces_of
from topheavy import impact_impulses as impulses_of
from topheavy.derivation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    contact_forces,
    contact_impulses,
    contact_proofs,
    equation_of_motion,
    frame_motion,
    lagrange_equation,
    restitution,
)
from topheavy.derivation import base_shear as proofs
from topheavy.derivation.bodies import half_depth, span
from topheavy.derivation.contact import FORCES
from topheavy.derivation.notation import (
    F_x1,
    F_x2,
    F_z1,
    F_z2,
    I_o,
    R,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_b,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
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


sides = pytest.mark.parametrize("side", SIDES, ids=lambda side: side.label)
CASES = [(0.05, 0.3), (0.27, 0.434), (0.6, 5.0)]  # α, γ
CAP, SIZE, COLUMN_MASS = Cap(9.0, 0.6), 2.4, 1.7


def known(slenderness, mass_ratio):
    shape = {span: CAP.span, half_depth: CAP.half_depth, R: SIZE, alpha: slenderness}
    return shape | {gamma: mass_ratio, m_c: COLUMN_MASS, g: STANDARD_GRAVITY}


def frame_of(slenderness, mass_ratio):
    column = Column(SIZE * np.sin(slenderness), SIZE * np.cos(slenderness))
    return RockingFrame(column, mass_ratio)


@cache
def numerically(solved, side, results):
    """What a solution gives for some results, as a function of the values of its symbols."""
    found = [solved(side)[result] for result in results]
    symbols = sorted(set().union(*(one.free_symbols for one in found)), key=str)
    evaluated = sp.lambdify(symbols, found, cse=True)
    return lambda values: evaluated(*(float(values[symbol]) for symbol in symbols))


def components(forces):
    return np.array([[c.horizontal, c.vertical] for c in forces.contacts]).ravel()


@sides
@pytest.mark.parametrize(("slenderness", "mass_ratio"), CASES)
def test_derived_forces_are_the_librarys(side, slenderness, mass_ratio):
    theta, rate, ground = side.sign * 0.4 * slenderness, 0.3, -0.6
    state = {side.rotation: theta, velocity: rate, ground_acceleration: ground * STANDARD_GRAVITY}
    values = known(slenderness, mass_ratio) | state
    *derived, turn = numerically(contact_forces, side, (*FORCES, acceleration))(values)
    weight = 2 * COLUMN_MASS * (1 + mass_ratio) * STANDARD_GRAVITY
    given = components(forces_of(frame_of(slenderness, mass_ratio), CAP, theta, rate, ground))
    np.testing.assert_allclose(given * weight, derived, rtol=1e-10, atol=1e-11 * weight)
    motion = float(sp.N(equation_of_motion(side).rhs.subs(values)))
    assert turn == pytest.approx(motion, rel=1e-12)


@sides
@pytest.mark.parametrize(("slenderness", "mass_ratio"), CASES)
def test_derived_impulses_are_the_librarys(side, slenderness, mass_ratio):
    before = side.sign * 0.7
    values = known(slenderness, mass_ratio) | {velocity_before: before}
    *derived, after = numerically(contact_impulses, side, (*FORCES, velocity_after))(values)
    mass = 2 * COLUMN_MASS * (1 + mass_ratio)
    given = components(impulses_of(frame_of(slenderness, mass_ratio), CAP, before))
    np.testing.assert_allclose(given * mass, derived, rtol=1e-10, atol=1e-11)
    ratio = float(restitution().subs({alpha: slenderness, gamma: mass_ratio}))
    assert after / before == pytest.approx(ratio, rel=1e-12)


def _spoiled(symbol, factor):
    return lambda solution: solution | {symbol: factor * solution[symbol]}


WRONG = [
    ("determinant", lambda value: 0 * value, "nine_balances_determine_the_contact_forces"),
    ("contact_forces", _spoiled(acceleration, 2), "contact_forces_keep_the_motion"),
    ("contact_impulses", _spoiled(velocity_after, 2), "contact_forces_keep_the_motion"),
    ("contact_forces", _spoiled(FORCES[5], 2), "seats_share_the_cap_by_its_line_of_thrust"),
    ("contact_impulses", _spoiled(FORCES[4], 2), "seats_share_the_cap_by_its_line_of_thrust"),
    (
        "contact_forces",
        _spoiled(FORCES[2], sp.Rational(101, 100)),
        "quasistatic_uplift_asks_for_the_slope_of_the_diagonal",
    ),
    (
        "contact_forces",
        _spoiled(FORCES[0], sp.Rational(101, 100)),
        "frame_needs_less_friction_than_its_column_to_uplift",
    ),
    (
        "contact_forces",
        _spoiled(FORCES[6], sp.Rational(101, 100)),
        "massless_columns_push_along_their_diagonals",
    ),
    ("contact_impulses", _spoiled(FORCES[5], -1), "impact_presses_feet_and_seats_together"),
    ("contact_impulses", _spoiled(FORCES[7], 2), "impact_opens_no_seat_of_a_wide_bay"),
]


@pytest.mark.parametrize(("name", "spoil", "proof"), WRONG, ids=[f"{w[2]}-{w[0]}" for w in WRONG])
def test_a_proof_fails_on_a_wrong_result(monkeypatch, name, spoil, proof):
    right = getattr(contact_proofs, name)
    monkeypatch.setattr(contact_proofs, name, lambda side: spoil(right(side)))
    assert not getattr(contact_proofs, proof)()


@cache
def derived_slope(side):
    return sp.diff(proofs.after_uplift(side), ground_acceleration)


@pytest.mark.parametrize("slenderness", [0.05, math.atan(1 / 6), 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
def test_library_follows_the_derivation(slenderness, ratio):
    frame = RockingFrame(Column(math.sin(slenderness), math.cos(slenderness)), ratio)
    given = {alpha: slenderness, gamma: ratio, g: 1.0}
    for side in SIDES:
        derived = float(derived_slope(side).subs(given))
        assert base_shear_slope(frame) == pytest.approx(derived, rel=1e-12)
