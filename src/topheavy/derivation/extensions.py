"""A larger R̂, N columns, vertical ground motion. Each function proves what its docstring states.

Makris & Vassiliou (2013) give the equation of N columns by Lagrange.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation.motion import (
    RECTANGULAR,
    column_motion,
    equation_of_motion,
    lagrange_motion,
    motion_of_columns,
    restitution,
    restitution_of_columns,
)
from topheavy.derivation.notation import (
    POSITIVE,
    SIDES,
    R,
    Side,
    alpha,
    g,
    gamma,
    ground_acceleration,
    is_identically_zero,
    velocity,
    vertical_acceleration,
)

_k = sp.Symbol("k", positive=True)


def frame_of_columns(side: Side) -> sp.Expr:
    """θ̈ of a cap beam on N rectangular columns, in γ = m_b/(N m_c)."""
    return motion_of_columns(side).subs(RECTANGULAR)


def printed_motion(side: Side) -> sp.Expr:
    """Eq. (23) with its p̂² and p², and g + v̈_g in place of g in the restoring moment."""
    p_squared = (1 + 2 * gamma) / (1 + 3 * gamma) * 3 * g / (4 * R)
    restoring = side.sign * sp.sin(side.lean) * (1 + vertical_acceleration / g)
    return -p_squared * (restoring + ground_acceleration / g * sp.cos(side.lean))


def size_only_slows_time() -> bool:
    """A similar column k times as large moves as the small one does in time stretched by √k.

    θ(t) of the one under ü_g(t) is θ(t/√k) of the other under ü_g(t√k), at the same √r; so is
    that of a frame with k = R̂/R. A larger R̂ implies this similarity and nothing else.
    """
    slowed = {R: _k * R}
    return all(
        is_identically_zero(_k * motion.subs(slowed) - motion, side) and not motion.has(velocity)
        for side in SIDES
        for motion in (column_motion(side).subs(RECTANGULAR), equation_of_motion(side).rhs)
    )


def columns_count_only_in_the_mass_ratio() -> bool:
    """A cap beam on N columns obeys Eqs. (23) and (24), in which N does not occur."""
    return all(
        is_identically_zero(frame_of_columns(side) - printed_motion(side), side) for side in SIDES
    )


def lagrange_agrees_for_columns() -> bool:
    """Energies give the same equation of motion for N columns, vertical acceleration included."""
    return all(
        is_identically_zero(frame_of_columns(side) - lagrange_motion(side), side) for side in SIDES
    )


def impacts_do_not_count_the_columns() -> bool:
    """√r of a cap beam on N columns is that of Eq. (25), with γ = m_b/(N m_c)."""
    return all(
        is_identically_zero(
            restitution_of_columns(side).subs(RECTANGULAR) - restitution(), POSITIVE
        )
        for side in SIDES
    )


def vertical_acceleration_adds_to_gravity() -> bool:
    """Vertical ground acceleration replaces g by g + v̈_g, in the frame as in its column.

    So the frame remains equivalent to the column of size R̂.
    """
    identities = []
    for side in SIDES:
        heavier = {g: g + vertical_acceleration}
        frame = frame_of_columns(side)
        column = frame.subs(gamma, 0)
        level = equation_of_motion(side).rhs
        ratio = (1 + 2 * gamma) / (1 + 3 * gamma)
        identities += [
            is_identically_zero(frame - level.subs(heavier), side),
            is_identically_zero(column - column_motion(side).subs(RECTANGULAR).subs(heavier), side),
            is_identically_zero(frame - ratio * column, side),
        ]
    return all(identities)


def vertical_acceleration_changes_the_uplift() -> bool:
    """Uplift begins at (g + v̈_g) tan α, for every γ."""
    identities = []
    for side in SIDES:
        (level,) = sp.solve(side.upright(frame_of_columns(side)), ground_acceleration)
        stated = -side.sign * (g + vertical_acceleration) * sp.tan(alpha)
        identities.append(is_identically_zero(level - stated, side))
    return all(identities)


def vertical_acceleration_is_a_change_of_gravity_and_push() -> bool:
    """θ̈ = (1 + v̈_g/g) times that over ground with ü_g/(1 + v̈_g/g) and no vertical motion."""
    share = 1 + vertical_acceleration / g
    return all(
        is_identically_zero(
            frame_of_columns(side)
            - share
            * equation_of_motion(side).rhs.subs(ground_acceleration, ground_acceleration / share),
            side,
        )
        for side in SIDES
    )


PROOFS = (
    size_only_slows_time,
    columns_count_only_in_the_mass_ratio,
    lagrange_agrees_for_columns,
    impacts_do_not_count_the_columns,
    vertical_acceleration_adds_to_gravity,
    vertical_acceleration_changes_the_uplift,
    vertical_acceleration_is_a_change_of_gravity_and_push,
)
