"""Bounds on a motion whose side, impacts and rests are not followed: the lemma near uplift.

With κ, Φ and ψ of `topheavy.proven.flight`, the energy on the side s = ±1 at φ = |θ|,

    H = φ'²/2 + V,   V(φ, s a) = κ² (Φ(φ) + s a ψ(φ)),   H' = κ² s a' ψ(φ) between impacts,

is φ'²/2 at an impact (φ = 0), which multiplies it by r ≤ 1 as √r ≤ 1, and zero at rest, where
infinitely many impacts in a finite time end too. A bound on H that holds between impacts therefore
needs no impact.

Lemma. At σ let H ≤ E and φ ≤ X_s, 0 ≤ X_s ≤ α, on either side. Over [σ, σ + h] let s a ≥ m_s,
and g_s at least the integral of max(0, s a'). Let 0 ≤ Y_s ≤ α and F ≥ E + κ² max g_s ψ(Y_s), and
on either side

    V(Y_s, m_s) > F, and Y_s ≥ X_s or V(X_s, m_s) > F                  (the wall stops it), or
    Y_s − X_s > h (v(X_s) + v(Y_s))/2,   v(φ)² = 2 max(0, F − V(φ, m_s))   (it does not reach it).

Then H ≤ F and φ ≤ Y_s until σ + h. If V is not concave, the larger v takes the place of the mean.

Proof. Over [0, α], V is concave in φ for s a ≤ 0 and rises for s a ≥ 0: between two φ it is
nowhere less than at both. It rises with s a, as ψ ≥ 0. Hence φ ≤ Y_s at σ: a φ with Y_s < φ ≤ X_s
would have V > F. Let σ₁ be the first time with φ = Y_s. Until then H' ≤ κ² max(0, s a') ψ(Y_s).
If a' has one sign, H grows on one side alone; else g_s = h d is the same for d ≥ |a'|. So H ≤ F,
and V(Y_s, m_s) ≤ V ≤ H ≤ F: a wall of the first kind is not reached. One of the second kind is
passed from X_s to Y_s with φ' ≤ v(φ). As V is concave, v² is at most its chord, and the passage
lasts at least 2 (Y_s − X_s)/(v(X_s) + v(Y_s)) > h. Each flight begins at a φ ≤ X_s, or at 0.  ∎
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from topheavy.proven.balls import Undecided, arb, bounds, hull
from topheavy.proven.flight import Law
from topheavy.proven.forcing import Forcing, Piece

SIDES = (1, -1)
FIRST, GROWTH, LONGEST = 2.0**-6, 1.3, math.pi / 48.0  # steps, in the phase of a pulse
START = 1.1  # on time, energy and wall where it begins: the enclosures of the checker are wider
MARGIN = 1.02  # on energies and times: the enclosures of the checker are wider
_SLACK, _LEAST = 2.0**-16, 2.0**-40  # of a wall, beyond an equality: its share, and at least
_TRIES = 40
_ZERO = arb(0)


@dataclass(frozen=True)
class Bound:
    """H ≤ energy, and φ ≤ walls[0] on the side +1 and walls[1] on the side −1, at a σ."""

    sigma: arb
    energy: float
    walls: tuple[float, float]


@dataclass(frozen=True)
class Bounded:
    """A block under a pulse whose motion is bounded."""

    law: Law
    forcing: Forcing
    piece: Piece
    factor: arb

    def start(self, sigma: arb, side: int, phi: arb, rate: arb) -> Bound:
        """Return the bound of a state: at rest for side 0, else of φ and φ' on that side."""
        sigma = sigma.mid() + START * (sigma - sigma.mid())
        if not side:
            return Bound(sigma, 0.0, (0.0, 0.0))
        push = side * self.factor * self.forcing.value(self.piece, sigma)
        slope, middle = self.law.square * self.law.pull(phi, push), phi.mid()
        energy = self.law.potential(middle, push) + slope * (phi - middle) + rate * rate / 2
        highest = bounds(phi)[1] * START + _LEAST
        walls = (highest, 0.0) if side == 1 else (0.0, highest)
        return Bound(sigma, max(0.0, bounds(energy)[1]) * START + _LEAST, walls)

    def carried(self, bound: Bound) -> Iterator[Bound]:
        """Yield bounds until the pulse ends, or raise Undecided where α is not excluded."""
        stop, h = bounds(self.piece.stop)[1], FIRST
        while not bound.sigma >= stop:
            bound = self.step(bound, arb(min(bounds(bound.sigma)[1] + h, stop)))
            yield bound
            h = min(GROWTH * h, LONGEST)

    def step(self, bound: Bound, until: arb) -> Bound:
        """Return a bound at a later σ, by the lemma."""
        span, h = hull(bound.sigma.lower(), until), (until - bound.sigma).upper()
        ground, rises = self._ground(bound.sigma, until, span, h)
        least = [(s * ground).lower() for s in SIDES]
        energy, alpha = arb(bound.energy), self.law.block.slenderness
        one, other = (_Side(self.law, h, *x, energy) for x in zip(bound.walls, least, strict=True))
        if not all(alpha > x for x in bound.walls):
            raise Undecided("bound")
        slack = _SLACK
        for _ in range(_TRIES):
            one.move(slack)
            other.move(slack)
            if not (alpha > one.wall and alpha > other.wall):
                break
            grown = (rises[0] * one.lever).max(rises[1] * other.lever)
            energy = arb(bounds(bound.energy + self.law.square * grown * MARGIN)[1])
            one.limit(energy)
            other.limit(energy)
            if one.holds() and other.holds():
                return Bound(until, float(energy), (one.wall, other.wall))
            slack = min(1.5 * slack, 0.05)
        raise Undecided("bound")

    def _ground(self, start: arb, until: arb, span: arb, h: arb) -> tuple[arb, list[arb]]:
        """Return a over a step, where it is monotone by its ends, and by how much s a can grow."""
        over, slope = (self.factor * x for x in self.forcing.series(self.piece, span, 2))
        rises = [h * (s * slope).upper().max(arb(0)) for s in SIDES]
        if slope.contains(0):  # here the enclosures of the checker are wider
            growth = h * abs(slope).upper()
            return over + hull(-growth, growth), [growth] * 2
        ends = [self.factor * self.forcing.value(self.piece, x) for x in (start, until)]
        return ends[0].union(ends[1]), rises

    def energy_behind(self, bound: Bound) -> arb:
        """Return a bound on H behind the end of the pulse, where a jumps to zero."""
        jump = -self.factor * self.forcing.value(self.piece, self.piece.stop)
        gains = [
            (s * jump).max(arb(0)) * self.law.lever(arb(wall))
            for s, wall in zip(SIDES, bound.walls, strict=True)
        ]
        return bound.energy + self.law.square * gains[0].max(gains[1])


