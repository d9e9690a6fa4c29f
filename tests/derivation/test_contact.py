"""The derived contact forces against the library's closed forms, and the proofs about them."""

from functools import cache

import numpy as np
import pytest
import sympy as sp

from topheavy import STANDARD_GRAVITY, Cap, Column, RockingFrame
from topheavy import contact_forces as forces_of
from topheavy import impact_impulses as impulses_of
from topheavy.derivation import (
    SIDES,
    contact_forces,
    contact_impulses,
    contact_proofs,
    equation_of_motion,
    restitution,
)
from topheavy.derivation.bodies import half_depth, span
from topheavy.derivation.contact import FORCES
from topheavy.derivation.notation import (
    R,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
)

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
