"""The base shear of the frame from the same balances as its motion, and its growth after uplift.

The cap-beam's moments are not needed: they only divide forces between the columns.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.bodies import GROUND_1, GROUND_2
from topheavy.derivation.equilibrium import RECTANGULAR, frame_motion
from topheavy.derivation.notation import (
    SIDES,
    Side,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_c,
    vanishes,
    velocity,
)


@cache
def base_shear(side: Side) -> sp.Expr:
    """The horizontal force of the ground on both columns over the weight, in θ, θ̇ and ü_g."""
    total = (GROUND_1[0] + GROUND_2[0]).subs(frame_motion(side)).subs(RECTANGULAR)
    return sp.factor(total / (2 * m_c * (1 + gamma) * g))


def after_uplift(side: Side) -> sp.Expr:
    """The base shear over the weight as the resting frame starts to turn to this side."""
    return side.upright(base_shear(side)).subs(velocity, 0)


def slope() -> sp.Expr:
    """d(V/W)/d(ü_g/g) just after uplift, as it is stated."""
    ratio = (1 + 2 * gamma) ** 2 / ((1 + gamma) * (1 + 3 * gamma))
    return 1 - sp.Rational(3, 4) * sp.cos(alpha) ** 2 * ratio


def base_shear_grows_after_uplift() -> bool:
    """Just after uplift V/W = tan α + n (ü_g/g − tan α), n = 1 − ¾ cos²α (1+2γ)²/((1+γ)(1+3γ)).

    V is the base shear of both columns, W the weight; for ü_g < 0 both terms change their signs. A
    rigid frame that is held against uplift has n = 1. So the shear continues at uplift.
    """
    return all(
        vanishes(
            after_uplift(side)
            + side.sign * sp.tan(alpha)
            - slope() * (ground_acceleration / g + side.sign * sp.tan(alpha)),
            side,
        )
        for side in SIDES
    )


def heavy_cap_beam_nearly_caps_the_base_shear() -> bool:
    """n falls as γ grows, from 1 − ¾ cos²α of the column towards sin²α, and is never zero."""
    falls = sp.factor(sp.diff(slope(), gamma) / sp.cos(alpha) ** 2).is_negative
    ends = slope().subs(gamma, 0), sp.limit(slope(), gamma, sp.oo)
    stated = 1 - sp.Rational(3, 4) * sp.cos(alpha) ** 2, sp.sin(alpha) ** 2
    return bool(falls) and all(
        sp.simplify(found - claim) == 0 for found, claim in zip(ends, stated, strict=True)
    )


PROOFS = (base_shear_grows_after_uplift, heavy_cap_beam_nearly_caps_the_base_shear)
