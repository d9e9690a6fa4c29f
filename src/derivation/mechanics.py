"""Geometry, motion and impact of a cap beam on N columns, by balances and by energies.

The columns are equal, carry the cap beam at equal corners and turn by the same angle: the frame is
a parallelogram linkage, and the beam translates. N and the vertical ground acceleration v̈_g are
symbols; the paper has N = 2 and v̈_g = 0. F_x (to the right) and F_z (upward) act on the cap beam by
column 1 and 2. The cap beam's moments are not needed: they only divide its forces between columns.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import sympy as sp

from derivation.notation import (
    NEGATIVE,
    POSITIVE,
    CircleField,
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
    b,
    g,
    gamma,
    ground_acceleration,
    ground_velocity,
    h,
    m,
    m_b,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
    vertical_acceleration,
)

OF_TWO = {N: 2, vertical_acceleration: 0}
"""The paper's frame."""

RECTANGULAR = {I_o: sp.Rational(4, 3) * m_c * R**2, m_b: N * gamma * m_c}
"""The inertia of a rectangular column, and γ = m_b/(N m_c)."""

RECTANGULAR_OF_TWO = {symbol: value.subs(OF_TWO) for symbol, value in RECTANGULAR.items()}

LOADS = sp.ImmutableMatrix([ground_acceleration, g + vertical_acceleration])
"""Inertia of the ground's motion and weight, per mass: to the left and down."""


# Geometry -----------------------------------------------------------------------------------------


def size() -> sp.Expr:
    """R, from the pivot corner to the centre of the column of half-width b and half-height h."""
    return sp.Matrix([b, h]).norm()


def slenderness() -> sp.Expr:
    """α, the angle of the diagonal against the vertical."""
    return sp.atan2(b, h)


def moment_of_inertia() -> sp.Expr:
    """I_o of the uniform rectangle about its corner, by integration over the area."""
    x, z = sp.symbols("x z")
    density = m / (4 * b * h)
    return sp.factor(sp.integrate(density * (x**2 + z**2), (x, 0, 2 * b), (z, 0, 2 * h)))


def _turned(side: Side, x: Any, z: Any) -> sp.ImmutableMatrix:
    """The point (x, z) of the upright column, from the pivot, when the column has turned by θ."""
    pivot = sp.Matrix([side.sign * R * sp.sin(alpha), -R * sp.cos(alpha)])
    θ = side.rotation
    clockwise = sp.Matrix([[sp.cos(θ), sp.sin(θ)], [-sp.sin(θ), sp.cos(θ)]])
    turned = clockwise * (sp.Matrix([x, z]) - pivot)
    return sp.ImmutableMatrix(turned.applyfunc(sp.trigsimp))


@cache
def centre(side: Side) -> sp.ImmutableMatrix:
    """The column's centre (x, z) from its pivot at the ground: the corner that it leans over."""
    return _turned(side, 0, 0)


@cache
def cap_contact(side: Side) -> sp.ImmutableMatrix:
    """The corner (x, z) that carries the cap beam, from the pivot: the one diagonally across."""
    return _turned(side, -side.sign * R * sp.sin(alpha), R * sp.cos(alpha))


@cache
def above_top(side: Side, height: Any) -> sp.ImmutableMatrix:
    """The point (x, z) of the column's axis at a height above its top, from the pivot."""
    return _turned(side, 0, R * sp.cos(alpha) + height)


def rate(side: Side, point: sp.ImmutableMatrix) -> sp.ImmutableMatrix:
    """The velocity of a point above the ground, or the acceleration of a velocity."""
    return point.applyfunc(side.time_derivative)


class CapMotion(NamedTuple):
    """The cap beam's translation relative to the ground, Eqs. (4)–(9)."""

    u: sp.Expr
    u_dot: sp.Expr
    u_ddot: sp.Expr
    v: sp.Expr
    v_dot: sp.Expr
    v_ddot: sp.Expr


@cache
def cap_motion(side: Side) -> CapMotion:
    """The cap beam's displacement, velocity and acceleration, those of the corners that carry it.

    # Eqs. (4)–(9)
    """
    contact = cap_contact(side)
    moved = contact - side.upright(contact)
    velocities = rate(side, moved)
    accelerations = rate(side, velocities)
    (u, v), (u_dot, v_dot), (u_ddot, v_ddot) = moved, velocities, accelerations
    return CapMotion(u, u_dot, u_ddot, v, v_dot, v_ddot)


