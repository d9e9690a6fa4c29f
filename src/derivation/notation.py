"""The symbols of the derivation, the two sides of the motion, and how an equation is read."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp
from sympy.parsing.sympy_parser import implicit_multiplication, parse_expr, standard_transformations

R, g, b, h = sp.symbols("R g b h", positive=True)
m, m_c, m_b, I_o = sp.symbols("m m_c m_b I_o", positive=True)
alpha, gamma = sp.symbols("alpha gamma", positive=True)
velocity, acceleration = sp.symbols(r"\dot{\theta} \ddot{\theta}", real=True)
ground_velocity, ground_acceleration = sp.symbols(r"\dot{u}_g \ddot{u}_g", real=True)
velocity_before, velocity_after = sp.symbols(r"\dot{\theta}_1 \dot{\theta}_2", real=True)
F_x1, F_x2, F_z1, F_z2 = sp.symbols("F_{x1} F_{x2} F_{z1} F_{z2}", real=True)
N = sp.Symbol("N", positive=True)
vertical_acceleration = sp.Symbol(r"\ddot{v}_g", real=True)
half_depth = sp.Symbol("d", positive=True)


@dataclass(frozen=True)
class Side:
    """One of the two sides to which the column or frame rocks."""

    sign: int
    """sgn θ: −1 leans to the left, on the left corners; +1 to the right."""

    @property
    def rotation(self) -> sp.Symbol:
        """The rotation θ, clockwise positive, which knows its sign."""
        sign = {"negative": True} if self.sign < 0 else {"positive": True}
        return sp.Symbol("theta", **sign)

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


def read(equation: str, side: Side) -> list[sp.Expr]:
    """Read an equation written as on paper into the members between its equality signs.

    For example ``"u̇ = 2R cos(α ± θ) θ̇"``. A double sign is resolved for the side on which the
    equation is meant to hold: the top sign is for θ < 0. Nothing is interpreted beyond that: a
    letter unknown to this module becomes a symbol of its own, and a product binds as tightly as a
    quotient.
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


class CircleField:
    """Rational functions of sines, cosines, roots and symbols, reduced by sin² + cos² = 1.

    The angles and the roots count as independent, and so do arc tangents and π. `plain` has a
    symbol for each function of them.
    """

    def __init__(self, expressions: Iterable[sp.Expr]) -> None:
        expressions = list(expressions)
        angles = sorted({f.args[0] for e in expressions for f in e.atoms(sp.sin, sp.cos)}, key=str)
        powers = {f for e in expressions for f in e.atoms(sp.Pow) if not f.exp.is_integer}
        roots = {power.base ** sp.Rational(1, power.exp.q) for power in powers}
        functions = [f(angle) for f in (sp.cos, sp.sin) for angle in angles]
        functions += sorted(roots, key=str)
        functions += sorted({f for e in expressions for f in e.atoms(sp.atan, sp.pi.func)}, key=str)
        self.plain = {function: sp.Dummy() for function in functions}
        self._roots = {root: self.plain[root] for root in roots}
        self._others = {f: symbol for f, symbol in self.plain.items() if f not in self._roots}
        present = {symbol for e in expressions for symbol in self.named(e).free_symbols}
        named = list(self.plain.values())  # the cosines lead, hence powers of these are reduced
        self._field = sp.QQ.frac_field(*named, *sorted(present - set(named), key=str))
        self._circles = [
            self._field.field.ring.from_expr(
                self.plain[sp.sin(angle)] ** 2 + self.plain[sp.cos(angle)] ** 2 - 1
            )
            for angle in angles
        ]

    def named(self, expression: sp.Expr) -> sp.Expr:
        """Return an expression with symbols for functions; other powers of a root need `subs`."""
        named = sp.sympify(expression).xreplace(self._others)
        return named.subs(self._roots) if self._roots else named

    def fraction(self, expression: sp.Expr) -> tuple[Any, Any]:
        """Return numerator and denominator; the expression is zero if and only if the first is.

        Raises
        ------
        ZeroDivisionError
            If the denominator is zero on the circles.
        """
        element = self._field.from_sympy(self.named(expression))
        parts = element.numer.rem(self._circles), element.denom.rem(self._circles)
        if not parts[1]:
            raise ZeroDivisionError(f"{expression} has the denominator 0")
        return parts

    def reduced(self, expression: sp.Expr) -> sp.Expr:
        """Return an expression with reduced numerator and denominator, in lowest terms."""
        numerator, denominator = map(self._field, self.fraction(expression))
        functions = {symbol: function for function, symbol in self.plain.items()}
        return (numerator / denominator).as_expr().subs(functions)


def is_identically_zero(expression: Any, side: Side) -> bool:
    """Whether an expression is identically zero, decided exactly.

    α and the lean α − |θ| are regarded as independent angles.
    """
    lean = sp.Symbol("lambda", positive=True)
    rotation = side.sign * (alpha - lean)
    independent = sp.expand_trig(sp.sympify(expression).subs(side.rotation, rotation))
    sines = independent.replace(sp.tan, lambda angle: sp.sin(angle) / sp.cos(angle))
    plain = sp.expand_power_base(sines)
    return not CircleField([plain]).fraction(plain)[0]


def vanishes(expression: Callable[[Side], Any]) -> bool:
    """Whether an expression is identically zero for θ < 0 and for θ > 0."""
    return all(is_identically_zero(expression(side), side) for side in SIDES)
