"""What moves where: the rigid rectangle on its pivot corner, and the cap-beam that it carries.

The frame is a parallelogram linkage: its columns are equal and turn by the same angle, so the
two corners that carry the cap-beam stay level, and the beam translates without turning.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from topheavy.derivation.notation import R, Side, alpha, b, h, m


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
    """The corner (x, z) that carries the cap-beam, from the pivot: the one diagonally across."""
    return _turned(side, -side.sign * R * sp.sin(alpha), R * sp.cos(alpha))


@cache
def above_top(side: Side, height: Any) -> sp.ImmutableMatrix:
    """The point (x, z) of the column's axis at a height above its top, from the pivot."""
    return _turned(side, 0, R * sp.cos(alpha) + height)


@dataclass(frozen=True)
class CapMotion:
    """The cap-beam's translation relative to the ground, Eqs. (4)–(9)."""

    u: sp.Expr
    u_dot: sp.Expr
    u_ddot: sp.Expr
    v: sp.Expr
    v_dot: sp.Expr
    v_ddot: sp.Expr


@cache
def cap_motion(side: Side) -> CapMotion:
    """The cap-beam's displacement, velocity and acceleration, as functions of θ, θ̇ and θ̈.

    It goes with the corners that carry it, from where they are when the frame stands upright.
    # Eqs. (4)–(9)
    """
    contact = cap_contact(side)
    displacement = contact - side.upright(contact)
    motion = []
    for component in displacement:
        rate = side.time_derivative(component)
        motion += [component, rate, side.time_derivative(rate)]
    return CapMotion(*motion)
