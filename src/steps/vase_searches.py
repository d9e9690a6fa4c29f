"""The minimum overturning acceleration of bare column, fixed mass and frame, over their motions."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

from topheavy import (
    Column,
    FixedMassColumn,
    Pulse,
    Record,
    RockingFrame,
    judge,
    minimum_overturning,
    reference,
)
from topheavy.free_rocking import Ending
from topheavy.structures import Structure

WINDOWS = {
    Pulse: ((1.0, 1.3, 0.001), (1.3, 1.5, 0.01), (1.5, 3.0, 0.03), (3.0, 30.0, 0.05)),
    Record: ((1.0, 1.5, 0.01), (1.5, 3.0, 0.03), (3.0, 30.0, 0.05)),
}
"""Ranges searched one after the other, and their resolution, over the uplift acceleration.

Just above uplift a long pulse has narrow intervals that overturn, one below the other.
"""

FINEST = {Pulse: 0.005, Record: 0.02}
"""Resolution below the minimum of the bare column, over the uplift acceleration."""

NUDGE = 1e-6
DISTANCES = (1e-7, 1e-5, 1e-3)
"""From a boundary, over the boundary: where SciPy is asked, from near to far."""


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
    step : float
        g, of the search that found it: a narrower range of lower accelerations may be missed.
    """

    structure: Structure
    motion: Pulse | Record
    bracket: tuple[float, float]
    step: float = math.nan

    @property
    def acceleration(self) -> float:
        """The middle of the bracket, g."""
        return 0.5 * sum(self.bracket)

    def told(self, tightened: float) -> bool:
        """Whether the library at a tightened tolerance finds the boundary at the same place.

        Under a long record an outcome can hang on digits that no measurement resolves.
        """
        return self._straddles(NUDGE, partial(judge, tolerance=tightened))

    @cached_property
    def error(self) -> float:
        """How far the boundary may be off, g: by SciPy, NaN where it finds none within 1e-3."""
        for distance in DISTANCES:
            if self._straddles(distance, reference.judge):
                return distance * self.acceleration + self.bracket[1] - self.bracket[0]
        return math.nan

    def _straddles(self, distance: float, route: Callable[..., Ending]) -> bool:
        """Whether it survives below and overturns above the bracket, at a relative distance."""
        factors = self.bracket[0] * (1.0 - distance), self.bracket[1] * (1.0 + distance)
        below, above = (
            route(self.structure, self.motion.scaled(factor)).overturned for factor in factors
        )
        return above and not below


def minimum(structure: Structure, motion: Pulse | Record, highest: float) -> Minimum:
    """Return the minimum overturning acceleration up to the highest, g."""
    uplift = structure.block().uplift_acceleration
    for low, high, step in WINDOWS[type(motion)]:
        scales = (low * uplift, min(high * uplift, highest))
        if scales[0] >= scales[1]:
            break
        found = minimum_overturning(structure, motion, scales, resolution=step * uplift)
        if found:
            return Minimum(structure, motion, found, step * uplift)
    return Minimum(structure, motion, (math.inf, math.inf))


def refined(found: Minimum, below: float) -> Minimum:
    """Return the minimum, searched again at the finest resolution below an acceleration, g."""
    uplift = found.structure.block().uplift_acceleration
    step = FINEST[type(found.motion)] * uplift
    if not uplift + step < below <= found.bracket[0]:
        return found
    lower = minimum_overturning(found.structure, found.motion, (uplift, below), resolution=step)
    return replace(found, bracket=lower, step=step) if lower else found


def rivals(column: Column, ratios: Sequence[float]) -> Iterator[tuple[str, float, Structure]]:
    """Yield the bare column once, then for each γ > 0 the same mass fixed to it, and set free."""
    yield "bare", 0.0, column
    for gamma in ratios:
        if gamma > 0.0:
            yield "fixed", gamma, FixedMassColumn(column, gamma)
            yield "free", gamma, RockingFrame(column, gamma)
