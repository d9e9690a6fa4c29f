"""The lowest factor found that overturns: nested grids down to a floor, and what they leave open.

Under a record the factors that overturn form many narrow intervals, and the lowest is often the
narrowest. A search on one grid misses it without a sign. Here every grid holds the points of the
one before, so that a finer grid never finds a higher minimum.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.outcomes.search import (
    BRACKET,
    Factors,
    Interval,
    checked_range,
    outcomes_by,
    overturning_intervals,
    subjects_of,
)

NOT_EXCLUDED = "intervals narrower than the floor are not excluded"
"""What a search on grids cannot say of the lowest factor that overturns."""

AT_A_TIME = 512
"""Factors of a grid that are tried in one call, from the lowest up."""

SECTIONS = 32
"""Parts into which a bracket is cut in one call."""

GROWTH = 17.0 / 16.0
"""Ratio of successive distances from the lower end of an interval, where its upper is sought."""


@dataclass(frozen=True)
class LowestOverturning:
    """The lowest factor on an excitation that was found to overturn, and how it was sought.

    Parameters
    ----------
    scale_range : (float, float)
        The first and the last factor of the search.
    floor : float
        The narrowest interval of factors that the search cannot miss.
    steps : tuple of (float, float or None)
        The step of each grid, each half the one before, and the lowest factor found by then that
        overturns; None where none was found.
    bracket : (float, float) or None
        A factor that is survived and the lowest found that overturns. The first factor of the range
        twice where that overturns; None where no factor does.
    upper : (float, float) or None
        The last factor found in the same interval, and one above it that is survived. None where no
        factor up to the end of the range is found to be survived, or where none overturns.
    unit_acceleration : float
        Peak ground acceleration of the factor 1, g.
    wider_than : float
        Of an interval of factors that was sought besides: more than this wide. 0 if none was.
    wide : Interval or None
        The lowest such interval, on a grid with steps of an eighth of this width; survival regions
        narrower than a step may lie inside it. None where there is none.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> found = th.lowest_overturning(column, pulse, (0.1, 1.0), floor=1e-3)
    >>> found.bracket[0] < found.factor <= found.bracket[1]
    True
    """

    scale_range: tuple[float, float]
    floor: float
    steps: tuple[tuple[float, float | None], ...]
    bracket: tuple[float, float] | None
    upper: tuple[float, float] | None
    unit_acceleration: float
    wider_than: float = 0.0
    wide: Interval | None = None

    @property
    def factor(self) -> float:
        """The lowest factor found that overturns; NaN where none does."""
        return self.bracket[1] if self.bracket else math.nan

    @property
    def acceleration(self) -> float:
        """Peak ground acceleration of that factor, g; NaN where none overturns."""
        return self.factor * self.unit_acceleration

    @property
    def width(self) -> float:
        """Width of its interval, between survived factors; NaN where the upper is not in the range.

        A survival region narrower than a sixteenth of the width may lie inside it.
        """
        return self.upper[1] - self.bracket[0] if self.bracket and self.upper else math.nan

    def __str__(self) -> str:
        """Say what was found, in which steps, and what is not excluded."""
        first, last = self.scale_range
        if self.bracket is None:
            found = f"No factor tried from {first:.6g} to {last:.6g} overturns"
        else:
            begins = self.bracket[0] == self.bracket[1]
            which = "first factor of the range" if begins else "lowest factor found that overturns"
            verb = "overturns; it is" if begins else "is"
            wide = f"{self.width:.2g} wide" if self.upper else "open at the end of the range"
            found = (
                f"The {which} {verb} {self.factor:.6g} ({self.acceleration:.6g} g), "
                f"in an interval {wide}"
            )
        if self.wider_than:
            factor = self.wide.lower[1] if self.wide else math.nan
            found += f". The first interval wider than {self.wider_than:.6g} " + (
                f"begins at {factor:.6g} ({factor * self.unit_acceleration:.6g} g)"
                if self.wide
                else "is not in the range"
            )
        return (
            f"{found}. The step was halved from {self.steps[0][0]:.6g} to {self.steps[-1][0]:.6g}: "
            f"{NOT_EXCLUDED} (floor {self.floor:.6g})."
        )


def lowest_overturning(
    structure: Structure,
    excitation: Pulse | Record,
    scale_range: tuple[float, float],
    *,
    floor: float,
    wider_than: float | None = None,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> LowestOverturning:
    """Return the lowest factor on an excitation that is found to overturn, down to a floor.

    The first step is the whole range. It is halved until it is not wider than the floor, whatever
    is found. Each halving tries the new points below the lowest factor found so far; a factor that
    overturns is then bracketed to 1e-10 of the last factor. So no factor tried below the result
    overturns, and an interval wider than the floor cannot lie below it. A narrower one can.

    Under a record an interval may be so narrow that its outcomes hang on digits that no measurement
    resolves. The `width` shows it; `judge` with another tolerance and `reference.judge` tell.

    The cost is about (result − first factor)/floor histories.

    Parameters
    ----------
    structure : RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal
    excitation : Pulse or Record
        One that ends.
    scale_range : (float, float)
        The first and the last factor, not negative.
    floor : float
        The widest step that may be the last.
    wider_than : float, optional
        Also find the lowest interval of factors that is wider than this. Under a record the lowest
        factor often lies in an interval so narrow that no measured motion would meet it.
    vertical : Record, optional
        Vertical ground acceleration that starts with a record: g, positive upward.
    scale_vertical : bool
        Whether the factors multiply the vertical acceleration, too.

    Returns
    -------
    LowestOverturning

    Raises
    ------
    ValueError
        For a range that does not ascend or begins below zero, a floor that is not positive or below
        1e-10 of the last factor, a harmonic, and a vertical acceleration of −1 g or less at a
        factor of the range.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> found = th.lowest_overturning(column, pulse, (0.1, 1.0), floor=1e-3)
    >>> round(found.acceleration, 6)
    0.191798
    """
    first, last = checked_range(excitation, scale_range)
    if first < 0.0:
        raise ValueError(
            f"scale_range begins at {first:.6g}; expected factors from zero on: for the mirrored "
            "motion, give excitation.scaled(-1)"
        )
    width = BRACKET * last
    if checks.positive("floor", floor) < width:
        raise ValueError(
            f"floor is {floor:.6g}; expected at least {width:.6g}, {BRACKET:g} of the last factor: "
            "brackets are as wide"
        )
    wide = None
    if wider_than is not None:
        step = checks.positive("wider_than", wider_than) / 8.0
        intervals = overturning_intervals(
            structure,
            excitation,
            scale_range,
            resolution=step,
            most_impacts=0,
            vertical=vertical,
            scale_vertical=scale_vertical,
        )
        wide = next(
            (one for one in intervals if not one.upper or one.upper[0] - one.lower[1] > wider_than),
            None,
        )
    subjects = subjects_of([structure], excitation, scale_range, vertical, scale_vertical)

    def overturns(factors: Factors) -> NDArray[np.bool_]:
        return outcomes_by(subjects, np.zeros(factors.size, np.int64), factors)[0]

    begins, finishes = overturns(np.array([first, last]))
    bracket = None
    if begins:
        bracket = first, first
    elif finishes:
        bracket = _narrowed(overturns, first, last, width)
    step, steps, parts = last - first, [], 1
    while True:
        steps.append((step, bracket[1] if bracket else None))
        if step <= floor:
            break
        step, parts = 0.5 * step, 2 * parts
        below = bracket[0] if bracket else last
        bracket = _lowest(overturns, first, step, parts, below, width) or bracket
    return LowestOverturning(
        scale_range=(first, last),
        floor=floor,
        steps=tuple(steps),
        bracket=bracket,
        upper=_upper_end(overturns, bracket[1], last, width) if bracket else None,
        unit_acceleration=excitation.peak_acceleration,
        wider_than=float(wider_than or 0.0),
        wide=wide,
    )


Overturns = Callable[[Factors], NDArray[np.bool_]]


def _lowest(
    overturns: Overturns, first: float, step: float, parts: int, below: float, width: float
) -> tuple[float, float] | None:
    """Return the bracket of the lowest new point that overturns, of a grid just halved.

    Its old points, the even ones, are survived where they are lower than `below`.
    """
    for begin in range(1, parts, 2 * AT_A_TIME):
        places = np.arange(begin, min(begin + 2 * AT_A_TIME, parts), 2, dtype=float)
        factors = first + step * places
        factors = factors[factors < below]
        if factors.size == 0:
            return None
        overturned = overturns(factors)
        if overturned.any():
            at = int(np.argmax(overturned))
            before = first + step * (int(places[at]) - 1)
            return _narrowed(overturns, before, float(factors[at]), width)
    return None


def _narrowed(holds: Overturns, low: float, high: float, width: float) -> tuple[float, float]:
    """Narrow a bracket to `width`, always to the lowest point tried for which `holds` is true.

    Halving would pass over lower factors that it tried in vain: here none that was tried is.
    """
    while high - low > width:
        points = np.linspace(low, high, SECTIONS + 1)
        at = int(np.argmax(np.append(holds(points[1:-1]), True)))
        low, high = float(points[at]), float(points[at + 1])
    return low, high


def _upper_end(
    overturns: Overturns, lowest: float, last: float, width: float
) -> tuple[float, float] | None:
    """Return the upper end of the interval that begins at `lowest`, or None beyond the range.

    The distances tried grow in proportion, so that the interval may have any width.
    """
    span = last - lowest
    if span <= 0.0:
        return None
    count = 2 + int(math.log(span / width, GROWTH)) if span > width else 1
    distances = np.geomspace(min(width, span), span, count)
    points = np.array([lowest, *np.minimum(lowest + distances, last)])
    survived = ~overturns(points[1:])
    if not survived.any():
        return None
    at = int(np.argmax(survived))
    return _narrowed(
        lambda factors: ~overturns(factors), float(points[at]), float(points[at + 1]), width
    )
