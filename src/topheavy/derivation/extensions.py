"""The frame of N columns, and vertical ground acceleration: what the paper's derivation extends to.

The columns are equal and carry the cap beam at equal corners, so that they turn alike; N is a
symbol, γ = m_b/(N m_c). Makris & Vassiliou (2013) give the equation of N columns by Lagrange.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.bodies import turning
from topheavy.derivation.geometry import cap_contact, cap_motion, centre
from topheavy.derivation.notation import (
    I_o,
    R,
    Side,
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

N = sp.Symbol("N", positive=True)
vertical_acceleration = sp.Symbol(r"\ddot{v}_g", real=True)
_ON_CAP = sp.Matrix(sp.symbols("S_x S_z", real=True))  # of all columns together
_LOADS = sp.Matrix([ground_acceleration, g + vertical_acceleration])
RECTANGULAR = {I_o: sp.Rational(4, 3) * m_c * R**2, m_b: N * gamma * m_c}
"""The inertia of a rectangular column, and γ = m_b/(N m_c)."""


def _twice(point: sp.ImmutableMatrix, side: Side) -> sp.Matrix:
    return point.applyfunc(side.time_derivative).applyfunc(side.time_derivative)


@cache
def frame_of_columns(side: Side) -> sp.Expr:
    """θ̈ of a cap beam on N columns over ground that accelerates horizontally and vertically.

    Each column's moments about its own base corner leave out the ground's force; their sum has the
    sum of the forces on the cap beam, which its own balance gives. The cap's moment is not needed.
    """
    column = m_c * (_twice(centre(side), side) + _LOADS)
    spin = (I_o - m_c * R**2) * acceleration
    cap = m_b * (_twice(cap_contact(side), side) + _LOADS)
    moments = N * (turning(centre(side), column) + spin) + turning(cap_contact(side), _ON_CAP)
    balance = moments.subs(dict(zip(_ON_CAP, cap, strict=True)))
    (motion,) = sp.solve(balance.subs(RECTANGULAR), acceleration, simplify=False)
    return motion


@cache
def lagrange_of_columns(side: Side) -> sp.Expr:
    """The same by energies: the ground enters by its velocities."""
    v_x, v_z = sp.symbols("v_x v_z", real=True)
    ground = sp.Matrix([v_x, v_z])
    cap = sp.Matrix([cap_motion(side).u, cap_motion(side).v])
    kinetic = 0
    for number, mass, point in ((N, m_c, centre(side)), (1, m_b, cap)):
        rate = sp.Matrix(point.applyfunc(side.time_derivative)) + ground
        kinetic += number * mass * (rate.T * rate)[0] / 2
    kinetic += N * (I_o - m_c * R**2) * velocity**2 / 2
    rise = (centre(side) - side.upright(centre(side)))[1]
    potential = N * m_c * g * rise + m_b * g * cap_motion(side).v
    momentum = sp.diff(kinetic, velocity)
    of_ground = {v_x: ground_acceleration, v_z: vertical_acceleration}
    change = side.time_derivative(momentum) + sum(
        sp.diff(momentum, rate) * second for rate, second in of_ground.items()
    )
    balance = change - sp.diff(kinetic - potential, side.rotation)
    (motion,) = sp.solve(sp.expand(balance).subs(RECTANGULAR), acceleration, simplify=False)
    return motion


@cache
def restitution_of_columns(side: Side) -> sp.Expr:
    """√r of a cap beam on N columns that changes over to the side, as Eq. (25) has it for two.

    Each column's angular momentum about its new base corner changes by the impulse on the cap.
    """

    def rates(of: Side, point: sp.ImmutableMatrix, value: sp.Symbol) -> sp.Matrix:
        rate = point.applyfunc(of.time_derivative)
        return of.upright(sp.Matrix(rate)).subs(velocity, value)

    old, new = side.other, side
    jump = rates(new, centre(new), velocity_after) - rates(old, centre(old), velocity_before)
    beam = rates(new, cap_contact(new), velocity_after)
    beam -= rates(old, cap_contact(old), velocity_before)
    spin = (I_o - m_c * R**2) * (velocity_after - velocity_before)
    arm, top = new.upright(sp.Matrix(centre(new))), new.upright(sp.Matrix(cap_contact(new)))
    balance = N * (turning(arm, m_c * jump) + spin) + turning(top, m_b * beam)
    (after,) = sp.solve(balance.subs(RECTANGULAR), velocity_after)
    return sp.simplify(after / velocity_before)


def printed_motion(side: Side) -> sp.Expr:
    """Eq. (23) with its p̂² and p², and g + v̈_g in place of g in the restoring moment."""
    p_squared = (1 + 2 * gamma) / (1 + 3 * gamma) * 3 * g / (4 * R)
    restoring = side.sign * sp.sin(side.lean) * (1 + vertical_acceleration / g)
    return -p_squared * (restoring + ground_acceleration / g * sp.cos(side.lean))


def printed_restitution() -> sp.Expr:
    """Eq. (25)."""
    column = 1 - sp.Rational(3, 2) * sp.sin(alpha) ** 2
    return (column + 3 * gamma * sp.cos(2 * alpha)) / (1 + 3 * gamma)
