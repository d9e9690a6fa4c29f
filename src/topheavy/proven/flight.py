"""One Taylor step of a flight in balls: an a-priori box, the series, its remainder, first impact.

With φ = |θ|, the side s = sgn θ and κ = p dt/dσ the motion obeys, until φ is zero again,

    φ'' = −κ² { sin(α − φ) + s a cos(α − φ) },    φ'' = κ² { φ − α − s a }  (linearised)
"""

import math
from dataclasses import dataclass, field
from functools import cached_property
from operator import mul

from topheavy.proven.balls import Undecided, arb, arb_poly, hull, power, precision, root
from topheavy.proven.blocks import Balls

COARSE = 64
"""Bits for the coefficients over a box, which is wider than their rounding."""

_MOST_BOXES = 12
_NARROWEST = 2.0**-30
"""Of a step: a part so narrow in which neither sign nor slope is decided is a graze."""


@dataclass(frozen=True)
class Law:
    """The right-hand side: a block, and κ² of the motion's clock."""

    block: Balls
    square: arb
    sine: arb = field(init=False)
    cosine: arb = field(init=False)
    tangent: arb = field(init=False)
    _floats: tuple[float, float, float, float] = field(init=False)

    def __post_init__(self) -> None:
        for name, value in zip(("sine", "cosine"), self.block.slenderness.sin_cos(), strict=True):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "tangent", self.block.slenderness.tan())
        alpha, square = float(self.block.slenderness), float(self.square)
        object.__setattr__(self, "_floats", (alpha, square, math.sin(alpha), math.cos(alpha)))

    def pull(self, phi: arb, push: arb) -> arb:
        """Return −φ''/κ² at φ under s·a."""
        alpha = self.block.slenderness
        if self.block.linearised:
            return alpha - phi + push
        sine, cosine = (alpha - phi).sin_cos()
        return sine + push * cosine

    def potential(self, phi: arb, push: arb) -> arb:
        """Return κ² (Φ + s a ψ), of which −φ'' is the derivative by φ."""
        return self.wall(phi, push)[0]

    def wall(self, phi: arb, push: arb) -> tuple[arb, arb]:
        """Return κ² (Φ + s a ψ), and ψ."""
        alpha = self.block.slenderness
        if self.block.linearised:
            return self.square * phi * (alpha - phi / 2 + push), phi
        sine, cosine = (alpha - phi).sin_cos()
        lever = self.sine - sine
        return self.square * (cosine - self.cosine + push * lever), lever

    def lever(self, phi: arb) -> arb:
        """Return ψ."""
        if self.block.linearised:
            return phi
        return self.sine - (self.block.slenderness - phi).sin()

    def turn(self, energy: float, push: float) -> float:
        """Return about the first φ at which the potential reaches an energy; infinity if none."""
        alpha, square, sine, cosine = self._floats
        level = energy / square
        if self.block.linearised:
            depth = alpha + push
            inside = depth * depth - 2.0 * level
            return depth - math.sqrt(inside) if inside > 0.0 < depth else math.inf
        depth = alpha + math.atan(push)
        top = (level + cosine - push * sine) / math.hypot(1.0, push)
        return depth - math.acos(top) if -1.0 < top < 1.0 and depth > 0.0 else math.inf

    def series(
        self, phi: arb, rate: arb, push: list[arb], terms: int
    ) -> tuple[list[arb], list[arb]]:
        """Return the Taylor coefficients 0 to `terms` of φ from those of s·a, and those of ψ.

        ψ = sin α − sin(α − φ), φ linearised, has `terms` − 1 coefficients.
        """
        found, alpha, square = [phi, rate], self.block.slenderness, self.square
        if self.block.linearised:
            found.append(square * (phi - alpha - push[0]) / 2)
            for k in range(1, terms - 1):
                found.append(square * (found[k] - push[k]) / ((k + 1) * (k + 2)))
            return found, found[: terms - 1]
        push = _trimmed(push)
        # With S, C = sin, cos (α − φ):  S' = −C φ',  C' = S φ'
        one, other = (alpha - phi).sin_cos()
        sines, cosines, rates, back = [one], [other], [rate], -square
        for k in range(terms - 1):
            pushed = sum(map(mul, push, reversed(cosines)))
            found.append(back * (sines[k] + pushed) / ((k + 1) * (k + 2)))
            if k < terms - 2:
                sine = sum(map(mul, rates, reversed(cosines)))
                cosine = sum(map(mul, rates, reversed(sines)))
                sines.append(-sine / (k + 1))
                cosines.append(cosine / (k + 1))
                rates.append((k + 2) * found[k + 2])
        return found, [alpha.sin() - sines[0], *(-x for x in sines[1:])]

    def power(self, push: list[arb], psi: list[arb], which: range) -> list[arb]:
        """Return coefficients of κ² s a' ψ, the rate of the energy φ'²/2 + κ² (Φ + s a ψ)."""
        slopes = [(j + 1) * x for j, x in enumerate(_trimmed(push)[1:])]
        return [self.square * sum(map(mul, slopes, psi[k::-1]), arb(0)) for k in which]


def _trimmed(series: list[arb]) -> list[arb]:
    """Return a series without the exact zeros at its end: of a straight line two terms are left."""
    length = len(series)
    while length > 1 and series[length - 1] == 0:
        length -= 1
    return series[:length]


