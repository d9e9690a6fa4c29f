"""The equation of motion by dynamic equilibrium: Eqs. (1)–(3) for the column, (10)–(23) for the
frame, (24) for its size."""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.bodies import GROUND_1, column_balance, frame_balance, solve
from topheavy.derivation.geometry import cap_motion, centre
from topheavy.derivation.notation import (
    NEGATIVE,
    I_o,
    R,
    Side,
    acceleration,
    g,
    gamma,
    ground_acceleration,
    m_b,
    m_c,
    velocity,
)

RECTANGULAR = {I_o: sp.Rational(4, 3) * m_c * R**2, m_b: 2 * gamma * m_c}
"""The inertia of a rectangular column, and γ = m_b/2m_c."""

_LOADS = sp.Matrix([ground_acceleration, g])


def _centre_acceleration(side: Side) -> sp.Matrix:
    twice = centre(side)
    for _ in range(2):
        twice = twice.applyfunc(side.time_derivative)
    return twice + _LOADS


@cache
def column_motion(side: Side) -> sp.Expr:
    """θ̈ of the solitary column of any inertia I_o and mass m_c. # Eqs. (1)–(3)"""
    balance = column_balance(
        side, _centre_acceleration(side), acceleration, GROUND_1, sp.zeros(2, 1)
    )
    return sp.factor(solve(balance, acceleration)[acceleration])


def frame_equilibrium(side: Side) -> list[sp.Expr]:
    """The frame's balances of force and of the columns' moments, which vanish. # Eqs. (10)–(18)"""
    cap = cap_motion(side)
    cap_acceleration = sp.Matrix([cap.u_ddot, cap.v_ddot]) + _LOADS
    return frame_balance(side, _centre_acceleration(side), acceleration, cap_acceleration)


@cache
def frame_motion(side: Side) -> dict[sp.Symbol, sp.Expr]:
    """θ̈ and all forces of the frame, in θ, θ̇, the ground's acceleration and F_z1, which is free.

    The cap-beam's moment equilibrium is left out; it would fix F_z1, and nothing else here needs
    it. # Eqs. (10)–(18) for θ < 0, Eqs. (20), (21) for θ > 0
    """
    return solve(frame_equilibrium(side), acceleration)


@cache
def equation_of_motion(side: Side) -> sp.Eq:
    """The frame's equation of motion, with rectangular columns. # Eqs. (19), (22), (23)"""
    return sp.Eq(acceleration, sp.factor(frame_motion(side)[acceleration].subs(RECTANGULAR)))


def squared_frequency(motion: sp.Expr, side: Side) -> sp.Expr:
    """p² or p̂² of an equation of motion: what multiplies −sin(α sgn θ − θ). # Eqs. (3), (23)"""
    restoring = -side.sign * sp.sin(side.lean)
    return sp.simplify(motion.subs(ground_acceleration, 0) / restoring)


def frequency_ratio() -> sp.Expr:
    """p̂/p, the frame's frequency parameter over its column's, in γ. # Eq. (23)"""
    frame = squared_frequency(frame_motion(NEGATIVE)[acceleration], NEGATIVE)
    column = squared_frequency(column_motion(NEGATIVE), NEGATIVE)
    return sp.sqrt(sp.factor((frame / column).subs(RECTANGULAR)))


def size_ratio() -> sp.Expr:
    """R̂/R, the size of the column that rocks like the frame over that of the frame's, in γ.

    p² is inversely proportional to R for columns of the same shape. # Eq. (24)
    """
    return 1 / frequency_ratio() ** 2


def uplift_acceleration(motion: sp.Expr, side: Side) -> sp.Expr:
    """The ground acceleration at which θ̈ of the upright structure turns towards this side."""
    (threshold,) = sp.solve(side.upright(motion), ground_acceleration)
    return sp.simplify(threshold)


def quadratic_terms(side: Side) -> tuple[sp.Expr, sp.Expr]:
    """The terms in θ̇² that ü and v̈ each contribute to the cap-beam's moment. # Eqs. (17), (18)"""
    cap = cap_motion(side)
    moments = (-cap.u_ddot * sp.cos(side.lean), -side.sign * cap.v_ddot * sp.sin(side.lean))
    first, second = (sp.expand(moment).coeff(velocity, 2) for moment in moments)
    return first, second
