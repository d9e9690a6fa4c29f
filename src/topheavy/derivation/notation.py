"""The symbols of the derivation, the two sides of the motion, and how an equation is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.parsing.sympy_parser import (
    implicit_multiplication,
    parse_expr,
    standard_transformations,
)

R, g, b, h = sp.symbols("R g b h", positive=True)
m, m_c, m_b, I_o = sp.symbols("m m_c m_b I_o", positive=True)
alpha, gamma = sp.symbols("alpha gamma", positive=True)
velocity, acceleration = sp.symbols(r"\dot{\theta} \ddot{\theta}", real=True)
ground_velocity, ground_acceleration = sp.symbols(r"\dot{u}_g \ddot{u}_g", real=True)
velocity_before, velocity_after = sp.symbols(r"\dot{\theta}_1 \dot{\theta}_2", real=True)
F_x1, F_x2, F_z1, F_z2 = sp.symbols("F_{x1} F_{x2} F_{z1} F_{z2}", real=True)


@dataclass(frozen=True)
class Side:
    """One of the two sides to which the column or frame rocks.

    Parameters
    ----------
    sign
        sgn θ: −1 leans to the left, on the left corners; +1 to the right.
    """

    sign: int

    @property
    def rotation(self) -> sp.Symbol:
        """The rotation θ, clockwise positive, which knows its sign."""
        return sp.Symbol("theta", negative=True) if self.sign < 0 else THETA_POSITIVE

    @property
    def label(self) -> str:
        """The side as the paper names it."""
        return "θ < 0" if self.sign < 0 else "θ > 0"

    @property
    def lean(self) -> sp.Expr:
        """α − |θ|, the angle of the diagonal through the pivot against the vertical."""
        return alpha - self.sign * self.rotation

    @property
    def other(self) -> Side:
        """The side that the frame rocks to after the next impact."""
        return POSITIVE if self.sign < 0 else NEGATIVE

    def upright(self, expression: Any) -> Any:
        """The expression in the upright position, θ → 0 from this side."""
        return expression.subs(self.rotation, 0)

    def time_derivative(self, expression: Any) -> Any:
        """d/dt of an expression in θ, θ̇ and the ground's velocity, by the chain rule."""
        rates = {
            self.rotation: velocity,
            velocity: acceleration,
            ground_velocity: ground_acceleration,
        }
        terms = [sp.diff(expression, state) * rate for state, rate in rates.items()]
        return sum(terms[1:], start=terms[0])


THETA_POSITIVE = sp.Symbol("theta", positive=True)
NEGATIVE = Side(-1)
POSITIVE = Side(+1)
SIDES = (NEGATIVE, POSITIVE)

# Characters that a Python name cannot contain, and their replacements.
_SPELLING = {
    "ü_go": "amplitude",
    "ü_g": "ground_acceleration",
    "θ̇_1": "velocity_before",
    "θ̇_2": "velocity_after",
    "θ̈": "acceleration",
    "θ̇": "velocity",
    "ü": "u_ddot",
    "u̇": "u_dot",
    "v̈": "v_ddot",
    "v̇": "v_dot",
    "p̂": "p_hat",
    "R̂": "R_hat",
    "|θ|": "abs(θ)",
    "√r": "velocity_after/velocity_before",
    "²": "**2",
    "−": "-",
    "√": "sqrt",
}
_SYMBOLS = {
    "R": R, "g": g, "b": b, "h": h, "m": m, "m_c": m_c, "m_b": m_b, "I_o": I_o,
    "α": alpha, "γ": gamma, "velocity": velocity, "acceleration": acceleration,
    "ground_acceleration": ground_acceleration,
    "velocity_before": velocity_before, "velocity_after": velocity_after,
    "F_x1": F_x1, "F_x2": F_x2, "F_z1": F_z1, "F_z2": F_z2,
    "sgn": sp.sign, "π": sp.pi,
}  # fmt: skip
SYMBOLS = tuple(symbol for symbol in _SYMBOLS.values() if isinstance(symbol, sp.Symbol))


def read(equation: str, side: Side) -> list[sp.Expr]:
    """Read an equation written as on paper into the members between its equality signs.

    A double sign is resolved for the side: the top sign is for θ < 0. Nothing is interpreted
    beyond that: a letter unknown to this module becomes a symbol of its own, and a product binds
    as tightly as a quotient.

    Parameters
    ----------
    equation
        For example ``"u̇ = 2R cos(α ± θ) θ̇"``.
    side
        The side on which the equation is meant to hold.

    Returns
    -------
    list of sympy expressions
        The members of the equation, two or more.
    """
    top, bottom = ("+", "-") if side.sign < 0 else ("-", "+")
    equation = equation.replace("±", top).replace("∓", bottom)
    for written, name in _SPELLING.items():
        equation = equation.replace(written, name)
    names = _SYMBOLS | {"θ": side.rotation}
    rules = (*standard_transformations, implicit_multiplication)
    return [
        parse_expr(member.strip(), local_dict=dict(names), transformations=rules)
        for member in equation.split("=")
    ]


def vanishes(expression: Any, side: Side) -> bool:
    """Whether an expression is identically zero, decided exactly.

    With α and the lean α − |θ| for independent angles, and the tangents of their halves for
    variables, it is a rational function; that is zero if and only if its numerator expands to 0.
    """
    lean = sp.Symbol("lambda", positive=True)
    rotation = side.sign * (alpha - lean)
    independent = sp.expand_trig(sp.sympify(expression).subs(side.rotation, rotation))
    rational = (
        independent.replace(sp.tan, lambda angle: sp.sin(angle) / sp.cos(angle))
        .replace(sp.sin, lambda angle: 2 * _half(angle) / (1 + _half(angle) ** 2))
        .replace(sp.cos, lambda angle: (1 - _half(angle) ** 2) / (1 + _half(angle) ** 2))
    )
    numerator, _ = sp.fraction(sp.together(sp.expand_power_base(rational)))
    return bool(sp.expand(numerator) == 0)


def _half(angle: sp.Expr) -> sp.Symbol:
    return sp.Symbol(f"tan({angle}/2)", positive=True)
