"""Across the plane of the frame. Each function proves what its docstring states.

Two columns in line under a cap beam; b_y is half their dimension across, written R sin α below.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation.fixed_mass import fixed_tangent
from topheavy.derivation.motion import cap_contact, moment
from topheavy.derivation.notation import (
    SIDES,
    R,
    alpha,
    b,
    g,
    gamma,
    h,
    half_depth,
    is_identically_zero,
    m_b,
    m_c,
)

_FROM_ANGLE = {sp.tan(alpha): b / h, sp.sin(alpha): b / R, sp.cos(alpha): h / R}
_HEIGHT = h * (1 + gamma * (2 + half_depth / h)) / (1 + gamma)


def level_cap_has_no_balance_across() -> bool:
    """A cap beam that stayed level across the plane would need a couple m_b g (b_y + d b_y/h).

    The columns would rock at b_y/h, and carry it at one edge each, b_y beside its centre of gravity
    and d below it. Weight and inertia turn it to the same side, and nothing resists.
    """
    identities = []
    for side in SIDES:
        contact = side.upright(sp.Matrix(cap_contact(side)))
        axis = sp.Matrix([side.sign * -R * sp.sin(alpha), contact[1]])
        arm = axis + sp.Matrix([0, half_depth]) - contact  # from the contact to the centre
        load = -m_b * g * sp.Matrix([-side.sign * sp.tan(alpha), 1])
        stated = m_b * g * (R * sp.sin(alpha) + half_depth * sp.tan(alpha))
        identities.append(is_identically_zero(moment(arm, load) - side.sign * stated, side))
    return all(identities)


def frame_across_its_plane_is_a_fixed_mass() -> bool:
    """Across the plane columns and cap turn as one body that uplifts at b_y/H, like a fixed mass.

    H is the height of the common centre of gravity, H/h = (1 + γ(2 + d/h))/(1 + γ), with d half
    the depth of the cap. The cap does not tip first: it would at b_y/d, and d < h < H.
    """
    mass = 2 * m_c + m_b
    height = (2 * m_c * h + m_b * (2 * h + half_depth)) / mass
    tangent = sp.simplify(fixed_tangent().subs(_FROM_ANGLE))
    higher = sp.factor(_HEIGHT - h)
    return bool(
        sp.simplify(height.subs(m_b, 2 * gamma * m_c) - _HEIGHT) == 0
        and sp.simplify(tangent - b / _HEIGHT) == 0
        and higher.is_positive
    )


def deep_columns_uplift_in_the_plane_first() -> bool:
    """b_y/H ≥ b/h if and only if b_y/b ≥ H/h, which rises with γ from 1 to 2 + d/h."""
    ratio = _HEIGHT / h
    return bool(
        sp.factor(sp.diff(ratio, gamma)).is_positive
        and ratio.subs(gamma, 0) == 1
        and sp.simplify(sp.limit(ratio, gamma, sp.oo) - 2 - half_depth / h) == 0
    )


PROOFS = (
    level_cap_has_no_balance_across,
    frame_across_its_plane_is_a_fixed_mass,
    deep_columns_uplift_in_the_plane_first,
)
