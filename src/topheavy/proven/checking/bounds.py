"""A bound on a motion proven again: walls that the certificate names, by the lemma near uplift.

The energy on the side s is H = φ'²/2 + V, V = κ² (Φ + s a ψ). Impacts lower it, and between them it
grows by κ² s a' ψ. Each statement of the lemma is tested in intervals; no wall is computed here.
"""

from fractions import Fraction
from typing import Any

from .intervals import Interval, Refused, of
from .model import Block, Ground

SIDES = (1, -1)


class Bound:
    """H ≤ energy, φ ≤ walls by side, from σ on; a wall is less than α."""

    def __init__(self, block: Block, ground: Ground, sigma: Interval) -> None:
        self.block, self.ground, self.sigma = block, ground, sigma
        self.energy = of(0)
        self.walls = {1: of(0), -1: of(0)}

    def potential(self, side: int, phi: Interval, ground: Interval) -> Interval:
        return self.ground.clock * self.block.potential(phi, side * ground)

    def begin(self, event: dict[str, Any], side: int, phi: Interval, rate: Interval) -> None:
        """Take the energy and walls of the certificate if they hold the state."""
        energy, walls = of(Fraction(event["energy"])), event["walls"]
        self.walls = {s: of(Fraction(wall)) for s, wall in zip(SIDES, walls, strict=True)}
        if any(wall < 0 for wall in self.walls.values()) or energy < 0:
            raise Refused("energy and walls are not negative")
        if side:
            ground = self.ground.at(0, self.sigma)
            middle = Interval((phi.low + phi.high) // 2, (phi.low + phi.high) // 2)
            slope = self.ground.clock * self.block.pull(phi, side * ground)
            mine = self.potential(side, middle, ground) + slope * (phi - middle) + rate * rate / 2
            if not (mine < energy and phi < self.walls[side]):
                raise Refused("the state is outside the energy or the wall")
        self.energy = energy

    def step(self, until: Interval, claimed: Interval, walls: dict[int, Interval]) -> None:
        """Prove the lemma for a step, and take its energy and walls."""
        if not until > self.sigma:
            raise Refused("a step goes back")
        if any(wall.low < 0 for wall in walls.values()):
            raise Refused("a wall is below zero")
        lasts = until - self.sigma
        h = Interval(lasts.high, lasts.high)
        ground, rises = self._ground(until, h)
        gains = [(rises[side] * self.block.lever(walls[side])).high for side in SIDES]
        if not self.energy + self.ground.clock * Interval(0, max(*gains, 0)) < claimed:
            raise Refused("the energy may grow more")
        self.energy = Interval(claimed.high, claimed.high)
        for side in SIDES:
            push = side * ground
            self._wall_holds(h, self.walls[side], walls[side], Interval(push.low, push.low))
        self.sigma, self.walls = until, walls

    def _ground(self, until: Interval, h: Interval) -> tuple[Interval, dict[int, Interval]]:
        """Return a over a step, and the most that s a gains in it."""
        over, rate = self.ground.series(0, self.sigma.hull(until), of(1), 2)
        if rate.low <= 0 <= rate.high:
            return over, dict.fromkeys(SIDES, h * rate.size())
        first, last = self.ground.at(0, self.sigma), self.ground.at(0, until)
        return first.hull(last), {side: side * (h * rate) for side in SIDES}

    def _wall_holds(self, h: Interval, before: Interval, wall: Interval, push: Interval) -> None:
        if not (wall < self.block.alpha and before < self.block.alpha):
            raise Refused("a wall is not below α")
        at, old = (self.ground.clock * self.block.potential(x, push) for x in (wall, before))
        if at > self.energy and (wall.low >= before.high or old > self.energy):
            return
        rates = [_positive(2 * (self.energy - x)).root() for x in (old, at)]
        mean = (rates[0] + rates[1]) / 2
        if not push * self.block.level < 1:
            mean = rates[0] if rates[0].high > rates[1].high else rates[1]
        if not wall - before > h * mean:
            raise Refused("a wall may be passed")

    def survives(self) -> bool:
        """Return whether the energy is below the barrier when a has jumped to zero."""
        jump = -self.ground.at(0, self.ground.stops[0])
        gains = [(s * jump * self.block.lever(self.walls[s])).high for s in SIDES]
        energy = self.energy + self.ground.clock * Interval(0, max(*gains, 0))
        return energy < self.ground.clock * self.block.potential(self.block.alpha, of(0))


def _positive(x: Interval) -> Interval:
    return Interval(max(x.low, 0), max(x.high, 0))


def named(
    until: list[str], energy: str, walls: list[str]
) -> tuple[Interval, Interval, dict[int, Interval]]:
    """Return σ, energy and walls of a step of a certificate."""
    sigma = of(Fraction(until[1]))
    sides = {side: of(Fraction(wall)) for side, wall in zip(SIDES, walls, strict=True)}
    return Interval(sigma.high, sigma.high), of(Fraction(energy)), sides
