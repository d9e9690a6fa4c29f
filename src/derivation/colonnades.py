"""One stone per bay over the axes of slender columns, from the same balances as the frame.

Columns turn alike. A stone bears on the axis of one column and on the top corner of the next; its
joints take no shear, and its depth and rotary inertia are small. As a lever it loads the columns
like a mass γ m_c between axis and corner, λ b from the axis' foot towards the corner that rises.
The corner, λ = 2, is the paper's frame, and the axis, λ = 1, a fixed mass. Of several equal stones
the sums, hence the means of λ and of λ(λ + λ₁), count.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from derivation.fixed_mass import I_b, fixed_restitution, fixed_tangent
from derivation.mechanics import (
    LOADS,
    RECTANGULAR,
    above_top,
    cap_contact,
    centre,
    column_moment,
    frequency_ratio,
    jump,
    moment,
    rate,
    restitution,
    solved,
    uplift_acceleration,
)
from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    I_o,
    R,
    Side,
    acceleration,
    alpha,
    b,
    g,
    gamma,
    ground_acceleration,
    half_depth,
    is_identically_zero,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
    vertical_acceleration,
)

lever, lever_before, span = sp.symbols("lever lever_1 L", positive=True)
_STONE = gamma * m_c
_POINT_MASS = {half_depth: 0, I_b: 0}


def carried(side: Side, at: sp.Expr) -> sp.ImmutableMatrix:
    """The point (x, z) between axis and corner of the top, from the pivot, for a lever."""
    axis = above_top(side, 0)
    return axis + (at - 1) * (cap_contact(side) - axis)


def rise(point: sp.ImmutableMatrix) -> sp.Expr:
    """The rise of a point of the column that begins to lean to the right, per θ."""
    return POSITIVE.upright(rate(POSITIVE, point))[1] / velocity


def lever_of(start: sp.Expr, end: sp.Expr, *, covers: bool = False) -> sp.Expr:
    """λ of a stone from `start` to `end`, from the axis of its left column; columns lean right.

    Its left end bears on the axis, or, if it covers that column's top, on its left corner.
    """
    corner = R * sp.sin(alpha)
    left, right = (-corner, cap_contact) if covers else (0, lambda side: above_top(side, 0))
    rises = rise(right(POSITIVE)), rise(cap_contact(POSITIVE))
    share = ((start + end) / 2 - left) / (span - corner - left)
    return sp.simplify((rises[0] + share * (rises[1] - rises[0])) / corner)


@cache
def stone_motion(side: Side) -> sp.Expr:
    """θ̈ of rectangular columns that carry stones with the lever λ."""
    point = carried(side, lever)
    inertia = rate(side, rate(side, point))
    balance = column_moment(side, sp.zeros(2, 1)) + moment(point, _STONE * (inertia + LOADS))
    return solved(balance.subs(vertical_acceleration, 0).subs(RECTANGULAR), acceleration)


@cache
def stone_tangent(side: Side = NEGATIVE) -> sp.Expr:
    """tan α': the ground acceleration at which the colonnade uplifts, over g."""
    return sp.factor(-side.sign * uplift_acceleration(stone_motion(side), side) / g)


@cache
def stone_restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r: the impulses at the new contacts do no work on the motion after the impact."""
    column = jump(side, centre(side.other), centre(side))
    stone = jump(side, carried(side.other, lever_before), carried(side, lever))
    balance = (I_o - m_c * R**2) * (velocity_after - velocity_before)
    balance += m_c * moment(side.upright(centre(side)), column)
    balance += _STONE * moment(side.upright(carried(side, lever)), stone)
    return solved(sp.expand_trig(balance).subs(RECTANGULAR), velocity_after) / velocity_before


def stone_bears_between_axis_and_corner() -> bool:
    """A stone that ends on the axes of columns L apart has the lever λ = 3/2 + b/(2(L − b)).

    An outer stone that ends at the outer face has λ = 1 + (L + b)/(2(L − b)) where the columns lean
    towards that face, and λ = 2 where they lean away from it. A wide bay has λ = 3/2.
    """
    half = R * sp.sin(alpha)
    stated = sp.Rational(3, 2) + b / (2 * (span - b))
    outer = 1 + (span + b) / (2 * (span - b))
    pairs = [
        (lever_of(sp.S.Zero, span), stated),
        (lever_of(sp.S.Zero, span + half), outer),
        (lever_of(-half, span, covers=True), sp.S(2)),
    ]
    apart = (sp.simplify(own - formula.subs(b, half)) for own, formula in pairs)
    return all(one == 0 for one in apart) and sp.limit(stated, span, sp.oo) == sp.Rational(3, 2)


def stones_lower_the_uplift_acceleration() -> bool:
    """Stones with the lever λ give tan α' = tan α (1 + λγ)/(1 + 2γ), which falls with γ for λ < 2.

    It is tan α for λ = 2, as in the frame, and that of a concentrated fixed mass for λ = 1.
    """
    stated = sp.tan(alpha) * (1 + lever * gamma) / (1 + 2 * gamma)
    slope = sp.factor(sp.diff((1 + lever * gamma) / (1 + 2 * gamma), gamma))
    fixed = fixed_tangent().subs(_POINT_MASS)
    return bool(
        is_identically_zero(stone_tangent() - stated, NEGATIVE)
        and is_identically_zero(stone_tangent().subs(lever, 1) - fixed, NEGATIVE)
        and sp.simplify(slope * (1 + 2 * gamma) ** 2 - (lever - 2)) == 0
    )


def stones_leave_the_frequency_parameter() -> bool:
    """For slender columns p̂ is that of Eq. (23), whatever the lever of the stones."""
    free = sp.diff(stone_motion(NEGATIVE).subs(ground_acceleration, 0), NEGATIVE.rotation)
    slender = sp.limit(sp.expand_trig(NEGATIVE.upright(free)), alpha, 0)
    return bool(sp.simplify(slender - frequency_ratio() ** 2 * 3 * g / (4 * R)) == 0)


def stones_change_the_loss_at_an_impact() -> bool:
    """For slender columns 1 − √r = (3/2) sin²α (1 + l₂γ)/(1 + 3γ), with l₂ = λ(λ + λ₁)/2.

    λ₁ is the lever before the impact. For λ = λ₁ = 2 √r is that of Eq. (25), and for λ = λ₁ = 1
    that of a concentrated fixed mass, for every slenderness.
    """
    root, square = stone_restitution(), lever * (lever + lever_before) / 2
    loss = sp.limit(sp.factor(sp.expand_trig(1 - root)) / sp.sin(alpha) ** 2, alpha, 0)
    stated = sp.Rational(3, 2) * (1 + square * gamma) / (1 + 3 * gamma)
    ends = ((2, restitution()), (1, fixed_restitution().subs(_POINT_MASS)))
    return sp.simplify(loss - stated) == 0 and all(
        is_identically_zero(root.subs({lever: one, lever_before: one}) - end, POSITIVE)
        for one, end in ends
    )
