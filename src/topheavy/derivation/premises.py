"""The premises of each group of printed equations: the derived value of every quantity.

We substitute the derived values into each equation. The equation follows from its premises if the
difference of its members vanishes identically.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from functools import cache
from typing import TypeAlias

import sympy as sp

from topheavy.derivation import geometry
from topheavy.derivation.equilibrium import (
    RECTANGULAR,
    column_motion,
    equation_of_motion,
    frame_motion,
    frequency_ratio,
    size_ratio,
    squared_frequency,
)
from topheavy.derivation.impact import column_restitution, restitution
from topheavy.derivation.lagrange import kinetic_energy
from topheavy.derivation.notation import (
    NEGATIVE,
    I_o,
    R,
    Side,
    acceleration,
    alpha,
    gamma,
    ground_velocity,
    m,
    m_b,
    m_c,
    velocity,
    velocity_after,
    velocity_before,
)

Values: TypeAlias = dict[sp.Symbol, sp.Expr]
Premises: TypeAlias = Callable[[Side], Values]


@cache
def rectangle(side: Side) -> Values:
    """The column's size, slenderness and moment of inertia, from its half-width and half-height."""
    inertia = geometry.moment_of_inertia()
    return {R: geometry.size(), alpha: geometry.slenderness(), I_o: inertia}


@cache
def column(side: Side) -> Values:
    """The solitary column's equation of motion, and p² for what multiplies the restoring sine."""
    motion = column_motion(side)
    squared = squared_frequency(column_motion(NEGATIVE), NEGATIVE)
    return {m: m_c, acceleration: motion, sp.Symbol("p"): sp.sqrt(squared)}


@cache
def rectangular_column(side: Side) -> Values:
    """p of a rectangular column."""
    return {name: value.subs(RECTANGULAR) for name, value in column(side).items()}


@cache
def kinematics(side: Side) -> Values:
    """The cap-beam's displacements, velocities and accelerations, from the geometry."""
    motion = geometry.cap_motion(side)
    return {sp.Symbol(name): getattr(motion, name) for name in asdict(motion)}


@cache
def frame(side: Side) -> Values:
    """θ̈, all forces and the cap-beam's accelerations, on every motion of the three bodies."""
    motion = frame_motion(side)
    return motion | {name: value.subs(motion) for name, value in kinematics(side).items()}


@cache
def rectangular_frame(side: Side) -> Values:
    """θ̈ of the frame of rectangular columns, with p of its columns and its own p̂ and R̂."""
    p = rectangular_column(side)[sp.Symbol("p")]
    return {
        acceleration: equation_of_motion(side).rhs,
        sp.Symbol("p"): p,
        sp.Symbol("p_hat"): frequency_ratio() * p,
        sp.Symbol("R_hat"): size_ratio() * R,
    }


@cache
def impact(side: Side) -> Values:
    """Velocities and the ratio of kinetic energies as the frame changes over to the side."""
    after = side.upright(kinetic_energy(side)).subs({velocity: velocity_after, ground_velocity: 0})
    before = side.other.upright(kinetic_energy(side.other))
    before = before.subs({velocity: velocity_before, ground_velocity: 0})
    change = {velocity_after: restitution(side) * velocity_before}
    return change | {sp.Symbol("r"): (after / before).subs(change)}


@cache
def column_impact(side: Side) -> Values:
    """Velocities as the solitary column changes over to the side."""
    return {velocity_after: column_restitution(side) * velocity_before}


@cache
def masses(side: Side) -> Values:
    """γ, the mass of the cap-beam over that of both columns."""
    return {gamma: m_b / (m_c + m_c)}


@cache
def harmonic_base(side: Side) -> Values:
    """The largest acceleration of a base that moves by u_o sin 2πft."""
    u_o, f, t = sp.symbols("u_o f t")
    displacement = u_o * sp.sin(2 * sp.pi * f * t)
    return {sp.Symbol("amplitude"): -sp.diff(displacement, t, 2).subs(t, 1 / (4 * f))}
