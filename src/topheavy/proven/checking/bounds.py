"""Bounds on a motion whose side, impacts and rests are not followed: the lemma near uplift.

With κ, Φ and ψ of `Block` and `Ground`, the energy on the side s = ±1 at φ = |θ|,

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

from dataclasses import dataclass
from fractions import Fraction

from .intervals import Interval, NotProven, enclose, point
from .model import Block, Ground

SIDES = (1, -1)


@dataclass(frozen=True)
class Bound:
    """At σ, H ≤ energy and φ ≤ walls[0] on the side +1, φ ≤ walls[1] on the side −1."""

    block: Block
    ground: Ground
    sigma: Interval
    energy: Interval
    walls: tuple[Interval, Interval]

    @classmethod
    def of_state(
        cls, block: Block, ground: Ground, sigma: Interval, side: int, state: tuple[Interval, ...]
    ) -> "Bound":
        """Return the bound of a state (φ, φ') on a side, or at rest for side 0."""
        if not side:
            return cls(block, ground, sigma, enclose(0), (enclose(0), enclose(0)))
        phi, rate = state
        push, middle = side * ground.at(sigma), point(phi.middle)
        energy = ground.kappa_squared * block.potential(middle, push) + rate * rate / 2
        energy = energy + ground.kappa_squared * block.pull(phi, push) * (phi - middle)
        wall, none = point(max(phi.high, 0)), enclose(0)
        walls = (wall, none) if side == 1 else (none, wall)
        return cls(block, ground, sigma, point(max(energy.high, 0)), walls)

    def pushes(self, until: Interval) -> tuple[Interval, list[Interval], list[Interval]]:
        """Return h and, by side, least and largest s a and the most that it gains until then."""
        lasts = until - self.sigma
        h = point(lasts.high)
        over, rate = self.ground.series(self.sigma.hull(until), enclose(1), 2)
        if rate.low <= 0 <= rate.high:
            return h, [side * over for side in SIDES], [h * rate.size()] * 2
        ends = self.ground.at(self.sigma).hull(self.ground.at(until))
        return h, [side * ends for side in SIDES], [side * (h * rate) for side in SIDES]

    def stepped(self, until: Interval, walls: tuple[Interval, Interval]) -> "Bound":
        """Return the bound at a later σ, or raise `NotProven` unless the lemma proves its walls."""
        if not until > self.sigma:
            raise NotProven("a step goes back")
        h, grounds, rises = self.pushes(until)
        if any(wall.low < 0 for wall in walls):
            raise NotProven("a wall is below zero")
        energy = self._raised(rises, walls)
        for before, wall, ground in zip(self.walls, walls, grounds, strict=True):
            self._holds(h, energy, before, wall, point(ground.low))
        return Bound(self.block, self.ground, until, energy, walls)

    def _raised(self, rises: list[Interval], walls: tuple[Interval, Interval]) -> Interval:
        """Return the energy after s a has risen so much on one side."""
        gains = [(x * self.block.lever(y)).high for x, y in zip(rises, walls, strict=True)]
        return point((self.energy + self.ground.kappa_squared * point(max(*gains, 0))).high)

    def _holds(
        self, h: Interval, energy: Interval, before: Interval, wall: Interval, push: Interval
    ) -> None:
        if not (wall < self.block.alpha and before < self.block.alpha):
            raise NotProven("a wall is not below α")
        old, new = (
            self.ground.kappa_squared * self.block.potential(x, push) for x in (before, wall)
        )
        if new > energy and (wall.low >= before.high or old > energy):
            return
        rates = [_positive(2 * (energy - x)).root() for x in (old, new)]
        mean = (rates[0] + rates[1]) / 2
        if not push * self.block.uplift_level < 1:
            mean = rates[0] if rates[0].high > rates[1].high else rates[1]
        if not wall - before > h * mean:
            raise NotProven("a wall may be passed")

    def survives(self) -> bool:
        """Return whether the pulse is over, and the energy below the barrier when a has jumped."""
        if not self.sigma.low >= self.ground.stop.high:
            raise NotProven("the bound ends before the pulse")
        jump = -self.ground.at(self.ground.stop)
        barrier = self.ground.kappa_squared * self.block.potential(self.block.alpha, enclose(0))
        return self._raised([side * jump for side in SIDES], self.walls) < barrier


def _positive(x: Interval) -> Interval:
    return Interval(max(x.low, 0), max(x.high, 0))


def rounded_up(text: str) -> Interval:
    """Return a wall or a phase of a certificate as a number that is not less."""
    return point(enclose(Fraction(text)).high)
