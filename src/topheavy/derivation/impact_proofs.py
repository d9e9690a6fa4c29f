"""What the impact implies. Each function proves what its docstring states.

With x = tan² α > 0, every quantity is a rational function of x and γ, whose sign shows when it is
factored.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation.impact import (
    column_restitution,
    energy_slenderness,
    largest_slenderness,
    restitution,
    tangent_form,
)
from topheavy.derivation.lagrange import kinetic_energy
from topheavy.derivation.notation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    alpha,
    gamma,
    ground_velocity,
    vanishes,
)

_x = sp.Symbol("x", positive=True)


def _positive(expression: sp.Expr) -> bool:
    """Whether a function of α and γ is positive for all α in (0, π/2) and all γ > 0."""
    return bool(tangent_form(expression).is_positive)


def _changes_sign_at(expression: sp.Expr, slenderness: sp.Expr) -> bool:
    """Whether a function of α and γ is positive below a slenderness, and negative above it."""
    threshold = sp.tan(slenderness) ** 2
    return bool(sp.factor(tangent_form(expression) / (threshold - _x)).is_positive)


def kinetic_energy_ratio_is_velocity_ratio_squared() -> bool:
    """Kinetic energy is θ̇² times the same constant at every θ of either side: r = (θ̇_2/θ̇_1)²."""
    left, right = (kinetic_energy(side).subs(ground_velocity, 0) for side in SIDES)
    same = vanishes(left - right, NEGATIVE)
    return same and not any(left.has(side.rotation) or right.has(side.rotation) for side in SIDES)


def both_impacts_are_alike() -> bool:
    """√r is the same whether the frame changes over to the right or to the left."""
    return vanishes(restitution(POSITIVE) - restitution(NEGATIVE), POSITIVE)


def restitution_is_below_the_columns() -> bool:
    """√r of the frame is smaller than its column's by 3γ sin²α / (2(1 + 3γ)), for every γ > 0."""
    deficit = 3 * gamma * sp.sin(alpha) ** 2 / (2 * (1 + 3 * gamma))
    difference = column_restitution() - restitution()
    return vanishes(difference - deficit, POSITIVE) and _positive(difference)


def restitution_tends_to_its_limits() -> bool:
    """√r of the frame is the column's 1 − (3/2) sin²α at γ = 0, and tends to cos 2α as γ → ∞."""
    light = restitution().subs(gamma, 0) - (1 - sp.Rational(3, 2) * sp.sin(alpha) ** 2)
    heavy = sp.limit(restitution(), gamma, sp.oo) - sp.cos(2 * alpha)
    return vanishes(light, POSITIVE) and vanishes(heavy, POSITIVE)


def impact_never_adds_energy() -> bool:
    """−1 < √r < 1 for every slenderness and every γ."""
    return _positive(1 - restitution()) and _positive(1 + restitution())


def frame_rocks_on_below_its_largest_slenderness() -> bool:
    """√r of the frame is positive exactly for tan²α < 2(1 + 3γ)/(1 + 6γ)."""
    stated = sp.atan(sp.sqrt(2 * (1 + 3 * gamma) / (1 + 6 * gamma)))
    same = vanishes(sp.tan(stated) ** 2 - sp.tan(largest_slenderness()) ** 2, POSITIVE)
    return same and _changes_sign_at(restitution(), stated)


def frame_loses_the_larger_share_when_slender() -> bool:
    """r of the frame is smaller than its column's exactly for tan²α < 4(1 + 3γ)/(2 + 9γ)."""
    stated = sp.atan(sp.sqrt(4 * (1 + 3 * gamma) / (2 + 9 * gamma)))
    same = vanishes(sp.tan(stated) ** 2 - sp.tan(energy_slenderness()) ** 2, POSITIVE)
    return same and _changes_sign_at(column_restitution() ** 2 - restitution() ** 2, stated)


def every_frame_that_rocks_on_loses_the_larger_share() -> bool:
    """Where √r of the frame is not negative, it loses a larger share of energy than its column."""
    gap = sp.tan(energy_slenderness()) ** 2 - sp.tan(largest_slenderness()) ** 2
    return bool(sp.factor(gap).is_positive)


def heavier_caps_need_slenderer_columns() -> bool:
    """The largest α that keeps rocking falls with γ, from atan √2 (54.7°) towards π/4."""
    squared = sp.tan(largest_slenderness()) ** 2
    ends = (squared.subs(gamma, 0), sp.limit(squared, gamma, sp.oo))
    return bool(sp.factor(sp.diff(squared, gamma)).is_negative) and ends == (2, 1)


PROOFS = (
    kinetic_energy_ratio_is_velocity_ratio_squared,
    both_impacts_are_alike,
    restitution_is_below_the_columns,
    restitution_tends_to_its_limits,
    impact_never_adds_energy,
    frame_rocks_on_below_its_largest_slenderness,
    frame_loses_the_larger_share_when_slender,
    every_frame_that_rocks_on_loses_the_larger_share,
    heavier_caps_need_slenderer_columns,
)
