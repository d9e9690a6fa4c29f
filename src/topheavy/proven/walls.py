"""Walls for a step of the lemma of `checking.bounds`, in floats with a margin."""

from __future__ import annotations

import math
from collections.abc import Iterator

from topheavy.proven.checking.bounds import Bound, rounded_up
from topheavy.proven.floats import Floats, ends

MARGIN = 1.02
"""On what the energy gains: the enclosures of the checker are wider."""

SPARE = 1.0 + 1e-9
"""On the inequalities of the lemma, likewise."""

SLACK, MOST_SLACK = 2.0**-16, 0.05
"""Of a wall, beyond an equality: its share in the first try, and at most."""

LEAST = 2.0**-40
"""Likewise, at least."""

MOST_TRIES = 40


def proposed(floats: Floats, bound: Bound, sigma: float) -> Iterator[tuple[float, float]]:
    """Yield pairs of walls up to a phase, looser and looser; none from where α is not excluded."""
    h, grounds, rises = bound.pushes(rounded_up(repr(sigma)))
    sides = [
        _Side(floats, ends(h)[1], ends(before)[1], ends(ground)[0])
        for before, ground in zip(bound.walls, grounds, strict=True)
    ]
    gains = [max(0.0, ends(rise)[1]) for rise in rises]
    first = energy = ends(bound.energy)[1]
    slack = SLACK
    for _ in range(MOST_TRIES):
        for side in sides:
            side.move(energy, slack)
        if any(side.wall >= floats.alpha for side in sides):
            return
        gain = max(rise * floats.lever(side.wall) for rise, side in zip(gains, sides, strict=True))
        energy = first + floats.square * MARGIN * gain
        if all(side.holds(energy) for side in sides):
            yield sides[0].wall, sides[1].wall
        slack = min(1.5 * slack, MOST_SLACK)


class _Side:
    """X_s, Y_s and m_s of a step of length h."""

    def __init__(self, floats: Floats, h: float, before: float, least: float) -> None:
        self.floats, self.h, self.before, self.least = floats, h, before, least
        self.wall = before

    def move(self, energy: float, slack: float) -> None:
        """Move the wall about to where an energy takes the block, and a share beyond."""
        reached = min(self.before + self._way(energy), self.floats.turn(energy, self.least))
        self.wall = reached * (1.0 + slack) + LEAST

    def holds(self, energy: float) -> bool:
        """Return whether the lemma holds, with some spare."""
        old, new = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        if new > SPARE * energy and (self.wall >= self.before or old > SPARE * energy):
            return True
        return self.wall - self.before > SPARE * self._way(energy)

    def _way(self, energy: float) -> float:
        potentials = (self.floats.potential(x, self.least) for x in (self.before, self.wall))
        rates = [math.sqrt(max(0.0, 2.0 * (energy - x))) for x in potentials]
        is_concave = self.least * self.floats.level < 1.0
        return self.h * (sum(rates) / 2.0 if is_concave else max(rates))
