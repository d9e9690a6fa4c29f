"""What the forces and impulses at the contacts imply. Each function proves its docstring.

F and J are the forces and impulses on the cap-beam, G and K those on the columns at the ground.
"""

from __future__ import annotations

import sympy as sp

from topheavy.derivation.bodies import CAP_1, CAP_2, GROUND_1, GROUND_2, half_depth, span
from topheavy.derivation.contact import contact_forces, contact_impulses, determinant, shared_out
from topheavy.derivation.equilibrium import RECTANGULAR, frame_motion
from topheavy.derivation.impact import restitution, tangent_form
from topheavy.derivation.notation import (
    SIDES,
    R,
    Side,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    m_c,
    vanishes,
    velocity,
    velocity_after,
    velocity_before,
)

_CONTACTS = (GROUND_1, GROUND_2, CAP_1, CAP_2)
_multiple = sp.Symbol("k", positive=True)


def nine_balances_determine_the_contact_forces() -> bool:
    """With the cap-beam's moments, nine equations have one solution for θ̈ and eight forces."""
    return all(bool((determinant(side) / sp.cos(side.lean)).cancel().is_negative) for side in SIDES)


def contact_forces_keep_the_motion() -> bool:
    """With the cap-beam's moments too, θ̈ is that of Eq. (22) and θ̇_2/θ̇_1 that of Eq. (25)."""
    return all(
        vanishes(
            contact_forces(side)[acceleration] - frame_motion(side)[acceleration].subs(RECTANGULAR),
            side,
        )
        and vanishes(
            contact_impulses(side)[velocity_after] / velocity_before - restitution(side), side
        )
        for side in SIDES
    )


def seats_share_the_cap_by_its_line_of_thrust() -> bool:
    """Column top 1 carries F_z (1/2 − e/L), top 2 F_z (1/2 + e/L), e = b sgn θ − d F_x/F_z; also J.

    The line of thrust through the cap-beam's centre meets the level of the column-top contacts at
    e, to the right of the middle between them. L is the distance of the columns' axes, d half the
    depth of the beam.
    """
    return all(
        vanishes(difference, side)
        for side in SIDES
        for found, lean in ((contact_forces(side), side.lean), (contact_impulses(side), alpha))
        for difference in _differences(side, found, lean)
    )


def _differences(side: Side, found: dict[sp.Symbol, sp.Expr], lean: sp.Expr) -> list[sp.Expr]:
    first, second = CAP_1.subs(found), CAP_2.subs(found)
    total = first + second
    thrust = side.sign * R * sp.sin(alpha) - half_depth * total[0] / total[1]
    stated = shared_out(side, total, lean)
    lever = total[1] * (sp.Rational(1, 2) - thrust / span)
    return [*(first - stated[0]), *(second - stated[1]), first[1] - lever]


def quasistatic_uplift_asks_for_the_slope_of_the_diagonal() -> bool:
    """At ü_g = ±g tan α the required friction is tan α at all four contacts, for every cap-beam."""
    return all(
        vanishes(force[0] + side.sign * sp.tan(alpha) * force[1], side)
        for side in SIDES
        for force in _contacts_at_uplift(side, sp.Integer(1))
    )


def frame_needs_less_friction_than_its_column_to_uplift() -> bool:
    """Uplifted by k g tan α, the bases need H/V = tan α (1 + k t² + τ(k−1))/(1 + k t² − τ(k−1) t²).

    t = tan α, H and V are the sums over both bases, and τ = (1 + 4γ)/(4 (1 + γ)(1 + 3γ)) falls from
    1/4 for the column towards 0 as γ → ∞, and with τ the demand, for every k > 1.
    """
    t, tau, k = sp.tan(alpha), (1 + 4 * gamma) / (4 * (1 + gamma) * (1 + 3 * gamma)), _multiple
    falls = sp.factor(sp.diff(tau, gamma)).is_negative
    ends = (tau.subs(gamma, 0), sp.limit(tau, gamma, sp.oo)) == (sp.Rational(1, 4), 0)
    x, fall, excess = sp.symbols("x sigma epsilon", positive=True)  # tan²α, 1/4τ − 1, k − 1
    push = excess / (4 * (1 + fall))
    demand = (1 + (1 + excess) * x + push) / (1 + (1 + excess) * x - push * x)
    eases = sp.factor(sp.diff(demand, fall)).is_negative
    stated = all(
        vanishes(
            foot[0] * (1 + k * t**2 - tau * (k - 1) * t**2)
            + side.sign * t * (1 + k * t**2 + tau * (k - 1)) * foot[1],
            side,
        )
        for side in SIDES
        for foot in [sum(_contacts_at_uplift(side, k)[:2], start=sp.zeros(2, 1))]
    )
    return bool(falls and eases) and ends and stated


