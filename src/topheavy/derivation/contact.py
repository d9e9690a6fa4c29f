"""The forces and impulses at the four contacts, once the cap-beam's moments are balanced too.

Two columns and a cap-beam give nine balances, for θ̈ (or θ̇_2) and two components at each of four
contacts. The paper omits the ninth, which divides the cap beam's force between the columns.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.bodies import (
    CAP_1,
    CAP_2,
    GROUND_1,
    GROUND_2,
    cap_moment,
    half_depth,
    solve,
    span,
)
from topheavy.derivation.equilibrium import RECTANGULAR, frame_equilibrium
from topheavy.derivation.impact import frame_impact
from topheavy.derivation.notation import F_z1, R, Side, acceleration, alpha, velocity_after

FORCES = (*GROUND_1, *GROUND_2, *CAP_1, *CAP_2)


@cache
def contact_forces(side: Side) -> dict[sp.Symbol, sp.Expr]:
    """θ̈ and all eight forces, in θ, θ̇ and the ground's acceleration."""
    return _determined([*frame_equilibrium(side), cap_moment(side)], acceleration)


@cache
def contact_impulses(side: Side) -> dict[sp.Symbol, sp.Expr]:
    """θ̇_2 and all eight impulses of the change-over to the side, in θ̇_1."""
    return _determined([*frame_impact(side), side.upright(cap_moment(side))], velocity_after)


def _determined(balance: list[sp.Expr], motion: sp.Symbol) -> dict[sp.Symbol, sp.Expr]:
    solution = solve(balance, motion, F_z1)
    return {unknown: value.subs(RECTANGULAR) for unknown, value in solution.items()}


def determinant(side: Side) -> sp.Expr:
    """The determinant of the nine balances in θ̈ and the eight forces; zero would be a gap."""
    balance = sp.Matrix([*frame_equilibrium(side), cap_moment(side)])
    matrix = balance.jacobian([acceleration, *FORCES]).subs(RECTANGULAR)
    return sp.factor(sp.simplify(matrix.det(method="laplace")))  # sparse


def shared_out(side: Side, on_cap: sp.Matrix, lean: sp.Expr) -> tuple[sp.Matrix, sp.Matrix]:
    """The forces (or impulses) of column 1 and 2 on the cap-beam, of which it takes the sum.

    Across the diagonals they are equal. The line of thrust shifts force from column top 1 to column
    top 2; this part acts along the diagonals.
    """
    half_width = R * sp.sin(alpha)
    shift = (side.sign * half_width * on_cap[1] - half_depth * on_cap[0]) / span
    along = sp.Matrix([-side.sign * sp.tan(lean), 1])
    return on_cap / 2 - shift * along, on_cap / 2 + shift * along