@dataclass(frozen=True)
class Box:
    """A box that contains φ, φ' and φ'' over a step."""

    phi: arb
    rate: arb
    acceleration: arb


def a_priori(law: Law, phi: arb, rate: arb, push: arb, h: float) -> Box:
    """Return a box of the motion over [0, h], verified by Picard's map.

    φ'' does not depend on φ'. A box that contains φ + [0, h] φ' + [0, h²/2] φ''(box) therefore
    contains the solution, and that image does too.
    """
    time, half_square = hull(0, h), hull(0, arb(h) * h / 2)
    start = -law.square * law.pull(phi, push)
    box = phi.union(phi + arb(h) * rate).union(phi + time * rate + half_square * start)
    for _ in range(_MOST_BOXES):
        acceleration = -law.square * law.pull(box, push)
        image = phi + time * rate + half_square * acceleration
        if image.is_finite() and box.contains(image):
            return Box(image, rate + time * acceleration, acceleration)
        box = box.union(image)
        box += (box - box.mid()) / 8 + arb(0, 1e-30)
    raise Undecided("enclosure")


@dataclass(frozen=True)
class Step:
    """φ over [0, h] as a polynomial in balls: the last coefficient is the remainder."""

    h: float
    coefficients: list[arb]
    power: list[arb]
    """Of the energy's rate, likewise with a remainder."""
    box: Box
    zeros: int
    """φ/t^zeros does not vanish at t = 0: 1 behind an impact, 2 or 3 from rest."""

    @cached_property
    def polynomial(self) -> arb_poly:
        """φ."""
        return arb_poly(self.coefficients)

    @cached_property
    def rates(self) -> arb_poly:
        """φ'."""
        return arb_poly([j * x for j, x in enumerate(self.coefficients)][1:])

    @cached_property
    def gain(self) -> arb_poly:
        """What the energy has gained."""
        return arb_poly([arb(0), *(x / (j + 1) for j, x in enumerate(self.power))])

    @cached_property
    def quotient(self) -> arb_poly:
        """φ/t^k, k = `zeros`."""
        return arb_poly(self.coefficients[self.zeros :])

    @cached_property
    def slope(self) -> arb_poly:
        """(φ/t^k)'.

        The remainder ρ of φ is R t^N and its derivative is N R' t^(N−1), with R and R' in one ball
        but not equal: that of ρ/t^k is (N R' − k R) t^(N−k−1), and not (N − k) R t^(N−k−1).
        """
        c, k = self.coefficients, self.zeros
        last = len(c) - 1
        slopes = [(j - k) * c[j] for j in range(k + 1, last)] + [last * c[last] - k * c[last]]
        return arb_poly(slopes)

    def at(self, time: arb) -> tuple[arb, arb]:
        """Return φ and φ' at a time of the step."""
        return self.polynomial(time), self.rates(time)

    def impact(self) -> arb | None:
        """Return the first time in (0, h] at which φ vanishes, or None if it stays positive.

        Raises
        ------
        Undecided
            If the enclosures allow both: at the start, a graze, or an impact just at the end.
        """
        if self.zeros == 0 and self.box.phi > 0:
            return None
        if not self.coefficients[self.zeros] > 0:
            raise Undecided("start")
        parts = [(0.0, self.h)]
        while parts:
            low, high = parts.pop()
            whole, middle = hull(low, high), 0.5 * (low + high)
            if self.quotient(whole) > 0:
                continue
            slope = self.slope(whole)
            if self.quotient(arb(middle)) + slope * (whole - middle) > 0:
                continue
            if slope > 0:
                continue  # it is positive where the part begins
            if slope < 0:
                end = self.quotient(arb(high))
                if end > 0:
                    continue
                if end < 0:
                    return root(self.quotient, self.slope, arb(low), arb(high))
                if high == self.h:
                    raise Undecided("end")
            if high - low < _NARROWEST * self.h:
                raise Undecided("graze")
            parts += [(middle, high), (low, middle)]
        return None

    def landing(self, time: arb) -> arb:
        """Return φ' at an impact: t^k (φ/t^k)' there, whose ball is as narrow as that of time."""
        return power(time, self.zeros) * self.slope(time)


Series = tuple[list[arb], list[arb]]


def step(
    law: Law, start: Series, pushes: tuple[list[arb], list[arb]], h: float, zeros: int
) -> Step:
    """Return a step of length h.

    Parameters
    ----------
    start : two lists of arb
        `Law.series` where it starts: N + 1 coefficients of φ and N − 1 of ψ.
    pushes : two lists of arb
        N coefficients of s·a where it starts, and of s·a over all of the step.
    zeros : int
        How many of the first coefficients are known to vanish.
    """
    (phi, psi), (at_start, over) = start, pushes
    order = len(phi) - 1
    box = a_priori(law, phi[0], phi[1], over[0], h)
    with precision(COARSE):
        ends = law.series(box.phi, box.rate, over, order)
    coefficients = [*[arb(0)] * zeros, *phi[zeros:order], ends[0][order]]
    last = len(psi) - 1
    power = law.power(at_start, psi, range(last)) + law.power(over, ends[1], range(last, last + 1))
    return Step(h, coefficients, power, box, zeros)
