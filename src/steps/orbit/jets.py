"""Balls with their derivatives by the numbers that they depend on: forward differentiation."""

from dataclasses import dataclass
from typing import Union

from topheavy.proven.balls import arb

Number = Union["Jet", arb, int]


@dataclass(eq=False, slots=True)
class Jet:
    """A ball, and those of its two derivatives; a number beside it is a constant."""

    value: arb
    slopes: tuple[arb, ...]

    def __add__(self, other: Number) -> "Jet":
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.slopes)
        (a, b), (c, d) = self.slopes, other.slopes
        return Jet(self.value + other.value, (a + c, b + d))

    def __neg__(self) -> "Jet":
        a, b = self.slopes
        return Jet(-self.value, (-a, -b))

    def __sub__(self, other: Number) -> "Jet":
        return self + -other

    def __rsub__(self, other: Number) -> "Jet":
        return -self + other

    def __mul__(self, other: Number) -> "Jet":
        x, (a, b) = self.value, self.slopes
        if not isinstance(other, Jet):
            return Jet(x * other, (a * other, b * other))
        y, (c, d) = other.value, other.slopes
        return Jet(x * y, (a * y + x * c, b * y + x * d))

    __radd__, __rmul__ = __add__, __mul__

    def __truediv__(self, number: arb | int) -> "Jet":
        a, b = self.slopes
        return Jet(self.value / number, (a / number, b / number))

    def sin_cos(self) -> tuple["Jet", "Jet"]:
        """Return sine and cosine."""
        sine, cosine = self.value.sin_cos()
        a, b = self.slopes
        return Jet(sine, (cosine * a, cosine * b)), Jet(cosine, (-sine * a, -sine * b))

    # Of a box, part by part: what `flight.a_priori` asks.

    def union(self, other: "Jet") -> "Jet":
        (a, b), (c, d) = self.slopes, other.slopes
        return Jet(self.value.union(other.value), (a.union(c), b.union(d)))

    def is_finite(self) -> bool:
        return self.value.is_finite() and all(x.is_finite() for x in self.slopes)

    def mid(self) -> "Jet":
        a, b = self.slopes
        return Jet(self.value.mid(), (a.mid(), b.mid()))

    def contains(self, other: "Jet") -> bool:
        pairs = zip(self.slopes, other.slopes, strict=True)
        return self.value.contains(other.value) and all(x.contains(y) for x, y in pairs)