class _Side:
    """A step on one side: X_s, Y_s, V at both under m_s, F, and whether V is concave."""

    def __init__(self, law: Law, h: arb, before: float, least: arb, energy: arb) -> None:
        self.law, self.h, self.before, self.wall, self.least = law, h, before, before, least
        self.old = self.at = law.potential(arb(before), least)
        self.is_concave = bool(least * law.tangent < 1)
        self.limit(energy)

    def move(self, slack: float) -> None:
        """Move Y_s about to where F takes it, and a share beyond."""
        turn = self.law.turn(float(self.energy), float(self.least))
        reached = min(self.before + float(self.way), turn)
        self.wall = reached * (1.0 + slack) + _LEAST
        self.at, self.lever = self.law.wall(arb(self.wall), self.least)

    def limit(self, energy: arb) -> None:
        """Take F, and how far φ can come from X_s meanwhile."""
        one, other = ((2 * (energy - x)).upper().max(_ZERO).sqrt() for x in (self.old, self.at))
        mean = (one + other) / 2 if self.is_concave else one.max(other)
        self.energy, self.way = energy, self.h * mean

    def holds(self) -> bool:
        """Return whether Y_s satisfies the lemma."""
        if self.at > self.energy and (self.wall >= self.before or self.old > self.energy):
            return True
        return bool(self.wall - arb(self.before) > self.way)
