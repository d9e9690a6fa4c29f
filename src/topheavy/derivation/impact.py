"""The impact at θ = 0: impulse and momentum of the three bodies, Eq. (25).

The rotation continues in the same direction; the impulses act at the new pivots, at the ground and
under the cap-beam. Both components of the cap-beam's momentum jump: its horizontal velocity drops,
and its vertical velocity turns from falling to rising. Its moments are not needed here either.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from topheavy.derivation.bodies import GROUND_1, column_balance, frame_balance, solve
from topheavy.derivation.equilibrium import RECTANGULAR
from topheavy.derivation.geometry import cap_motion, centre
from topheavy.derivation.notation import (
    POSITIVE,
    CircleField,
    Side,
    alpha,
    gamma,
    velocity,
    velocity_after,
    velocity_before,
)


def _jump(before: sp.Matrix, after: sp.Matrix, side: Side) -> sp.Matrix:
    """The jump of a velocity as the frame changes over to the side."""
    return side.upright(after).subs(velocity, velocity_after) - side.other.upright(before).subs(
        velocity, velocity_before
    )


def _centre_velocity(side: Side) -> sp.Matrix:
    return centre(side).applyfunc(side.time_derivative)


def _cap_velocity(side: Side) -> sp.Matrix:
    cap = cap_motion(side)
    return sp.Matrix([cap.u_dot, cap.v_dot])


def _ratio(balance: list[sp.Expr]) -> sp.Expr:
    """θ̇_2/θ̇_1 from a balance of impulses."""
    ratio = solve(balance, velocity_after)[velocity_after] / velocity_before
    ratio = sp.expand_trig(ratio.subs(RECTANGULAR))
    return CircleField([ratio]).reduced(ratio)


def frame_impact(side: Side) -> list[sp.Expr]:
    """The frame's balances of impulse, as it changes over to the side, which vanish.

    The cap-beam's moments are left out, as in the equilibrium.
    """
    column = _jump(_centre_velocity(side.other), _centre_velocity(side), side)
    cap = _jump(_cap_velocity(side.other), _cap_velocity(side), side)
    balance = frame_balance(side, column, velocity_after - velocity_before, cap)
    return [side.upright(equation) for equation in balance]


@cache
def restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r = θ̇_2/θ̇_1 of the frame that changes over to the side, in α and γ. # Eq. (25)"""
    ratio = _ratio(frame_impact(side))
    numerator, denominator = sp.fraction(sp.factor(sp.expand(sp.expand_trig(ratio))))
    scale = denominator.subs(gamma, 0)
    numerator = sp.collect(sp.expand(numerator / scale), gamma, sp.trigsimp)
    return numerator / sp.expand(denominator / scale)


@cache
def column_restitution(side: Side = POSITIVE) -> sp.Expr:
    """√r = θ̇_2/θ̇_1 of the solitary column, in α. # Housner (1963)"""
    jump = _jump(_centre_velocity(side.other), _centre_velocity(side), side)
    spin = velocity_after - velocity_before
    balance = column_balance(side, jump, spin, GROUND_1, sp.zeros(2, 1))
    return _ratio([side.upright(equation) for equation in balance])


def tangent_form(expression: sp.Expr) -> sp.Expr:
    """A function of even powers of sin α and cos α as a rational function of x = tan² α > 0."""
    x = sp.Symbol("x", positive=True)
    values = {sp.sin(alpha): sp.sqrt(x / (1 + x)), sp.cos(alpha): 1 / sp.sqrt(1 + x)}
    return sp.factor(sp.expand_trig(expression).subs(values))


def largest_slenderness() -> sp.Expr:
    """The α at which √r of the frame is zero: a stockier one does not keep rocking. # Eq. (25)"""
    return _root(restitution())


def energy_slenderness() -> sp.Expr:
    """The α at which the frame and its column lose the same share of energy, √r being opposite."""
    return _root(restitution() + column_restitution())


def _root(expression: sp.Expr) -> sp.Expr:
    (root,) = sp.solve(tangent_form(expression), sp.Symbol("x", positive=True))
    return sp.atan(sp.sqrt(sp.factor(root)))
