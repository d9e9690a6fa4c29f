"""Falls: a heavier structure overturns at a lower amplitude of a motion than a lighter one.

Survival is not monotone in the amplitude, and the lowest interval that overturns can be narrower
than any search resolves. So a fall is counted strictly: the heavier structure overturns on a
`wide` interval of amplitudes, and the lighter one on none below it, of any width that a grid of
`GRID` shows. Amplitudes are factors on a motion whose amplitude is g tan α, from 1, uplift, on.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from steps.shared.lobes import Lobe, drawn, record_of
from topheavy import FactorInterval, Pulse, Record, RockingBlock, overturned_by
from topheavy.outcomes.search import intervals_of_many

GRID = 1.0 / 2000.0
"""Step of the amplitudes in the last search for a narrow interval, g tan α."""

STEP = 0.05
"""Time between the samples of lobes, over 1/p of the lighter structure."""

Motions = Sequence[Pulse | Record]


class Lowest(NamedTuple):
    """The lowest interval of amplitudes that overturns, and the lowest wide one.

    Infinite where the search finds none; `searched` is the step of its grid below the wide one.
    """

    lower: float
    upper: float
    wide_lower: float
    wide_upper: float
    searched: float


class Fall(NamedTuple):
    """By which share the lowest amplitude of the heavier structure is below that of the lighter.

    Negative if it is above, NaN if neither overturns. `strict` is that of the module. By the other
    two, intervals of any width, or only wide ones, count for both: they depend on the resolution.
    """

    strict: float
    by_any_width: float
    by_wide: float


class Comparison(NamedTuple):
    """The lowest intervals of two structures under a motion, and the fall between them."""

    lighter: Lowest
    heavier: Lowest
    fall: Fall


def lowest_of(
    blocks: Sequence[RockingBlock], motions: Motions, highest: float, wide: float
) -> list[Lowest]:
    """Return the lowest intervals of each block under its motion; no wide interval is missed."""
    every = intervals_of_many(blocks, motions, (1.0, highest), resolution=wide, most_impacts=0)
    return [_lowest(intervals, wide, wide) for intervals in every]


def _lowest(intervals: Sequence[FactorInterval], wide: float, searched: float) -> Lowest:
    ends = [(part.lower[1], part.upper[0] if part.upper else math.inf) for part in intervals]
    none = (math.inf, math.inf)
    first_wide = next((pair for pair in ends if pair[1] - pair[0] >= wide), none)
    return Lowest(*(ends[0] if ends else none), *first_wide, searched)


def confirmed(
    block: RockingBlock, motion: Pulse | Record, lowest: Lowest, highest: float, wide: float
) -> Lowest:
    """Return the lowest intervals if `GRID` confirms the wide one; else those of a search by it.

    On a coarse grid a comb of narrow intervals can look like a wide one.
    """
    if lowest.wide_lower == math.inf:
        return lowest
    factors = np.arange(lowest.wide_lower + GRID, min(lowest.wide_upper, highest), GRID)
    if overturned_by(block, motion, factors).all():
        return lowest
    (intervals,) = intervals_of_many(
        [block], [motion], (1.0, highest), resolution=GRID, most_impacts=0
    )
    return _lowest(intervals, wide, GRID)


def searched_finely(
    block: RockingBlock, motion: Pulse | Record, lowest: Lowest, highest: float, wide: float
) -> Lowest:
    """Return the lowest intervals after a search by `GRID`, below them and in the wide one."""
    lowest = confirmed(block, motion, lowest, highest, wide)
    last = min(lowest.lower, highest)
    if lowest.searched == GRID or last <= 1.0 + GRID:
        return lowest._replace(searched=GRID)
    (intervals,) = intervals_of_many(
        [block], [motion], (1.0, last), resolution=GRID, most_impacts=0
    )
    ends = [
        (part.lower[1], part.upper[0]) for part in intervals if part.upper and part.upper[1] < last
    ]
    lower, upper = [*ends, (lowest.lower, lowest.upper)][0]
    return lowest._replace(lower=lower, upper=upper, searched=GRID)


def fall(lighter: Lowest, heavier: Lowest) -> Fall:
    """Return the fall from a lighter structure to a heavier one by the three counts."""

    def below(high: float, low: float) -> float:
        return math.nan if low == high == math.inf else 1.0 - low / high

    return Fall(
        below(lighter.lower, heavier.wide_lower),
        below(lighter.lower, heavier.lower),
        below(lighter.wide_lower, heavier.wide_lower),
    )


def compared(
    lighter: RockingBlock,
    heavier: RockingBlock,
    motion: Pulse | Record,
    highest: float,
    wide: float,
) -> Comparison:
    """Return the lowest intervals of a lighter and a heavier block under a motion, and the fall.

    The fine search runs only where a coarse one leaves a fall: most motions cost the coarse one.
    """
    light, heavy = lowest_of([lighter, heavier], [motion, motion], highest, wide)
    if fall(light, heavy).strict > 0.0:
        heavy = confirmed(heavier, motion, heavy, highest, wide)
    if fall(light, heavy).strict > 0.0:
        light = searched_finely(lighter, motion, light, highest, wide)
    return Comparison(light, heavy, fall(light, heavy))


def strict_falls(
    lobes: Sequence[Lobe],
    lighter: RockingBlock,
    heavier: RockingBlock,
    highest: float,
    wide: float,
    draws: int,
    change: float,
    seed: int,
) -> Iterator[float]:
    """Yield the strict fall of each draw of a motion of lobes.

    In each draw each length, amplitude and pause changes by a share (standard deviation).
    """
    random = np.random.default_rng(seed)
    step = STEP / lighter.frequency_parameter
    for _ in range(draws):
        motion = record_of(drawn(lobes, change, random), step)
        yield compared(lighter, heavier, motion, highest, wide).fall.strict


def share_that_stays(*terms: Any) -> float:
    """Return the share of draws that remain a strict fall; the terms are those of `strict_falls`.

    A fall that lives on the equality of its lobes remains in few draws.
    """
    falls = [*strict_falls(*terms)]
    return sum(share > 0.0 for share in falls) / len(falls)
