"""The cap's mass fixed rigidly to the top of one column, from the same balances as the frame.

Column and cap turn by the same θ about the column's corner. The common centre of gravity and the
formulas for α', p' and √r' are results, not assumptions.

The cap weighs γ m_c, that of the frame whose cap beam has the same mass for each column. Its centre
is d above the top of the column, and its central moment of inertia is I_b; both are zero for a mass
that is concentrated at the top.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from derivation.mechanics import (
    LOADS,
    RECTANGULAR,
    above_top,
    centre,
    jump,
    moment,
    solved,
    uplift_acceleration,
)
from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    I_o,
    R,
    Side,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    half_depth,
    is_identically_zero,
    m_c,
    velocity_after,
    velocity_before,
    vertical_acceleration,
)

I_b = sp.Symbol("I_b", positive=True)
_CAP = gamma * m_c


def _masses(side: Side) -> tuple[tuple[sp.Expr, sp.ImmutableMatrix], ...]:
    """Each mass, and its centre from the pivot."""
    return (m_c, centre(side)), (_CAP, above_top(side, half_depth))


@cache
def fixed_motion(side: Side) -> sp.Expr:
    """θ̈ of the rectangular column with the fixed mass, in θ and the ground's acceleration.

    By Steiner's theorem the inertia about the corner is I_o + I_b + γ m_c times the cap's distance
    squared.
    """
    top = above_top(side, half_depth)
    inertia = I_o + I_b + _CAP * top.dot(top)
    loads = sum(moment(point, mass * LOADS) for mass, point in _masses(side))
    balance = (inertia * acceleration + loads).subs(vertical_acceleration, 0)
    return solved(balance.subs(RECTANGULAR), acceleration)


@cache
def fixed_restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r' = θ̇_2/θ̇_1 of the column with the fixed mass: angular momentum about the new corner."""
    balance = (I_o - m_c * R**2 + I_b) * (velocity_after - velocity_before)
    for (mass, after), (_, before) in zip(_masses(side), _masses(side.other), strict=True):
        balance += mass * moment(side.upright(after), jump(side, before, after))
    return solved(balance.subs(RECTANGULAR), velocity_after) / velocity_before


@cache
def fixed_tangent(side: Side = NEGATIVE) -> sp.Expr:
    """tan α': the ground acceleration at which it uplifts, over g."""
    return sp.factor(-side.sign * uplift_acceleration(fixed_motion(side), side) / g)


def fixed_mass_rocks_as_one_column() -> bool:
    """Column and fixed cap obey θ̈ = −p'² {sin(α' sgn θ − θ) + ü_g/g cos(α' sgn θ − θ)}, Eq. (3).

    Here p'² = M g R'/I and tan α' = B/H, with the centre of gravity at R' sin α' = B beside the
    corner and R' cos α' = H above it, and I about the corner.
    """
    mass, beside, height = m_c + _CAP, R * sp.sin(alpha), 2 * R * sp.cos(alpha) + half_depth
    above = (m_c * R * sp.cos(alpha) + _CAP * height) / mass
    inertia = sp.Rational(4, 3) * m_c * R**2 + I_b + _CAP * (beside**2 + height**2)  # by Steiner
    identities = [is_identically_zero(fixed_tangent() - beside / above, NEGATIVE)]
    for side in SIDES:
        cos, sin = sp.cos(side.rotation), side.sign * sp.sin(side.rotation)
        # R' sin(α' − |θ|) and R' cos(α' − |θ|)
        across, along = beside * cos - above * sin, above * cos + beside * sin
        eq3 = -mass / inertia * (g * side.sign * across + ground_acceleration * along)
        identities.append(is_identically_zero(fixed_motion(side) - eq3, side))
    return all(identities)


def fixed_mass_lowers_the_uplift_acceleration() -> bool:
    """tan α' = tan α (1 + γ)/(1 + 2γ) at most: it falls with γ and d, from tan α to (tan α)/2.

    The bound is reached by a mass concentrated at the top; as γ → ∞ it tends to (tan α)/2.
    """
    concentrated = fixed_tangent().subs({half_depth: 0, I_b: 0})  # at the top of the axis
    stated = sp.tan(alpha) * (1 + gamma) / (1 + 2 * gamma)
    sine, cosine = sp.symbols("s c", positive=True)
    plain = fixed_tangent().subs({sp.sin(alpha): sine, sp.cos(alpha): cosine})
    plain = plain.subs(sp.tan(alpha), sine / cosine)
    falls = [sp.factor(sp.diff(plain, by)).is_negative for by in (gamma, half_depth)]
    ends = (stated.subs(gamma, 0), sp.limit(stated, gamma, sp.oo))
    reached = ends == (sp.tan(alpha), sp.tan(alpha) / 2)
    return reached and all(falls) and is_identically_zero(concentrated - stated, NEGATIVE)
