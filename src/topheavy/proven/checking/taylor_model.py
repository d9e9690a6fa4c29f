"""One step of a motion: an a priori box, Taylor polynomials and their remainders.

φ, φ', sine and cosine of α − φ are developed together, in units of the step.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Protocol

from . import intervals
from .intervals import Interval, NotProven, cosine, dot, enclose, extremes, sine
from .model import Block, Ground

MAX_BOXES = 12  # tried for one step

Series = tuple[list[Interval], list[Interval], list[Interval], list[Interval]]


class State(Protocol):
    """The start of a step: block, ground, the state at σ, and the order of the zero of φ there."""

    block: Block
    ground: Ground
    order: int
    side: int
    sigma: Interval
    phi: Interval
    rate: Interval
    zero_order: int


class TaylorModel:
    """φ and φ' over a step as polynomials in τ = t/h, the last coefficients being remainders."""

    def __init__(self, start: State, h: Fraction) -> None:
        self.h, self.kappa = enclose(h), start.ground.kappa_squared
        span, time = start.sigma + self.h.hull(0), self.h.hull(0)
        push = start.side * start.ground.at(span)
        phi, rate, n = start.phi, start.rate, start.order
        image = phi.hull(phi + self.h * rate)
        for _ in range(MAX_BOXES):  # Picard: a box that holds its own image holds the motion
            slack = (image.high - image.low) // 16 + (intervals.UNIT >> 30)
            box = Interval(image.low - slack, image.high + slack)
            force = -self.kappa * start.block.pull(box, push)
            image = phi + time * rate + (self.h * self.h / 2).hull(0) * force
            if image.inside(box):
                break
        else:
            raise NotProven("no box holds the motion of the step")
        self.box = image
        self.phi, self.rate, slopes, lever = self._develop(start, start.sigma, phi, rate)
        ends = self._develop(start, span, image, rate + time * force)
        self.phi[n], self.rate[n] = ends[0][n], ends[1][n]
        gains = [self._gain(slopes, lever, k) for k in range(1, n - 1)]
        self.gain = [enclose(0), *gains, self._gain(*ends[2:], n - 1)]
        self.phi[: start.zero_order] = [enclose(0)] * start.zero_order

    def _develop(self, start: State, sigma: Interval, phi: Interval, rate: Interval) -> Series:
        """Return the coefficients 0 to n of φ and φ', and those of s a' and ψ.

        φ' = V,  V' = −κ² (S + s a C);  S, C = sin, cos (α − φ):  S' = −C V,  C' = S V.
        """
        block, n, h = start.block, start.order, self.h
        push = [start.side * x for x in start.ground.series(sigma, h, n)]
        x, v, s, c = [phi], [rate], [sine(block.alpha - phi)], [cosine(block.alpha - phi)]
        back, force = -h, -h * self.kappa
        for k in range(n):
            if block.linearised:
                pull = push[k] - x[k] + (block.alpha if k == 0 else enclose(0))
            else:
                cosines = c[::-1]
                pull = s[k] + dot(push, cosines)
                falls, grows = dot(v, cosines), dot(v, s[::-1])
                s.append(back * falls / (k + 1))
                c.append(h * grows / (k + 1))
            x.append(h * v[k] / (k + 1))
            v.append(force * pull / (k + 1))
        lever = x if block.linearised else [block.lever(phi), *(-each for each in s[1:])]
        return x, v, [(j + 1) * each for j, each in enumerate(push[1:])], lever

    def _gain(self, slopes: list[Interval], lever: list[Interval], k: int) -> Interval:
        """Return coefficient k > 0 of the gain in φ'²/2 + κ² (Φ + s a ψ); its rate is κ² s a' ψ."""
        return self.kappa * dot(slopes, lever[k - 1 :: -1]) / k

    def quotient(self, zero_order: int) -> tuple[list[Interval], list[Interval]]:
        """Return q of φ = τ^k q, k = `zero_order`, and q'.

        The remainder of q' is n R' − k R of two values of one interval.
        """
        x, n = self.phi, len(self.phi) - 1
        slope = [(j - zero_order) * x[j] for j in range(zero_order + 1, n)] + [
            n * x[n] - zero_order * x[n]
        ]
        return x[zero_order:], slope

    def landing(self, tau: Interval, zero_order: int) -> Interval:
        """Return φ' where φ vanishes: after a bounce q' encloses it more closely."""
        rate = horner(self.quotient(zero_order)[1], tau) / self.h
        for _ in range(zero_order):
            rate = rate * tau
        return rate.common(horner(self.rate, tau))

    def at(self, tau: Interval) -> tuple[Interval, Interval]:
        """Return φ and φ'."""
        return horner(self.phi, tau), horner(self.rate, tau)


def horner(coefficients: Sequence[Interval], tau: Interval) -> Interval:
    """Return the value of a polynomial."""
    low = high = 0
    a, b, places = tau.low, tau.high, intervals.PLACES
    for coefficient in reversed(coefficients):
        low, high = extremes(low, high, a, b)
        low, high = (low >> places) + coefficient.low, coefficient.high - (-high >> places)
    return Interval(low, high)