# Balances -----------------------------------------------------------------------------------------


def moment(arm: sp.Matrix, force: sp.Matrix) -> sp.Expr:
    """The clockwise moment of a force at the end of an arm."""
    return arm[1] * force[0] - arm[0] * force[1]


def column_moment(side: Side, on_cap: sp.Matrix) -> sp.Expr:
    """The moments of one column about its pivot, which vanish; it pushes the cap beam by a force.

    By Steiner's theorem its inertia about the pivot is I_o. # Eqs. (1), (2), (10), (11), (20), (21)
    """
    loads = I_o * acceleration + m_c * moment(centre(side), LOADS)
    return loads + moment(cap_contact(side), on_cap)


def cap_force(side: Side) -> sp.ImmutableMatrix:
    """The force of all columns on the cap beam. # Eqs. (13), (16)"""
    return m_b * (rate(side, rate(side, cap_contact(side))) + LOADS)


def solved(balance: sp.Expr, unknown: sp.Symbol) -> sp.Expr:
    """The unknown of a linear balance, reduced by sin² + cos² = 1."""
    slope = sp.diff(balance, unknown)
    solution = -balance.subs(unknown, 0) / slope
    return sp.factor(CircleField([solution]).reduced(solution))


@cache
def motion_of_columns(side: Side) -> sp.Expr:
    """θ̈ of a cap beam on N columns over ground that accelerates in both directions.

    The columns' moments about their pivots sum up to that of the force on the cap beam.
    """
    rest = column_moment(side, sp.zeros(2, 1))
    return solved(N * rest + moment(cap_contact(side), cap_force(side)), acceleration)


@cache
def column_motion(side: Side) -> sp.Expr:
    """θ̈ of the solitary column of any inertia I_o and mass m_c. # Eqs. (1)–(3)"""
    return solved(column_moment(side, sp.zeros(2, 1)).subs(OF_TWO), acceleration)


@cache
def frame_motion(side: Side) -> dict[sp.Symbol, sp.Expr]:
    """θ̈ and the forces on the cap beam of the frame of two columns; F_z1 stays free.

    # Eqs. (10)–(18) for θ < 0, Eqs. (20), (21) for θ > 0
    """
    motion = motion_of_columns(side).subs(OF_TWO)
    vertical = cap_force(side)[1].subs(OF_TWO).subs(acceleration, motion) - F_z1
    solution = {acceleration: motion, F_z2: vertical}
    for across, up in ((F_x1, F_z1), (F_x2, F_z2)):
        balance = column_moment(side, sp.Matrix([across, up])).subs(OF_TWO)
        solution[across] = solved(balance.subs(solution), across)
    return solution


@cache
def equation_of_motion(side: Side) -> sp.Eq:
    """The frame's equation of motion, with rectangular columns. # Eqs. (19), (22), (23)"""
    motion = frame_motion(side)[acceleration].subs(RECTANGULAR_OF_TWO)
    return sp.Eq(acceleration, sp.factor(motion))


def squared_frequency(motion: sp.Expr, side: Side) -> sp.Expr:
    """p² or p̂² of an equation of motion: what multiplies −sin(α sgn θ − θ). # Eqs. (3), (23)"""
    restoring = -side.sign * sp.sin(side.lean)
    return sp.simplify(motion.subs(ground_acceleration, 0) / restoring)


def frequency_ratio() -> sp.Expr:
    """p̂/p, the frame's frequency parameter over its column's, in γ. # Eq. (23)"""
    frame = squared_frequency(frame_motion(NEGATIVE)[acceleration], NEGATIVE)
    column = squared_frequency(column_motion(NEGATIVE), NEGATIVE)
    return sp.sqrt(sp.factor((frame / column).subs(RECTANGULAR_OF_TWO)))


def size_ratio() -> sp.Expr:
    """R̂/R, the size of the column that rocks like the frame over that of the frame's, in γ.

    p² is inversely proportional to R for columns of the same shape. # Eq. (24)
    """
    return 1 / frequency_ratio() ** 2


