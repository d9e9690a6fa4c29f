"""Balls with their derivatives by the numbers that they depend on: forward differentiation."""

from collections.abc import Callable
from dataclasses import dataclass
from operator import add
from typing import Union

from topheavy.proven.balls import arb

Number = Union["Jet", arb, int]


@dataclass(eq=False, slots=True)
class Jet:
    """A ball, and those of its derivatives; a number beside it is a constant."""

    value: arb
    slopes: tuple[arb, ...]

    def __add__(self, other: Number) -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.slopes)
        return self._with(other, add)

    def __neg__(self) -> "Jet":
        return Jet(-self.value, tuple(-x for x in self.slopes))

    def __sub__(self, other: Number) -> "Jet":
        return self + -other

    def __rsub__(self, other: Number) -> "Jet":
        return -self + other

    def __mul__(self, other: Number) -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value * other, tuple(x * other for x in self.slopes))
        pairs = zip(self.slopes, other.slopes, strict=True)
        slopes = tuple(x * other.value + self.value * y for x, y in pairs)
        return Jet(self.value * other.value, slopes)

    __radd__, __rmul__ = __add__, __mul__

    def __truediv__(self, number: arb | int) -> "Jet":
        return Jet(self.value / number, tuple(x / number for x in self.slopes))

    def sin_cos(self) -> tuple["Jet", "Jet"]:
        """Return sine and cosine."""
        sine, cosine = self.value.sin_cos()
        grow, fall = (tuple(x * y for y in self.slopes) for x in (cosine, -sine))
        return Jet(sine, grow), Jet(cosine, fall)

    # Of a box, part by part: what `flight.a_priori` asks.

    def union(self, other: "Jet") -> "Jet":
        return self._with(other, arb.union)

    def is_finite(self) -> bool:
        return self.value.is_finite() and all(x.is_finite() for x in self.slopes)

    def mid(self) -> "Jet":
        return Jet(self.value.mid(), tuple(x.mid() for x in self.slopes))

    def contains(self, other: "Jet") -> bool:
        pairs = zip(self.slopes, other.slopes, strict=True)
        return self.value.contains(other.value) and all(x.contains(y) for x, y in pairs)

    def _with(self, other: "Jet", change: Callable[[arb, arb], arb]) -> "Jet":
        slopes = tuple(map(change, self.slopes, other.slopes))
        return Jet(change(self.value, other.value), slopes)
