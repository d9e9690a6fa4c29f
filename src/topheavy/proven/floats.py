"""The equation of motion in floats, for a block and a pulse of the checker.

The search guesses its steps with it; no proof depends on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction

from topheavy.proven.checking import intervals
from topheavy.proven.checking.checker import Check
from topheavy.proven.checking.intervals import Interval, enclose

N_PARTS = 24
"""Parts of a step, at whose ends the sign of its polynomial is computed."""


def ends(x: Interval) -> tuple[float, float]:
    """Return an interval in floats."""
    return x.low / intervals.UNIT, x.high / intervals.UNIT


def middle(x: Interval) -> float:
    """Return the middle of an interval."""
    return (x.low + x.high) / 2 / intervals.UNIT


def evaluate(coefficients: Sequence[float], time: float) -> float:
    """Return the value of a polynomial."""
    total = 0.0
    for x in reversed(coefficients):
        total = total * time + x
    return total


def first_zero(coefficients: Sequence[float], h: float) -> float | None:
    """Return about the first zero in (0, h] of a polynomial that begins positive, or None."""
    low = 0.0
    for k in range(1, N_PARTS + 1):
        high = h * k / N_PARTS
        if evaluate(coefficients, high) <= 0.0:
            return crossing(low, high, lambda time: evaluate(coefficients, time) <= 0.0)
        low = high
    return None


def crossing(low: float, high: float, is_beyond: Callable[[float], bool]) -> float:
    """Return by bisection where a statement becomes true, to the last digit."""
    while low < (half := 0.5 * (low + high)) < high:
        low, high = (low, half) if is_beyond(half) else (half, high)
    return high


class Floats:
    """The middle of a box of blocks under the middle of a box of pulses."""

    def __init__(self, check: Check) -> None:
        self.block, self.ground = check.block, check.ground
        self.linearised = self.block.linearised
        self.alpha, self.kappa_squared = middle(self.block.alpha), middle(self.ground.kappa_squared)
        self.sine, self.cosine = middle(self.block.sine), middle(self.block.cosine)
        self.uplift_level = middle(self.block.uplift_level)

    def wave(self, sigma: float, n: int) -> list[float]:
        """Return n coefficients of a at a phase."""
        return [middle(x) for x in self.ground.series(enclose(Fraction(sigma)), enclose(1), n)]

    def potential(self, phi: float, push: float) -> float:
        """Return V(φ, s a)."""
        if self.linearised:
            return self.kappa_squared * phi * (self.alpha - phi / 2.0 + push)
        return self.kappa_squared * (
            math.cos(self.alpha - phi) - self.cosine + push * self.lever(phi)
        )

    def lever(self, phi: float) -> float:
        """Return ψ(φ)."""
        return phi if self.linearised else self.sine - math.sin(self.alpha - phi)

    def turn(self, energy: float, push: float) -> float:
        """Return the φ at which a block with this energy turns, or infinity."""
        level = energy / self.kappa_squared
        if self.linearised:
            depth = self.alpha + push
            inside = depth * depth - 2.0 * level
            return depth - math.sqrt(inside) if inside > 0.0 < depth else math.inf
        depth = self.alpha + math.atan(push)
        top = (level + self.cosine - push * self.sine) / math.hypot(1.0, push)
        return depth - math.acos(top) if -1.0 < top < 1.0 and depth > 0.0 else math.inf

    def series(self, phi: float, rate: float, push: Sequence[float], n: int) -> list[float]:
        """Return coefficients 0 to n of φ."""
        x, kappa_squared = [phi, rate], self.kappa_squared
        if self.linearised:
            x.append(kappa_squared * (phi - self.alpha - push[0]) / 2.0)
            for k in range(1, n - 1):
                x.append(kappa_squared * (x[k] - push[k]) / ((k + 1) * (k + 2)))
            return x
        s, c, v = [math.sin(self.alpha - phi)], [math.cos(self.alpha - phi)], [rate]
        for k in range(n - 1):
            pushed = math.fsum(push[j] * c[k - j] for j in range(k + 1))
            x.append(-kappa_squared * (s[k] + pushed) / ((k + 1) * (k + 2)))
            s.append(-math.fsum(v[j] * c[k - j] for j in range(k + 1)) / (k + 1))
            c.append(math.fsum(v[j] * s[k - j] for j in range(k + 1)) / (k + 1))
            v.append((k + 2) * x[k + 2])
        return x
