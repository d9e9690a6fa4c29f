"""The second route to the equation of motion: energies only, no force but gravity named."""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.equilibrium import RECTANGULAR
from topheavy.derivation.geometry import cap_motion, centre
from topheavy.derivation.notation import (
    I_o,
    R,
    Side,
    acceleration,
    g,
    ground_velocity,
    m_b,
    m_c,
    velocity,
)


@cache
def kinetic_energy(side: Side) -> sp.Expr:
    """T of both columns and the cap-beam, above moving ground."""
    x_dot, z_dot = centre(side).applyfunc(side.time_derivative)
    cap = cap_motion(side)
    spin = (I_o - m_c * R**2) * velocity**2
    column = m_c * ((ground_velocity + x_dot) ** 2 + z_dot**2) + spin
    beam = m_b * ((ground_velocity + cap.u_dot) ** 2 + cap.v_dot**2)
    return sp.simplify((2 * column + beam) / 2)


def potential_energy(side: Side) -> sp.Expr:
    """V of both columns and the cap-beam, from the upright position."""
    rise = (centre(side) - side.upright(centre(side)))[1]
    return 2 * m_c * g * rise + m_b * g * cap_motion(side).v


@cache
def lagrange_equation(side: Side) -> sp.Eq:
    """The frame's equation of motion by Lagrange, with rectangular columns. # Eqs. (19), (22)"""
    lagrangian = kinetic_energy(side) - potential_energy(side)
    momentum = sp.diff(lagrangian, velocity)
    balance = side.time_derivative(momentum) - sp.diff(lagrangian, side.rotation)
    (motion,) = sp.solve(balance.subs(RECTANGULAR), acceleration)
    return sp.Eq(acceleration, sp.factor(sp.simplify(motion)))
