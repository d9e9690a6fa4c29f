"""Newton–Euler for the three bodies of the frame: two columns and the cap-beam.

The same balance holds for forces, with accelerations, and at an impact for impulses, with jumps
of velocity. F_x (to the right) and F_z (upward) act on the cap-beam by column 1 and 2, on either
side of the motion. The opposite forces and the ground reactions at the pivots act on the columns.
"""

from __future__ import annotations

from typing import Any

import sympy as sp

from topheavy.derivation.geometry import cap_contact, centre
from topheavy.derivation.notation import (
    CircleField,
    F_x1,
    F_x2,
    F_z1,
    F_z2,
    I_o,
    R,
    Side,
    alpha,
    m_b,
    m_c,
)

GROUND_1 = sp.Matrix(sp.symbols("G_{x1} G_{z1}", real=True))
GROUND_2 = sp.Matrix(sp.symbols("G_{x2} G_{z2}", real=True))
CAP_1 = sp.Matrix([F_x1, F_z1])
CAP_2 = sp.Matrix([F_x2, F_z2])
span, half_depth = sp.symbols("L d", positive=True)


def turning(arm: sp.Matrix, force: sp.Matrix) -> sp.Expr:
    """The clockwise moment of a force at the end of an arm."""
    return arm[1] * force[0] - arm[0] * force[1]


def column_balance(
    side: Side, linear: sp.Matrix, angular: Any, ground: sp.Matrix, cap: sp.Matrix
) -> list[sp.Expr]:
    """Newton and Euler for one column about its own centre, as three expressions that vanish.

    Parameters
    ----------
    side
        Which corners carry.
    linear
        The centre's acceleration, that of gravity deducted (or its jump of velocity).
    angular
        The angular acceleration (or jump of angular velocity), clockwise.
    ground, cap
        Forces (or impulses) on the column at its pivot, and by it on the cap-beam.
    """
    to_ground = -centre(side)
    to_cap = cap_contact(side) - centre(side)
    moment = turning(to_ground, ground) - turning(to_cap, cap)
    inertia = I_o - m_c * R**2  # about the centre, by Steiner
    return [*(ground - cap - m_c * linear), moment - inertia * angular]


def frame_balance(
    side: Side, column_linear: sp.Matrix, angular: Any, cap_linear: sp.Matrix
) -> list[sp.Expr]:
    """The balance of the whole frame but the cap-beam's moments, as expressions that vanish."""
    return [
        *column_balance(side, column_linear, angular, GROUND_1, CAP_1),
        *column_balance(side, column_linear, angular, GROUND_2, CAP_2),
        *(CAP_1 + CAP_2 - m_b * cap_linear),
    ]


def cap_moment(side: Side) -> sp.Expr:
    """The clockwise moment of the columns on the cap-beam about its centre, which vanishes.

    L is the distance between the columns' axes, d half the depth of the beam.
    """
    shift = -side.sign * R * sp.sin(alpha)
    arms = (sp.Matrix([shift + end * span / 2, -half_depth]) for end in (-1, 1))
    return sum(turning(arm, force) for arm, force in zip(arms, (CAP_1, CAP_2), strict=True))


def solve(
    balance: list[sp.Expr], *unknowns: sp.Symbol, only: sp.Symbol | None = None
) -> dict[sp.Symbol, sp.Expr]:
    """Every state that a balance allows: the unknowns and all forces, in terms of the rest.

    With `only`, the answer holds that unknown alone, which saves the reduction of the others. The
    balance of the frame has one force more than equations when the cap-beam's moments are
    left out; F_z1 stays free then.
    """
    circles = CircleField(balance)
    equations = [circles.named(equation) for equation in balance]  # rational: solved fast
    present = {symbol for equation in balance for symbol in equation.free_symbols}
    forces = [f for f in (*GROUND_1, *GROUND_2, F_x1, F_x2, F_z2) if f in present]
    (solution,) = sp.linsolve(equations, [*unknowns, *forces])
    return {
        symbol: circles.reduced(value)
        for symbol, value in zip([*unknowns, *forces], solution, strict=True)
        if only in (None, symbol)
    }
