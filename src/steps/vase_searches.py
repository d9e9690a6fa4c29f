"""The minimum overturning acceleration of bare column, fixed mass and frame, over their motions."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from topheavy import (
    Column,
    FixedMassColumn,
    Pulse,
    Record,
    RockingFrame,
    judge,
    overturning_intervals,
    reference,
)
from topheavy.structures import Structure

WINDOWS = ((1.0, 1.5, 0.01), (1.5, 3.0, 0.03), (3.0, 30.0, 0.05))
"""Ranges that are searched one after the other, and their resolution; over the uplift acceleration."""

DISTANCES = (1e-7, 1e-5, 1e-3)
"""From the boundary, over the boundary: where SciPy is asked, from near to far."""


@dataclass(frozen=True)
class Minimum:
    """The lowest acceleration that overturns a structure, and the structure and motion it is of.

    Parameters
    ----------
    structure : Structure
    motion : Pulse or Record
        Of unit peak: its factor is its peak acceleration in g.
    bracket : (float, float)
        g. Both are infinite when nothing up to the highest acceleration overturns.
    """

    structure: Structure
    motion: Pulse | Record
    bracket: tuple[float, float]

    @property
    def acceleration(self) -> float:
        """The middle of the bracket, g."""
        return 0.5 * sum(self.bracket)

    def straddles(self, distance: float, tightened: float | None = None) -> bool:
        """Whether the structure survives below and overturns above, at a relative distance.

        SciPy judges, or the library at a tightened tolerance.
        """
        below, above = self.bracket[0] * (1.0 - distance), self.bracket[1] * (1.0 + distance)
        fell = [
            reference.judge(self.structure, self.motion.scaled(factor)).overturned
            if tightened is None
            else judge(self.structure, self.motion.scaled(factor), tolerance=tightened).overturned
            for factor in (below, above)
        ]
        return fell == [False, True]

    def error(self, tightened: float | None = None) -> float:
        """Return the least of the distances that straddles the boundary, g; NaN where none does."""
        for distance in DISTANCES:
            if self.straddles(distance, tightened):
                return distance * self.acceleration
        return math.nan


def minimum(structure: Structure, motion: Pulse | Record, highest: float) -> Minimum:
    """Return the minimum overturning acceleration up to the highest, g."""
    uplift = structure.block().uplift_acceleration
    for low, high, step in WINDOWS:
        scales = (low * uplift, min(high * uplift, highest))
        if scales[0] >= scales[1]:
            break
        if found := overturning_intervals(structure, motion, scales, resolution=step * uplift):
            return Minimum(structure, motion, found[0].lower)
    return Minimum(structure, motion, (math.inf, math.inf))


def rivals(column: Column, ratios: Sequence[float]) -> Iterator[tuple[str, float, Structure]]:
    """Yield the bare column once, then for each γ > 0 the same mass fixed to it, and set free."""
    yield "bare", 0.0, column
    for gamma in ratios:
        if gamma > 0.0:
            yield "fixed", gamma, FixedMassColumn(column, gamma)
            yield "free", gamma, RockingFrame(column, gamma)
