"""Interval arithmetic with integers in fixed point, rounded outward."""

import math
from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache

PLACES = 0  # P of all intervals, set by `precision`
UNIT = 1  # 2^P


class NotProven(ValueError):
    """A step of a certificate is not proven; the argument names the step and the reason."""


def precision(bits: int) -> None:
    """Let all intervals from now on have so many bits behind the point."""
    global PLACES, UNIT
    PLACES, UNIT = bits, 1 << bits


class Interval:
    """Numbers between low/2^P and high/2^P."""

    __slots__ = ("high", "low")

    def __init__(self, low: int, high: int) -> None:
        self.low, self.high = low, high

    def __add__(self, other: "Interval | int") -> "Interval":
        if not isinstance(other, Interval):
            other = enclose(other)
        return Interval(self.low + other.low, self.high + other.high)

    def __neg__(self) -> "Interval":
        return Interval(-self.high, -self.low)

    def __sub__(self, other: "Interval | int") -> "Interval":
        if not isinstance(other, Interval):
            other = enclose(other)
        return Interval(self.low - other.high, self.high - other.low)

    def __mul__(self, other: "Interval | int") -> "Interval":
        if isinstance(other, int):
            low, high = self.low * other, self.high * other
            return Interval(low, high) if other >= 0 else Interval(high, low)
        low, high = extremes(self.low, self.high, other.low, other.high)
        return Interval(low >> PLACES, -(-high >> PLACES))

    def __truediv__(self, other: "Interval | int") -> "Interval":
        if isinstance(other, int):
            if other < 0:
                return -self / -other
            return Interval(self.low // other, -(-self.high // other))
        if other.low <= 0 <= other.high:
            raise NotProven("a divisor may be zero")
        pairs = [(n * UNIT, d) for n in (self.low, self.high) for d in (other.low, other.high)]
        return Interval(min(n // d for n, d in pairs), max(-(-n // d) for n, d in pairs))

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: int) -> "Interval":
        return enclose(other) - self

    def __gt__(self, other: "Interval | int") -> bool:
        return self.low > (other.high if isinstance(other, Interval) else other * UNIT)

    def __lt__(self, other: "Interval | int") -> bool:
        return self.high < (other.low if isinstance(other, Interval) else other * UNIT)

    @property
    def middle(self) -> int:
        """In units of 2^−P, rounded down."""
        return (self.low + self.high) // 2

    def inside(self, other: "Interval") -> bool:
        return other.low <= self.low and self.high <= other.high

    def hull(self, other: "Interval | int") -> "Interval":
        other = enclose(other)
        return Interval(min(self.low, other.low), max(self.high, other.high))

    def common(self, other: "Interval") -> "Interval":
        """Return the intersection of two enclosures of the same number."""
        low, high = max(self.low, other.low), min(self.high, other.high)
        if low > high:
            raise NotProven("two enclosures of a number do not meet")
        return Interval(low, high)

    def root(self) -> "Interval":
        if self.low < 0:
            raise NotProven("the argument of a root may be negative")
        return Interval(math.isqrt(self.low * UNIT), math.isqrt(self.high * UNIT) + 1)

    def size(self) -> "Interval":
        """Return |x|."""
        if self.low < 0 < self.high:
            return Interval(0, max(-self.low, self.high))
        return self if self.low >= 0 else -self


def enclose(number: "Interval | int | Fraction") -> Interval:
    """Return the narrowest interval that holds a number."""
    if isinstance(number, Interval):
        return number
    if isinstance(number, int):
        return Interval(number * UNIT, number * UNIT)
    over, under = number.numerator * UNIT, number.denominator
    return Interval(over // under, -(-over // under))


def extremes(a: int, b: int, c: int, d: int) -> tuple[int, int]:
    """Return the lowest and the highest product of a number from a to b and one from c to d."""
    if a >= 0:
        return (a if c >= 0 else b) * c, (b if d >= 0 else a) * d
    if b <= 0:
        return (a if d >= 0 else b) * d, (b if c >= 0 else a) * c
    return min(a * d, b * c), max(a * c, b * d)


def dot(one: Iterable[Interval], other: Iterable[Interval]) -> Interval:
    """Return the sum of products, rounded once, up to the end of the shorter series."""
    low = high = 0
    for x, y in zip(one, other, strict=False):
        least, most = extremes(x.low, x.high, y.low, y.high)
        low, high = low + least, high + most
    return Interval(low >> PLACES, -(-high >> PLACES))


def point(number: int) -> Interval:
    """Return the interval that holds number/2^P alone."""
    return Interval(number, number)


def _powers(x: int, places: int, turns: bool) -> list[Interval]:
    """Return Σ xᵏ/k! of a number x/2^places over even k, odd k and all k.

    If it turns, the signs of cosine and sine are in the sums.
    """
    bits = 64 + 2 * (abs(x) >> places)  # lost where large terms cancel
    x, places = x << bits, places + bits
    unit = 1 << places
    sums, term, k = [0, 0], unit, 0
    while abs(term) > 1 or k * unit < 2 * abs(x):
        sums[k & 1] += -term if turns and k & 2 else term
        k += 1
        term = (term * x >> places) // k
    error = 4 * (k + 1) * (1 + (3 ** (abs(x) // unit + 1)))  # each term is short of one unit
    ends = [((total - error) >> bits, -(-(total + error) >> bits)) for total in (*sums, sum(sums))]
    return [Interval(*each) for each in ends]


@lru_cache(256)
def _turned(low: int, high: int, places: int) -> tuple[Interval, Interval]:
    """Return cosine and sine of an interval: by its middle m and radius r, |f'| ≤ |f'(m)| + r."""
    middle, radius = (low + high) // 2, (high - low) // 2 + 1
    if max(radius, abs(middle) >> 10) > 4 * UNIT:  # more than a turn, or far beyond any proof
        return Interval(-UNIT, UNIT), Interval(-UNIT, UNIT)
    cosine, sine, _ = _powers(middle, places, True)
    return _around(cosine, sine, radius), _around(sine, cosine, radius)


def _around(value: Interval, slope: Interval, radius: int) -> Interval:
    steep = min(UNIT, slope.size().high + radius) if 16 < radius < UNIT else UNIT
    off = radius * steep // UNIT + 1
    return Interval(max(value.low - off, -UNIT - 1), min(value.high + off, UNIT + 1))


def sine(x: Interval) -> Interval:
    return _turned(x.low, x.high, PLACES)[1]


def cosine(x: Interval) -> Interval:
    return _turned(x.low, x.high, PLACES)[0]


def exponential(x: Interval) -> Interval:
    """Return exp(−x) for x ≥ 0, up to a rounding below; beyond x = P it is less than 2^−P."""
    ends = [max(0, min(end, PLACES * UNIT)) for end in (x.low, x.high)]
    most, least = (enclose(1) / _powers(end, PLACES, False)[2] for end in ends)
    return Interval(least.low if ends[1] == x.high else 0, most.high)


def arctangent(x: Interval) -> Interval:
    """Return atan x for x > 0: halved until the series is short."""
    halvings = 8
    for _ in range(halvings):
        x = x / ((x * x + 1).root() + 1)
    square, term, total, k = x * x, x, enclose(0), 0
    while term.high > 1:
        total = total + (term if k % 2 == 0 else -term) / (2 * k + 1)
        term, k = term * square, k + 1
    return (total + Interval(-2, 2)) * (1 << halvings)
