"""What the equations of motion imply. Each function proves what its docstring states."""

from __future__ import annotations

import sympy as sp

from topheavy.derivation import premises
from topheavy.derivation.bodies import cap_moment
from topheavy.derivation.equilibrium import (
    RECTANGULAR,
    column_motion,
    equation_of_motion,
    frame_motion,
    frequency_ratio,
    quadratic_terms,
    size_ratio,
    uplift_acceleration,
)
from topheavy.derivation.lagrange import kinetic_energy, lagrange_equation, potential_energy
from topheavy.derivation.notation import (
    POSITIVE,
    SIDES,
    F_x1,
    F_x2,
    F_z1,
    I_o,
    R,
    acceleration,
    alpha,
    g,
    gamma,
    ground_acceleration,
    ground_velocity,
    m_b,
    m_c,
    read,
    vanishes,
)
from topheavy.derivation.printed import EQUATIONS

_AT_REST = {ground_velocity: 0, ground_acceleration: 0}


def cap_moment_is_not_needed() -> bool:
    """The motion follows without the cap-beam's moments, which only share out the forces."""
    found = []
    for side in SIDES:
        motion = frame_motion(side)
        shares = sp.diff(cap_moment(side).subs(motion), F_z1)
        found.append(F_z1 not in motion[acceleration].free_symbols and not vanishes(shares, side))
    return all(found)


def follows_if_a_column_weighs(share: sp.Expr) -> bool:
    """Whether γ = m_b/2m_c gives the factor of Eq. (19) if one column has this share of m_c."""
    masses = {m_c: share * m_c, I_o: sp.Rational(4, 3) * share * m_c * R**2, m_b: 2 * gamma * m_c}
    factor = (1 + 2 * gamma) / (1 + 3 * gamma)
    return all(
        vanishes(
            (frame_motion(side)[acceleration] - factor * column_motion(side)).subs(
                masses, simultaneous=True
            ),
            side,
        )
        for side in SIDES
    )


def m_c_is_the_mass_of_each_column() -> bool:
    """With γ = m_b/2m_c, Eqs. (19), (22) follow if m_c is the mass of one column, not of both."""
    return follows_if_a_column_weighs(sp.Integer(1)) and not follows_if_a_column_weighs(
        sp.Rational(1, 2)
    )


def quadratic_terms_cancel() -> bool:
    """The terms in θ̇² of ü and v̈ are not zero each, and cancel in the equation of motion."""
    terms = [(side, *quadratic_terms(side)) for side in SIDES]
    return all(first != 0 and vanishes(first + second, side) for side, first, second in terms)


def lagrange_agrees() -> bool:
    """Energies alone give the same equation of motion as the equilibrium of the three bodies."""
    return all(
        vanishes(equation_of_motion(side).rhs - lagrange_equation(side).rhs, side) for side in SIDES
    )


def frame_rocks_as_a_column() -> bool:
    """The frame's θ̈ is its column's times (1 + 2γ)/(1 + 3γ), for every θ and ground motion."""
    factor = (1 + 2 * gamma) / (1 + 3 * gamma)
    return all(
        vanishes(
            (frame_motion(side)[acceleration] - factor * column_motion(side)).subs(RECTANGULAR),
            side,
        )
        for side in SIDES
    )


def frame_uplifts_with_its_column() -> bool:
    """Column and frame start to rock at the same ground acceleration, ±g tan α, for every γ."""
    return all(
        vanishes(uplift_acceleration(motion, side) + side.sign * g * sp.tan(alpha), side)
        for side in SIDES
        for motion in (column_motion(side), frame_motion(side)[acceleration])
    )


def ground_to_the_right_rocks_to_the_left() -> bool:
    """Ground that accelerates to the right turns column and frame towards θ < 0."""
    return all(
        (sp.diff(motion, ground_acceleration) / sp.cos(side.lean)).cancel().is_negative
        for side in SIDES
        for motion in (column_motion(side), frame_motion(side)[acceleration])
    )


def energy_is_conserved_between_impacts() -> bool:
    """Over resting ground the kinetic and potential energies of the frame add up to a constant."""
    return all(
        vanishes(
            side.time_derivative(kinetic_energy(side) + potential_energy(side))
            .subs(frame_motion(side))
            .subs(_AT_REST),
            side,
        )
        for side in SIDES
    )


def restoring_moment_falls() -> bool:
    """The column's restoring moment is mgR sin(α − |θ|): mgR sin α at θ = 0, zero at |θ| = α."""
    return all(
        vanishes(
            I_o * column_motion(side).subs(_AT_REST) + side.sign * m_c * g * R * sp.sin(side.lean),
            side,
        )
        for side in SIDES
    )


def frequency_falls_to_a_limit() -> bool:
    """p̂/p falls steadily from 1 at γ = 0 towards √(2/3) for γ → ∞."""
    ratio = frequency_ratio()
    limits = (sp.limit(ratio**2, gamma, 0), sp.limit(ratio**2, gamma, sp.oo))
    falls = sp.factor(sp.diff(ratio**2, gamma)).is_negative
    return bool(falls) and limits == (1, sp.Rational(2, 3))


def size_grows_to_a_limit() -> bool:
    """R̂/R grows with the weight of the cap-beam, from 1 at γ = 0 towards 3/2."""
    limits = (sp.limit(size_ratio(), gamma, 0), sp.limit(size_ratio(), gamma, sp.oo))
    grows = sp.factor(sp.diff(size_ratio(), gamma)).is_positive
    return bool(grows) and limits == (1, sp.Rational(3, 2))


def shear_was_reversed() -> bool:
    """Eqs. (20), (21) hold as printed for F_x positive to the left, with which (13) does not."""
    mirrored = dict(premises.frame(POSITIVE))
    mirrored |= {F_x1: -mirrored[F_x1], F_x2: -mirrored[F_x2]}
    printed = {statement.number: statement.printed for statement in EQUATIONS}
    holds = {}
    for number in (13, 20, 21):
        left, right = read(printed[number], POSITIVE)
        holds[number] = vanishes((left - right).subs(mirrored), POSITIVE)
    return holds == {13: False, 20: True, 21: True}


PROOFS = (
    m_c_is_the_mass_of_each_column,
    cap_moment_is_not_needed,
    quadratic_terms_cancel,
    lagrange_agrees,
    frame_rocks_as_a_column,
    ground_to_the_right_rocks_to_the_left,
    frame_uplifts_with_its_column,
    energy_is_conserved_between_impacts,
    restoring_moment_falls,
    frequency_falls_to_a_limit,
    size_grows_to_a_limit,
    shear_was_reversed,
)