def uplift_acceleration(motion: sp.Expr, side: Side) -> sp.Expr:
    """The ground acceleration at which θ̈ of the upright structure turns towards this side."""
    (threshold,) = sp.solve(side.upright(motion), ground_acceleration)
    return sp.simplify(threshold)


def quadratic_terms(side: Side) -> tuple[sp.Expr, sp.Expr]:
    """The terms in θ̇² that ü and v̈ each contribute to the cap beam's moment. # Eqs. (17), (18)"""
    cap = cap_motion(side)
    moments = (-cap.u_ddot * sp.cos(side.lean), -side.sign * cap.v_ddot * sp.sin(side.lean))
    first, second = (sp.expand(moment).coeff(velocity, 2) for moment in moments)
    return first, second


# Energies -----------------------------------------------------------------------------------------


@cache
def kinetic_energy(side: Side) -> sp.Expr:
    """T of both columns and the cap beam, over ground that moves to the right."""
    ground = sp.Matrix([ground_velocity, 0])
    column, cap = (rate(side, point(side)) + ground for point in (centre, cap_contact))
    spin = (I_o - m_c * R**2) * velocity**2
    return sp.simplify(m_c * column.dot(column) + spin + m_b * cap.dot(cap) / 2)


def potential_energy(side: Side) -> sp.Expr:
    """V of both columns and the cap beam, from the upright position."""
    column, cap = ((x(side) - side.upright(x(side)))[1] for x in (centre, cap_contact))
    return 2 * m_c * g * column + m_b * g * cap


def lagrange_equation(side: Side) -> sp.Eq:
    """The frame's equation of motion by Lagrange, with rectangular columns. # Eqs. (19), (22)"""
    kinetic = kinetic_energy(side)
    momentum = side.time_derivative(sp.diff(kinetic, velocity))
    balance = momentum - sp.diff(kinetic - potential_energy(side), side.rotation)
    motion = solved(sp.expand(balance).subs(RECTANGULAR_OF_TWO), acceleration)
    return sp.Eq(acceleration, sp.factor(motion))


# The impact at θ = 0 ------------------------------------------------------------------------------


def jump(side: Side, before: sp.ImmutableMatrix, after: sp.ImmutableMatrix) -> sp.ImmutableMatrix:
    """The jump of the velocity of a point, given from both pivots, at the change to the side."""
    new = side.upright(rate(side, after)).subs(velocity, velocity_after)
    return new - side.other.upright(rate(side.other, before)).subs(velocity, velocity_before)


@cache
def restitution_of_columns(side: Side) -> sp.Expr:
    """√r = θ̇_2/θ̇_1 of N columns and their cap beam, of any inertia, that change over to the side.

    The angular momentum of each column about its new pivot changes by the impulse on the cap beam.
    """
    column, cap = (jump(side, point(side.other), point(side)) for point in (centre, cap_contact))
    arm, top = (side.upright(point(side)) for point in (centre, cap_contact))
    spin = (I_o - m_c * R**2) * (velocity_after - velocity_before)
    balance = N * (m_c * moment(arm, column) + spin) + m_b * moment(top, cap)
    return solved(sp.expand_trig(balance), velocity_after) / velocity_before


@cache
def restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r of the frame that changes over to the side, in α and γ. # Eq. (25)"""
    ratio = restitution_of_columns(side).subs(OF_TWO).subs(RECTANGULAR_OF_TWO)
    numerator, denominator = sp.fraction(sp.factor(sp.expand(sp.expand_trig(ratio))))
    scale = denominator.subs(gamma, 0)
    numerator = sp.collect(sp.expand(numerator / scale), gamma, sp.trigsimp)
    return numerator / sp.expand(denominator / scale)


@cache
def column_restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r of the solitary column, in α. # Housner (1963)"""
    ratio = restitution_of_columns(side).subs(m_b, 0).subs(RECTANGULAR)
    return sp.factor(CircleField([ratio]).reduced(ratio))


def tangent_form(expression: sp.Expr) -> sp.Expr:
    """A function of even powers of sin α and cos α as a rational function of x = tan² α > 0."""
    x = sp.Symbol("x", positive=True)
    values = {sp.sin(alpha): sp.sqrt(x / (1 + x)), sp.cos(alpha): 1 / sp.sqrt(1 + x)}
    return sp.factor(sp.expand_trig(expression).subs(values))
