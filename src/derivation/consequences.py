"""What the derivation implies.

With x = tan² α > 0, what the impact gives is a rational function of x and γ, whose sign shows when
it is factored.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from derivation.mechanics import (
    LOADS,
    OF_TWO,
    RECTANGULAR,
    RECTANGULAR_OF_TWO,
    cap_contact,
    cap_force,
    centre,
    column_motion,
    column_restitution,
    equation_of_motion,
    frame_motion,
    jump,
    kinetic_energy,
    lagrange_equation,
    moment,
    potential_energy,
    quadratic_terms,
    rate,
    restitution,
    size_ratio,
    solved,
    tangent_form,
    uplift_acceleration,
)
from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    SIDES,
    F_x1,
    F_x2,
    F_z1,
    F_z2,
    I_o,
    N,
    R,
    Side,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    ground_velocity,
    half_depth,
    is_identically_zero,
    m_b,
    m_c,
    read,
    vanishes,
    velocity,
    velocity_after,
    velocity_before,
)
from derivation.printed import EQUATIONS, frame

_AT_REST = {ground_velocity: 0, ground_acceleration: 0}
_x = sp.Symbol("x", positive=True)


# Motion -------------------------------------------------------------------------------------------


def follows_if_a_column_weighs(share: sp.Expr) -> bool:
    """Whether γ = m_b/2m_c gives the factor of Eq. (19) if one column has this share of m_c."""
    masses = {m_c: share * m_c, I_o: sp.Rational(4, 3) * share * m_c * R**2, m_b: 2 * gamma * m_c}
    factor = (1 + 2 * gamma) / (1 + 3 * gamma)

    def apart(side: Side) -> sp.Expr:
        motion = frame_motion(side)[acceleration] - factor * column_motion(side)
        return motion.subs(masses, simultaneous=True)

    return vanishes(apart)


def m_c_is_the_mass_of_each_column() -> bool:
    """With γ = m_b/2m_c, Eqs. (19), (22) follow if m_c is the mass of one column, not of both."""
    return follows_if_a_column_weighs(sp.Integer(1)) and not follows_if_a_column_weighs(
        sp.Rational(1, 2)
    )


def cap_moment(side: Side) -> sp.Expr:
    """The clockwise moment of two columns on the cap beam about its centre, which vanishes.

    L is the distance between the columns' axes, d half the depth of the beam.
    """
    span, shift = sp.Symbol("L", positive=True), -side.sign * R * sp.sin(alpha)
    left, right = (sp.Matrix([shift + end * span / 2, -half_depth]) for end in (-1, 1))
    return moment(left, sp.Matrix([F_x1, F_z1])) + moment(right, sp.Matrix([F_x2, F_z2]))


def cap_moment_is_not_needed() -> bool:
    """The motion follows without the cap beam's moments, which only share out the forces."""
    for side in SIDES:
        motion = frame_motion(side)
        shares = sp.diff(cap_moment(side).subs(motion), F_z1)
        if F_z1 in motion[acceleration].free_symbols or is_identically_zero(shares, side):
            return False
    return True


def quadratic_terms_cancel() -> bool:
    """The terms in θ̇² of ü and v̈ are not zero each, and cancel in the equation of motion."""
    terms = [(side, *quadratic_terms(side)) for side in SIDES]
    return all(
        first != 0 and is_identically_zero(first + second, side) for side, first, second in terms
    )


def lagrange_agrees() -> bool:
    """Energies alone give the same equation of motion as the equilibrium of the three bodies."""
    return vanishes(lambda side: equation_of_motion(side).rhs - lagrange_equation(side).rhs)


def frame_rocks_as_a_column() -> bool:
    """The frame's θ̈ is its column's times (1 + 2γ)/(1 + 3γ), for every θ and ground motion."""
    return follows_if_a_column_weighs(sp.Integer(1))


def ground_to_the_right_rocks_to_the_left() -> bool:
    """Ground that accelerates to the right turns column and frame towards θ < 0."""
    return all(
        (sp.diff(motion, ground_acceleration) / sp.cos(side.lean)).cancel().is_negative
        for side in SIDES
        for motion in (column_motion(side), frame_motion(side)[acceleration])
    )


def frame_uplifts_with_its_column() -> bool:
    """Column and frame start to rock at the same ground acceleration, ±g tan α, for every γ."""
    return all(
        is_identically_zero(uplift_acceleration(motion, side) + side.sign * g * sp.tan(alpha), side)
        for side in SIDES
        for motion in (column_motion(side), frame_motion(side)[acceleration])
    )


def energy_is_conserved_between_impacts() -> bool:
    """Over resting ground the kinetic and potential energies of the frame add up to a constant."""

    def change(side: Side) -> sp.Expr:
        total = side.time_derivative(kinetic_energy(side) + potential_energy(side))
        return total.subs(frame_motion(side)).subs(_AT_REST)

    return vanishes(change)


def restoring_moment_falls() -> bool:
    """The column's restoring moment is mgR sin(α − |θ|): mgR sin α at θ = 0, zero at |θ| = α."""
    stated = m_c * g * R
    return vanishes(
        lambda side: (
            I_o * column_motion(side).subs(_AT_REST) + side.sign * stated * sp.sin(side.lean)
        )
    )


