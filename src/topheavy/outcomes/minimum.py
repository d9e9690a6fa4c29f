"""The minimum overturning acceleration: of one ground motion, and of pulses over their period."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.outcomes.search import (
    cases_of,
    checked_range,
    intervals_of_many,
    intervals_on,
    outcomes_of_factors,
)

if TYPE_CHECKING:
    import xarray

FACTORS_PER_CALL = 512
"""Factors of a grid in one call of the kernel, from the lowest up."""

RESOLUTION = 0.02
"""Normalised by the uplift acceleration: a spectrum misses no wider interval that overturns."""

FINER = (1.3, 0.001)
"""Both normalised by uplift acceleration: below the first, no interval wider than the second."""


@dataclass(frozen=True)
class LowestOverturning:
    """The lowest factor on a ground motion that overturns a structure, and its interval.

    Attributes
    ----------
    scale_range : (float, float)
        The first and the last factor of the search.
    floor : float
        No interval wider than this begins below the lowest factor. A narrower one can.
    bracket : (float, float) or None
        A factor that the structure survives and the lowest that overturns it. If the first factor
        of the range overturns, it is there twice; None if no factor does.
    upper : (float, float) or None
        The last factor in the same interval, and one above it that the structure survives. None if
        the interval does not end in the range. Survival regions narrower than the floor may lie in
        it.
    unit_acceleration : float
        Peak ground acceleration of the factor 1, g.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> minimum = th.lowest_overturning(column, pulse, (0.1, 1.0), floor=1e-3)
    >>> minimum.bracket[0] < minimum.factor <= minimum.bracket[1]
    True
    """

    scale_range: tuple[float, float]
    floor: float
    bracket: tuple[float, float] | None
    upper: tuple[float, float] | None
    unit_acceleration: float

    @property
    def factor(self) -> float:
        """The lowest factor that overturns; NaN if none does."""
        return self.bracket[1] if self.bracket else math.nan

    @property
    def acceleration(self) -> float:
        """The minimum overturning acceleration, g; NaN if no factor overturns."""
        return self.factor * self.unit_acceleration

    @property
    def width(self) -> float:
        """Width of the interval of factors; NaN if it does not end in the range."""
        return self.upper[1] - self.bracket[0] if self.bracket and self.upper else math.nan

    def __str__(self) -> str:
        """Return a sentence with the lowest factor, its interval, and the floor."""
        if self.bracket is None:
            first, last = self.scale_range
            lowest = f"No factor from {first:.6g} to {last:.6g} overturns"
        else:
            width = f"{self.width:.2g} wide" if self.upper else "open at the end of the range"
            lowest = (
                f"The lowest factor that overturns is {self.factor:.6g} "
                f"({self.acceleration:.6g} g), in an interval {width}"
            )
        return f"{lowest}. Intervals narrower than {self.floor:.6g} are not excluded."


def lowest_overturning(
    structure: Structure,
    excitation: Pulse | Record,
    scale_range: tuple[float, float],
    *,
    floor: float,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> LowestOverturning:
    """Return the lowest factor on a ground motion that overturns a structure.

    The range is halved until its parts are not wider than the floor. The outcome is computed at
    the ends of the parts, from the lowest up, and the first change is halved to 1e-10 of the
    factor. A smaller floor therefore never gives a higher minimum.

    Use `capacity` under a record. There the lowest factor often lies in an interval that is
    narrower than any measurement can resolve.

    Parameters
    ----------
    structure, excitation, vertical, scale_vertical
        See `overturned_by`.
    scale_range : (float, float)
        The first and the last factor, not negative.
    floor : float
        No wider interval below the result is missed.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, 2.0)
    >>> round(th.lowest_overturning(column, pulse, (0.1, 1.0), floor=1e-3).acceleration, 6)
    0.191798
    """
    first, last = checked_range(excitation, scale_range)
    if first < 0.0:
        raise ValueError(
            f"scale_range begins at {first:.6g}; expected factors from zero on: for the mirrored "
            "motion, give excitation.scaled(-1)"
        )
    parts = (last - first) / checks.positive("floor", floor)
    checks.number_of_cells(
        f"floor is {floor:.6g} of {first:g} to {last:g}", math.ceil(min(parts, 1e18))
    )
    parts = 2 ** max(0, math.ceil(math.log2(parts)))
    cases = cases_of([structure], excitation, scale_range, vertical, scale_vertical)

    def factors(begin: int, end: int) -> NDArray[np.float64]:
        step = (last - first) / parts
        return np.asarray(first + step * np.arange(begin, min(end, parts + 1)))

    overturned: list[bool] = []
    for begin in range(0, parts + 1, FACTORS_PER_CALL):
        grid = factors(begin, begin + FACTORS_PER_CALL)
        overturned += outcomes_of_factors(cases, np.zeros(grid.size, np.int64), grid)[1].tolist()
        start = overturned.index(True) if True in overturned else len(overturned)
        if False in overturned[start:]:
            break
    interval = None
    if start < len(overturned):
        end = start + (overturned[start:] + [False]).index(False)
        grid = factors(max(start - 1, 0), end + 1)
        interval = intervals_on(cases, [grid], floor, 0)[0][0]
    return LowestOverturning(
        scale_range=(first, last),
        floor=floor,
        bracket=interval.lower if interval else None,
        upper=interval.upper if interval else None,
        unit_acceleration=excitation.peak_acceleration,
    )


def overturning_spectrum(
    structure: Structure, shape: str, periods: ArrayLike, *, highest: float = 16.0
) -> xarray.Dataset:
    """Return the minimum overturning acceleration of a structure over the period of a pulse.

    No interval of amplitudes wider than 0.02 of the uplift acceleration is missed. Below 1.3 times
    the uplift acceleration, no interval wider than 0.001 of it is missed.

    Parameters
    ----------
    structure : Structure
        RockingBlock, Column, RockingFrame, FixedMassColumn or MonolithicPortal.
    shape : str
        A shape of `Pulse` that ends.
    periods : array_like, shape (n,)
        2π/ω, s; positive.
    highest : float
        The largest amplitude, normalised by the uplift acceleration.

    Returns
    -------
    xarray.Dataset
        Over the period: acceleration (g; NaN if no amplitude up to the highest overturns) and
        after_impact, whether the structure overturns after an impact (mode 1 of Zhang & Makris
        2001) or without one (mode 2).

    Examples
    --------
    >>> spectrum = th.overturning_spectrum(th.Column(0.5, 3.0), "one-sine", [0.5, 1.0, 4.0])
    >>> spectrum.acceleration.values.round(3)
    array([1.354, 0.286, 0.183])
    """
    import xarray  # here: with pandas it takes a second that only tables need

    block = as_block(structure)
    axis = checks.axis_values("periods", periods, zero_allowed=False)
    uplift = block.uplift_acceleration
    minima = [
        intervals[0] if intervals else None
        for intervals in intervals_of_many(
            [block] * axis.size,
            [Pulse(shape, uplift, period=period) for period in axis.tolist()],
            (1.0, highest),
            resolution=RESOLUTION,
            most_impacts=1,
            finer=FINER,
        )
    ]
    accelerations = [uplift * one.lower[1] if one else math.nan for one in minima]
    name = "minimum overturning acceleration"
    return xarray.Dataset(
        {
            "acceleration": ("period", accelerations, {"units": "g", "long_name": name}),
            "after_impact": ("period", [bool(one and one.number_of_impacts) for one in minima]),
        },
        coords={"period": ("period", axis, {"units": "s"})},
        attrs={"shape": shape, "slenderness": block.slenderness, "restitution": block.restitution},
    )