def _contacts_at_uplift(side: Side, multiple: sp.Expr) -> list[sp.Matrix]:
    """The contact forces as ü_g = k g tan α starts to turn the resting frame to this side."""
    start = {velocity: 0, ground_acceleration: -side.sign * multiple * g * sp.tan(alpha)}
    forces = contact_forces(side)
    return [side.upright(contact.subs(forces).subs(start)) for contact in _CONTACTS]


def massless_columns_push_along_their_diagonals() -> bool:
    """Across its diagonal a top takes −γ/(2 (1 + 3γ)) m_c a, a base (1 + 4γ)/(4 (1 + 3γ)) m_c a.

    a = g sin(α sgn θ − θ) + ü_g cos(α sgn θ − θ). Over the weight of the cap-beam both vanish as
    γ → ∞: then every contact needs the friction tan(α − |θ|), for every motion of the ground.
    """
    seat = -gamma / (2 * (1 + 3 * gamma))
    foot = (1 + 4 * gamma) / (4 * (1 + 3 * gamma))
    found = [sp.limit(share / gamma, gamma, sp.oo) == 0 for share in (seat, foot)]
    for side in SIDES:
        sin, cos = side.sign * sp.sin(side.lean), sp.cos(side.lean)
        loading = m_c * (g * sin + ground_acceleration * cos)
        for contact, share in zip(_CONTACTS, (foot, foot, seat, seat), strict=True):
            force = contact.subs(contact_forces(side))
            found.append(vanishes(force[0] * cos + force[1] * sin - share * loading, side))
    return all(found)


def impact_presses_feet_and_seats_together() -> bool:
    """At an impact the sums over both column tops, and over both bases, press and need ρ tan α.

    ρ = n/(2 + (2 − n) tan²α), n = 3 (1 + 4γ)/(2 (1 + 3γ)); it grows with γ, towards 1.
    """
    n = 3 * (1 + 4 * gamma) / (2 * (1 + 3 * gamma))
    t = sp.tan(alpha)
    rho = n / (2 + (2 - n) * t**2)
    found = []
    for side in SIDES:
        for pair in ((GROUND_1, GROUND_2), (CAP_1, CAP_2)):
            total = (pair[0] + pair[1]).subs(contact_impulses(side))
            found.append(vanishes(total[0] + side.sign * rho * t * total[1], side))
            lift = total[1] / (side.sign * velocity_before * R * m_c * sp.sin(alpha))
            found.append(bool(tangent_form(sp.simplify(lift)).is_positive))
    x = sp.Symbol("x", positive=True)
    squared = rho.subs(sp.tan(alpha), sp.sqrt(x))
    grows = sp.factor(sp.diff(squared, gamma)).is_positive
    return all(found) and bool(grows) and sp.limit(squared, gamma, sp.oo) == 1


def impact_opens_no_seat_of_a_wide_bay() -> bool:
    """No column top opens at an impact exactly when b + d ρ tan α < L/2; then no base opens either.

    The trailing column top presses least; b + d tan α < L/2 is enough for every γ.
    """
    n = 3 * (1 + 4 * gamma) / (2 * (1 + 3 * gamma))
    t = sp.tan(alpha)
    eccentricity = R * sp.sin(alpha) + half_depth * n * t / (2 + (2 - n) * t**2)
    found = []
    for side in SIDES:
        impulses = contact_impulses(side)
        total = (CAP_1 + CAP_2).subs(impulses)[1]
        feet_and_seats = ((CAP_1, GROUND_1), (CAP_2, GROUND_2))
        for end, (seat, foot) in zip((-1, 1), feet_and_seats, strict=True):
            share = sp.Rational(1, 2) + end * side.sign * eccentricity / span
            found.append(vanishes(seat.subs(impulses)[1] - share * total, side))
            lift = (foot - seat).subs(impulses)[1]
            lift = lift / (side.sign * velocity_before * R * m_c * sp.sin(alpha))
            found.append(bool(tangent_form(sp.simplify(lift)).is_positive))
    return all(found)


PROOFS = (
    nine_balances_determine_the_contact_forces,
    contact_forces_keep_the_motion,
    seats_share_the_cap_by_its_line_of_thrust,
    quasistatic_uplift_asks_for_the_slope_of_the_diagonal,
    frame_needs_less_friction_than_its_column_to_uplift,
    massless_columns_push_along_their_diagonals,
    impact_presses_feet_and_seats_together,
    impact_opens_no_seat_of_a_wide_bay,
)