def size_grows_to_a_limit() -> bool:
    """R̂/R grows with the weight of the cap beam, from 1 at γ = 0 towards 3/2."""
    limits = (sp.limit(size_ratio(), gamma, 0), sp.limit(size_ratio(), gamma, sp.oo))
    grows = sp.factor(sp.diff(size_ratio(), gamma)).is_positive
    return bool(grows) and limits == (1, sp.Rational(3, 2))


def shear_was_reversed() -> bool:
    """Eqs. (20), (21) hold as printed for F_x positive to the left, with which (13) does not."""
    mirrored = dict(frame(POSITIVE))
    mirrored |= {F_x1: -mirrored[F_x1], F_x2: -mirrored[F_x2]}
    printed = {statement.number: statement.printed for statement in EQUATIONS}
    holds = {}
    for number in (13, 20, 21):
        left, right = read(printed[number], POSITIVE)
        holds[number] = is_identically_zero((left - right).subs(mirrored), POSITIVE)
    return holds == {13: False, 20: True, 21: True}


# Impact -------------------------------------------------------------------------------------------


def _positive(expression: sp.Expr) -> bool:
    """Whether a function of α and γ is positive for all α in (0, π/2) and all γ > 0."""
    return bool(tangent_form(expression).is_positive)


def kinetic_energy_ratio_is_velocity_ratio_squared() -> bool:
    """Kinetic energy is θ̇² times the same constant at every θ of either side: r = (θ̇_2/θ̇_1)²."""
    left, right = (kinetic_energy(side).subs(ground_velocity, 0) for side in SIDES)
    same = is_identically_zero(left - right, NEGATIVE)
    return same and not any(left.has(side.rotation) or right.has(side.rotation) for side in SIDES)


def restitution_is_below_the_columns() -> bool:
    """√r of the frame is smaller than its column's by 3γ sin²α / (2(1 + 3γ)), for every γ > 0."""
    deficit = 3 * gamma * sp.sin(alpha) ** 2 / (2 * (1 + 3 * gamma))
    difference = column_restitution() - restitution()
    return is_identically_zero(difference - deficit, POSITIVE) and _positive(difference)


def impact_never_adds_energy() -> bool:
    """−1 < √r < 1 for every slenderness and every γ."""
    return _positive(1 - restitution()) and _positive(1 + restitution())


def frame_rocks_on_below_its_largest_slenderness() -> bool:
    """√r of the frame is positive exactly for tan²α < 2(1 + 3γ)/(1 + 6γ)."""
    excess = 2 * (1 + 3 * gamma) / (1 + 6 * gamma) - _x
    return bool(sp.factor(tangent_form(restitution()) / excess).is_positive)


# Base shear ---------------------------------------------------------------------------------------


@cache
def base_shear(side: Side) -> sp.Expr:
    """The horizontal force of the ground on both columns over the weight, in θ, θ̇ and ü_g.

    It is the sum of all masses times their accelerations.
    """
    columns = 2 * m_c * (rate(side, rate(side, centre(side))) + LOADS)[0]
    total = (columns + cap_force(side)[0]).subs(OF_TWO).subs(frame_motion(side))
    return sp.factor(total.subs(RECTANGULAR_OF_TWO) / (2 * m_c * (1 + gamma) * g))


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

    def apart(side: Side) -> sp.Expr:
        level = side.sign * sp.tan(alpha)
        return after_uplift(side) + level - slope() * (ground_acceleration / g + level)

    return vanishes(apart)


def heavy_cap_beam_nearly_caps_the_base_shear() -> bool:
    """n falls as γ grows, from 1 − ¾ cos²α of the column towards sin²α, and is never zero."""
    falls = sp.factor(sp.diff(slope(), gamma) / sp.cos(alpha) ** 2).is_negative
    ends = slope().subs(gamma, 0), sp.limit(slope(), gamma, sp.oo)
    stated = 1 - sp.Rational(3, 4) * sp.cos(alpha) ** 2, sp.sin(alpha) ** 2
    return bool(falls) and all(
        sp.simplify(end - limit) == 0 for end, limit in zip(ends, stated, strict=True)
    )


# Impulses inside of the corners -------------------------------------------------------------------

_within = sp.Symbol("kappa", positive=True)  # where they act, from the axis, over b


def restitution_within() -> sp.Expr:
    """√r of N columns if the impulses of an impact act κ b from the axes, at base and top."""
    column, cap = (jump(POSITIVE, p(NEGATIVE), p(POSITIVE)) for p in (centre, cap_contact))
    arm = sp.Matrix([-_within * R * sp.sin(alpha), R * sp.cos(alpha)])
    spin = (I_o - m_c * R**2) * (velocity_after - velocity_before)
    balance = N * (m_c * moment(arm, column) + spin) + m_b * moment(2 * arm, cap)
    rectangular = sp.expand_trig(balance).subs(RECTANGULAR)
    return solved(rectangular, velocity_after) / velocity_before


def impulses_inside_the_corners_lose_less() -> bool:
    """√r rises from that of Eq. (25), if impulses act at the corners, as they move to the axes.

    It falls with κ, and nothing is lost for κ = 0.
    """
    ratio = restitution_within()
    return bool(
        is_identically_zero(ratio.subs(_within, 1) - restitution(), POSITIVE)
        and sp.factor(sp.diff(tangent_form(ratio), _within)).is_negative
        and sp.simplify(ratio.subs(_within, 0)) == 1
    )
