"""Balls of Arb: exact decimals, hulls, outward bounds, and the refusal to guess."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

try:
    from flint import arb, arb_mat, arb_poly, ctx, fmpq
except ImportError as error:
    raise ImportError(
        "topheavy.proven needs python-flint, which is not installed; "
        'install the extra: pip install "topheavy[proven]"'
    ) from error

__all__ = ["Undecided", "arb", "arb_mat", "arb_poly", "bounds", "exact", "hull", "power"]
__all__ += ["precision", "root", "within"]


class Undecided(Exception):
    """The enclosures do not decide; the argument is the cause in a word."""


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Compute in balls of so many bits; the former precision returns at the end."""
    before, ctx.prec = ctx.prec, bits
    try:
        yield
    finally:
        ctx.prec = before


def decimal(number: float) -> Fraction:
    """Return the decimal that a float is printed as: 0.1 is 1/10, and not its binary neighbour."""
    return Fraction(repr(float(number)))


def exact(number: float | Fraction) -> arb:
    """Return the ball of a number that is given, of a float that of its `decimal`."""
    value = number if isinstance(number, Fraction) else decimal(number)
    return arb(fmpq(value.numerator, value.denominator))


def within(number: Any) -> arb:
    """Return the ball of a number, or of a pair (low, high) the ball that contains both."""
    if isinstance(number, tuple):
        low, high = map(exact, number)
        return low.union(high)
    return exact(number)


def hull(low: Any, high: Any) -> arb:
    """Return a ball that contains two numbers or balls, and all between."""
    return arb(low).union(arb(high))


def power(ball: arb, exponent: int) -> arb:
    """Return a power by products: python-flint's `**` gives NaN for a ball that contains zero."""
    found = arb(1)
    for _ in range(exponent):
        found *= ball
    return found


def bounds(ball: arb) -> tuple[float, float]:
    """Return floats that enclose a ball: float() rounds to the nearest, which may lie inside.

    Raises
    ------
    Undecided
        For NaN, which a float comparison would take for a number.
    """
    low, high = float(ball.lower()), float(ball.upper())
    if math.isnan(low) or math.isnan(high):
        raise Undecided("enclosure")
    return math.nextafter(low, -math.inf), math.nextafter(high, math.inf)


def root(value: Callable[[arb], arb], slope: Callable[[arb], arb], low: arb, high: arb) -> arb:
    """Enclose the one root of a function between two numbers where it has different signs.

    Interval Newton, and a bisection where that does not halve the bracket, as close to a zero of
    the slope. It ends where not even the sign in the middle is known. `value` takes a number and
    `slope` a ball; the function need not be monotone, only change its sign once. The ends stay
    numbers of known sign: a ball of them is rounded outward, perhaps beyond a second zero.

    Raises
    ------
    Undecided
        If the signs at the ends are not known to differ.
    """
    first, last = value(low), value(high)
    rises = first < 0 < last
    if not rises and not first > 0 > last:
        raise Undecided("root")
    while True:
        bracket = hull(low, high)
        middle = bracket.mid()
        if not low < middle < high:
            return bracket
        here, steep = value(middle), slope(bracket)
        if not steep.contains(0):
            newton, width = middle - here / steep, high - low
            low, high = max(low, newton.lower()), min(high, newton.upper())
            if high - low < width / 2:
                continue
        if here.contains(0):
            return hull(low, high)
        if (here > 0) == rises:
            high = min(high, middle)
        else:
            low = max(low, middle)
