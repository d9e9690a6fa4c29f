"""The minimum overturning acceleration of bare column, fixed mass and frame, over their motions.

Under a record the factors that overturn form many intervals, the lowest of which are often narrower
than anything that can be measured. Each minimum therefore has the width of its interval. Intervals
that a relative change of `NUDGE` in the motion removes are passed over, and counted.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from steps.shared.histories import NUDGE
from topheavy import (
    Column,
    FixedMassColumn,
    LowestOverturning,
    Pulse,
    Record,
    RockingFrame,
    Search,
    judge,
    overturned_by,
)
from topheavy.bodies.structures import Structure
from topheavy.outcomes.minimum import lowest_together
from topheavy.second import reference

DISTANCES = (1e-7, 1e-5, 1e-3)
"""From a boundary, over the boundary: where SciPy is asked, from near to far."""

AT_A_TIME = 512
"""Factors that are tried in one call where a wide interval is sought."""


@dataclass(frozen=True)
class Minimum:
    """The lowest acceleration found that overturns a structure under a motion.

    Parameters
    ----------
    structure : Structure
    motion : Pulse or Record
        Of unit peak: its factor is its peak acceleration in g.
    found : LowestOverturning or None
        None where nothing was searched, since the structure does not uplift.
    passed_over : int
        Lower intervals whose outcome is too sensitive to decide.
    """

    structure: Structure
    motion: Pulse | Record
    lowest: LowestOverturning | None
    passed_over: int = 0

    @property
    def acceleration(self) -> float:
        """In g; infinite where nothing up to the highest acceleration was found to overturn."""
        return self.lowest.factor if self.lowest and self.lowest.bracket else math.inf

    @property
    def inside(self) -> float:
        """The middle of the interval, or of what the range has of it, g."""
        last = self.lowest.upper[0] if self.lowest.upper else self.lowest.scale_range[1]
        return 0.5 * (self.acceleration + last)

    def is_decided(self, tightened: float) -> bool:
        """Whether it overturns inside, also if nudged by `NUDGE` and at a tightened tolerance."""
        factors = [self.inside * (1.0 + off) for off in (-NUDGE, 0.0, NUDGE)]
        return bool(
            overturned_by(self.structure, self.motion, factors).all()
            and judge(
                self.structure, self.motion.scaled(self.inside), tolerance=tightened
            ).overturned
        )

    @cached_property
    def error(self) -> float:
        """How far the boundary may be off, g: by SciPy, NaN where it finds none within 1e-3."""
        low, high = self.lowest.bracket
        for distance in DISTANCES:
            above = min(high * (1.0 + distance), self.inside)
            if self._overturns(above) and not self._overturns(low * (1.0 - distance)):
                return distance * self.acceleration + high - low
        return math.nan

    def _overturns(self, factor: float) -> bool:
        return reference.judge(self.structure, self.motion.scaled(factor)).overturned


def minimum(
    structure: Structure,
    motion: Pulse | Record,
    highest: float,
    floor: float,
    above: float = 0.0,
) -> Minimum:
    """Return the minimum overturning acceleration between two, g; none is sought below uplift.

    The floor of `lowest_overturning` is given over the uplift acceleration of the structure.
    """
    return minima([structure], motion, highest, floor, above)[0]


def minima(
    structures: Sequence[Structure],
    motion: Pulse | Record,
    highest: float,
    floor: float,
    above: float = 0.0,
) -> list[Minimum]:
    """Return the `minimum` of each structure; they are searched together."""
    levels = [structure.block().uplift_acceleration for structure in structures]
    found = [Minimum(structure, motion, None) for structure in structures]
    sought = [place for place, level in enumerate(levels) if max(level, above) < highest]
    searches = [
        Search(structures[place], motion, (max(levels[place], above), highest)) for place in sought
    ]
    if not searches:
        return found
    lowest = lowest_together(searches, [floor * levels[place] for place in sought])
    for place, one in zip(sought, lowest, strict=True):
        found[place] = replace(found[place], lowest=one)
    return found


def lowest_decided(one: Minimum, highest: float, floor: float, tightened: float) -> Minimum:
    """Return the lowest minimum that can be decided, from the lowest one on.

    The intervals below it are passed over.
    """
    passed = 0
    while math.isfinite(one.acceleration) and one.lowest.upper and not one.is_decided(tightened):
        passed += 1
        one = minimum(one.structure, one.motion, highest, floor, one.lowest.upper[1])
    return replace(one, passed_over=passed)


def lowest_wide(
    one: Minimum, highest: float, floor: float, widths: Sequence[float]
) -> dict[float, float]:
    """Return for each width the lowest acceleration from which on all overturn so far, in g.

    They are tried from the minimum on in steps of the floor. Floor and widths are over the uplift
    acceleration; the result is infinite where there is no such interval.
    """
    step = floor * one.structure.block().uplift_acceleration
    found, run, begin = dict.fromkeys(widths, math.inf), 0, one.acceleration
    while begin <= highest and math.inf in found.values():
        factors = begin + step * np.arange(AT_A_TIME)
        factors = factors[factors <= highest]
        for factor, fell in zip(
            factors, overturned_by(one.structure, one.motion, factors), strict=True
        ):
            run = run + 1 if fell else 0
            for width in widths:
                if run > round(width / floor) and found[width] == math.inf:
                    found[width] = factor - (run - 1) * step
        begin += step * AT_A_TIME
    return found


def rivals(column: Column, ratios: Sequence[float]) -> Iterator[tuple[str, float, Structure]]:
    """Yield the bare column once, then for each γ > 0 the same mass fixed to it, and set free."""
    yield "bare", 0.0, column
    for gamma in ratios:
        if gamma > 0.0:
            yield "fixed", gamma, FixedMassColumn(column, gamma)
            yield "free", gamma, RockingFrame(column, gamma)
