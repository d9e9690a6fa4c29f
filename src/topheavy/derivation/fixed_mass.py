"""The cap's mass fixed rigidly to the top of one column, from the same balances as the frame.

Column and cap are two bodies that turn by the same θ about the column's corner. Between them act a
force (F_x1, F_z1), at the corner where the frame's cap beam would rest, and a couple C. Six
balances give θ̈ (or θ̇_2 at an impact), the force, the couple and the reaction of the ground. Neither
the common centre of gravity nor a common moment of inertia is put in; α', p' and √r' are found.

The cap weighs m_b/2 = γ m_c. Its centre is d above the top of the column, and its central moment of
inertia is I_b; both are zero for a mass that is concentrated at the top.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import sympy as sp

from topheavy.derivation.bodies import CAP_1, GROUND_1, column_balance, half_depth, solve, turning
from topheavy.derivation.equilibrium import RECTANGULAR, uplift_acceleration
from topheavy.derivation.geometry import above_top, cap_contact, centre
from topheavy.derivation.notation import (
    NEGATIVE,
    POSITIVE,
    CircleField,
    F_z1,
    I_o,
    R,
    Side,
    acceleration,
    g,
    ground_acceleration,
    ground_velocity,
    m_b,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
)

I_b = sp.Symbol("I_b", positive=True)
COUPLE = sp.Symbol("C", real=True)
CONCENTRATED = {half_depth: 0, I_b: 0}
"""The mass at a point, the top of the column's axis."""

_LOADS = sp.Matrix([ground_acceleration, g])


def _balance(side: Side, column: sp.Matrix, cap: sp.Matrix, angular: Any) -> list[sp.Expr]:
    """Newton and Euler for column and cap, as six expressions that vanish."""
    *forces, moments = column_balance(side, column, angular, GROUND_1, CAP_1)
    arm = cap_contact(side) - above_top(side, half_depth)
    on_cap = turning(arm, CAP_1) + COUPLE - I_b * angular
    return [*forces, moments - COUPLE, *(CAP_1 - m_b / 2 * cap), on_cap]


def _rates(side: Side, point: sp.Matrix, order: int) -> sp.Matrix:
    for _ in range(order):
        point = point.applyfunc(side.time_derivative)
    return point


@cache
def fixed_motion(side: Side) -> sp.Expr:
    """θ̈ of the rectangular column with the fixed mass, in θ and the ground's acceleration."""
    column, cap = (
        _rates(side, point, 2) + _LOADS for point in (centre(side), above_top(side, half_depth))
    )
    balance = _balance(side, column, cap, acceleration)
    motion = solve(balance, acceleration, COUPLE, F_z1, only=acceleration)[acceleration]
    return sp.factor(motion.subs(RECTANGULAR))


@cache
def fixed_restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r' = θ̇_2/θ̇_1 of the column with the fixed mass that changes over to the side."""

    def jump(before: sp.Matrix, after: sp.Matrix) -> sp.Matrix:
        new = side.upright(_rates(side, after, 1)).subs(velocity, velocity_after)
        old = side.other.upright(_rates(side.other, before, 1))
        return new - old.subs(velocity, velocity_before)

    column = jump(centre(side.other), centre(side))
    cap = jump(above_top(side.other, half_depth), above_top(side, half_depth))
    balance = _balance(side, column, cap, velocity_after - velocity_before)
    upright = [side.upright(equation) for equation in balance]
    after = solve(upright, velocity_after, COUPLE, F_z1, only=velocity_after)[velocity_after]
    ratio = sp.expand_trig(after.subs(RECTANGULAR) / velocity_before)
    return sp.factor(CircleField([ratio]).reduced(ratio))


@cache
def fixed_tangent(side: Side = NEGATIVE) -> sp.Expr:
    """tan α': the ground acceleration at which it uplifts, over g."""
    return sp.factor(-side.sign * uplift_acceleration(fixed_motion(side), side) / g)


@cache
def fixed_fourth_power(side: Side = NEGATIVE) -> sp.Expr:
    """p'⁴: θ̈ at rest is −p'² sin α' sgn θ, and its derivative by |θ| is p'² cos α' sgn θ."""
    free = fixed_motion(side).subs(ground_acceleration, 0)
    slope = side.upright(sp.diff(free, side.rotation))
    power = sp.expand_trig(side.upright(free) ** 2 + slope**2)
    return sp.factor(CircleField([power]).reduced(power))


@cache
def fixed_energies(side: Side) -> tuple[sp.Expr, sp.Expr]:
    """T above moving ground, and V from the upright position, of column and cap."""
    kinetic = (I_o - m_c * R**2 + I_b) * velocity**2 / 2
    potential = sp.Integer(0)
    for mass, point in ((m_c, centre(side)), (m_b / 2, above_top(side, half_depth))):
        x_dot, z_dot = _rates(side, point, 1)
        kinetic += mass * ((ground_velocity + x_dot) ** 2 + z_dot**2) / 2
        potential += mass * g * (point - side.upright(point))[1]
    return kinetic, potential


def fixed_lagrange(side: Side) -> sp.Expr:
    """θ̈ of the same by energies alone."""
    kinetic, potential = fixed_energies(side)
    momentum = sp.diff(kinetic, velocity)
    balance = side.time_derivative(momentum) - sp.diff(kinetic - potential, side.rotation)
    balance = balance.subs(RECTANGULAR)  # linear in θ̈
    return -balance.subs(acceleration, 0) / sp.diff(balance, acceleration)
