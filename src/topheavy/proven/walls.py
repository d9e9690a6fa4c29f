"""Walls for a step of the lemma of `checking.bounds`, in floats with a margin."""

from __future__ import annotations

import math
from collections.abc import Iterator

from topheavy.proven.checking.bounds import Bound, rounded_up
from topheavy.proven.floats import Floats, ends

ENERGY_MARGIN = 1.02
"""Factor on the gain of energy: the enclosures of the checker are wider."""

LEMMA_MARGIN = 1.0 + 1e-9
"""Factor on the inequalities of the lemma, for the same reason."""

FIRST_SLACK, MAX_SLACK = 2.0**-16, 0.05
"""Relative distance of a wall from the rotation that the block reaches: first and largest one."""

MIN_SLACK = 2.0**-40
"""Least distance, rad."""

MAX_TRIES = 40


def proposed(floats: Floats, bound: Bound, sigma: float) -> Iterator[tuple[float, float]]:
    """Yield pairs of walls up to a phase, each looser than the last, while they are below α."""
    h, grounds, rises = bound.pushes(rounded_up(repr(sigma)))
    sides = [
        _Side(floats, ends(h)[1], ends(before)[1], ends(ground)[0])
        for before, ground in zip(bound.walls, grounds, strict=True)
    ]
    gains = [max(0.0, ends(rise)[1]) for rise in rises]
    first = energy = ends(bound.energy)[1]
    slack = FIRST_SLACK
    for _ in range(MAX_TRIES):
        for side in sides:
            side.move(energy, slack)
        if any(side.wall >= floats.alpha for side in sides):
            return
        gain = max(rise * floats.lever(side.wall) for rise, side in zip(gains, sides, strict=True))
        energy = first + floats.kappa_squared * ENERGY_MARGIN * gain
        if all(side.holds(energy) for side in sides):
            yield sides[0].wall, sides[1].wall
        slack = min(1.5 * slack, MAX_SLACK)


class _Side:
    """X_s, Y_s and m_s of a step of length h."""

    def __init__(self, floats: Floats, h: float, before: float, least: float) -> None:
        self.floats, self.h, self.before, self.least = floats, h, before, least
        self.wall = before

    def move(self, energy: float, slack: float) -> None:
        """Move the wall a share beyond the rotation that the block reaches with an energy."""
        reached = min(self.before + self._way(energy), self.floats.turn(energy, self.least))
        self.wall = reached * (1.0 + slack) + MIN_SLACK

    def holds(self, energy: float) -> bool:
        """Return whether the lemma holds with a margin."""
        old, new = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        bound = LEMMA_MARGIN * energy
        if new > bound and (self.wall >= self.before or old > bound):
            return True
        return self.wall - self.before > LEMMA_MARGIN * self._way(energy)

    def _way(self, energy: float) -> float:
        potentials = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        rates = [math.sqrt(max(0.0, 2.0 * (energy - x))) for x in potentials]
        is_concave = self.least * self.floats.uplift_level < 1.0
        return self.h * (sum(rates) / 2.0 if is_concave else max(rates))
