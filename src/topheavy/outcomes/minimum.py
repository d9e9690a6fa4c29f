"""The minimum overturning acceleration: of one ground motion, and of pulses over their period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure, Structures, are_several, named_blocks
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import FiniteShape
from topheavy.kernel.taylor import OUTCOME
from topheavy.outcomes.search import (
    cases_of,
    checked_range,
    intervals_of_many,
    intervals_on,
    outcomes_of_factors,
    steps_across,
    structure_coordinates,
)

if TYPE_CHECKING:
    import xarray

FACTORS_PER_CALL, MIN_FACTORS_PER_CALL = 512, 32
"""Numbers of factors in one call of the kernel: of all grids together, and at least of each."""

STEP_ABOVE = 0.1
"""Step by which the end of an interval is sought, relative to the distance from the minimum."""

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
        the interval does not end in the range. Survival regions narrower than the floor, or than a
        tenth of their distance from the minimum, may lie in it.
    unit_acceleration : float
        Peak ground acceleration of the factor 1, g.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, angular_frequency=2.0)
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
    scale_range: tuple[float, float] | None = None,
    *,
    floor: float | None = None,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> LowestOverturning:
    """Return the lowest factor on a ground motion that overturns a structure.

    The range is halved until its parts are not wider than the floor. The outcome is computed at
    the ends of the parts, from the lowest up, until one overturns; this change is halved to 1e-10
    of the factor. A smaller floor therefore never gives a higher minimum. The end of the interval
    is sought in steps that grow with the distance from the minimum.

    Use `capacity` under a record. There the lowest factor often lies in an interval that is
    narrower than any measurement can resolve.

    Parameters
    ----------
    structure, excitation, vertical, scale_vertical
        See `overturned_by`.
    scale_range : (float, float)
        The first and the last factor, not negative. There is no default, as for the floor.
    floor : float
        No wider interval below the result is missed.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> round(th.lowest_overturning(column, pulse, (0.1, 1.0), floor=1e-3).acceleration, 6)
    0.191798
    """
    if scale_range is None or floor is None:
        lacking = " and ".join(
            ["scale_range"] * (scale_range is None) + ["floor"] * (floor is None)
        )
        raise ValueError(
            f"lowest_overturning lacks {lacking}; expected the factors to search, and the width of "
            "the narrowest interval that matters: for instance (0.1, 1.0), floor=1e-3"
        )
    if (first := checked_range(scale_range)[0]) < 0.0:
        raise ValueError(
            f"scale_range begins at {first:.6g}; expected factors from zero on: for the mirrored "
            "motion, give excitation.scaled(-1)"
        )
    once = [structure], [excitation], [scale_range], [checks.positive("floor", floor)]
    return lowest_of_many(*once, vertical, scale_vertical)[0]


def lowest_of_many(
    structures: Sequence[Structure],
    excitations: Sequence[Pulse | Record],
    scale_ranges: Sequence[tuple[float, float]],
    floors: Sequence[float],
    *vertical: Any,
) -> list[LowestOverturning]:
    """Return the `lowest_overturning` of several structures, each with its motion and search.

    All are searched together, in few calls.
    """
    pairs = zip(structures, excitations, scale_ranges, strict=True)
    cases = [cases_of([structure], motion, ends, *vertical)[0] for structure, motion, ends in pairs]
    grids = [*map(_nested_grid, scale_ranges, floors)]
    begin, start = 0, [-1] * len(grids)  # the place in its grid of the first factor that overturns
    searched = [*range(len(grids))]
    while searched:
        end = begin + max(MIN_FACTORS_PER_CALL, FACTORS_PER_CALL // len(searched))
        parts = [grids[at].factors(range(begin, min(end, grids[at].size))) for at in searched]
        case_index = np.repeat(searched, [part.size for part in parts])
        factors = np.concatenate(parts)
        overturned = outcomes_of_factors(cases, case_index, factors, detail=OUTCOME)[1]
        for at in np.unique(case_index[overturned]).tolist():
            start[at] = begin + int(np.argmax(overturned[case_index == at]))
        begin, searched = end, [at for at in searched if start[at] < 0 and end < grids[at].size]
    overturning = [at for at, place in enumerate(start) if place >= 0]
    intervals = intervals_on(
        [cases[at] for at in overturning],
        [grids[at].from_minimum(start[at]) for at in overturning],
        max(floors),
        0,
    )
    lowest = {at: first for at, (first, *_) in zip(overturning, intervals, strict=True)}
    return [
        LowestOverturning(
            scale_range=(grids[at].first, grids[at].last),
            floor=floor,
            bracket=lowest[at].lower if at in lowest else None,
            upper=lowest[at].upper if at in lowest else None,
            unit_acceleration=excitation.peak_acceleration,
        )
        for at, (excitation, floor) in enumerate(zip(excitations, floors, strict=True))
    ]


class _Grid(NamedTuple):
    """Factors in equal steps."""

    first: float
    last: float
    size: int

    def factors(self, places: Sequence[int]) -> NDArray[np.float64]:
        step = (self.last - self.first) / (self.size - 1)
        return np.asarray(self.first + step * np.asarray(places))

    def from_minimum(self, start: int) -> NDArray[np.float64]:
        """Return the factor before the one at `start`, this one, and others in growing steps."""
        places = [start]
        while places[-1] < self.size - 1:
            step = max(1, int(STEP_ABOVE * (places[-1] - start)))
            places.append(min(places[-1] + step, self.size - 1))
        return self.factors([start - 1, *places] if start else places)


def _nested_grid(scale_range: tuple[float, float], floor: float) -> _Grid:
    """Return a range in equal parts not wider than the floor; their number is a power of two."""
    first, last, parts = steps_across(scale_range, "floor", floor)
    return _Grid(first, last, 2 ** max(0, math.ceil(math.log2(parts))) + 1)


def overturning_spectrum(
    structure: Structures, shape: FiniteShape, periods: ArrayLike, *, highest: float = 16.0
) -> xarray.Dataset:
    """Return the minimum overturning acceleration of structures over the period of a pulse.

    No interval of amplitudes wider than 0.02 of the uplift acceleration is missed. Below 1.3 times
    the uplift acceleration, no interval wider than 0.001 of it is missed.

    Parameters
    ----------
    structure : Structure, or several in a list or a mapping from names
    shape : str
        A shape of `Pulse` that ends.
    periods : array_like, shape (n,)
        2π/ω, s; positive.
    highest : float
        The largest amplitude, normalised by the uplift acceleration; more than 1.

    Returns
    -------
    xarray.Dataset
        Over the period, or (structure, period) for several structures: acceleration (g; NaN if no
        amplitude up to the highest overturns) and after_impact, whether the structure overturns
        after an impact (mode 1 of Zhang & Makris 2001) or without one (mode 2). Since xarray
        2025.11 a ratio of two results keeps the unit g: give it its own by `assign_attrs`.

    Examples
    --------
    >>> column = th.Column.of_dimensions(width=1.0, height=6.0)  # m
    >>> structures = {"column": column, "frame": th.RockingFrame(column, mass_ratio=2.0)}
    >>> spectrum = th.overturning_spectrum(structures, "one-sine", np.linspace(0.5, 4.0, 8))
    >>> spectrum.acceleration.sel(period=1.0).to_series().round(3).to_dict()
    {'column': 0.286, 'frame': 0.379}
    >>> axes = th.plot.spectrum(spectrum)
    """
    import xarray

    blocks, axis = named_blocks(structure), checks.axis_values("periods", periods, "s")
    if checks.positive("highest", highest) <= 1.0:
        raise ValueError(f"highest is {highest:.6g}; expected more than 1, the uplift acceleration")
    pairs = [(block, period) for block in blocks.values() for period in axis.tolist()]
    intervals = intervals_of_many(
        [block for block, _ in pairs],
        [Pulse(shape, block.uplift_acceleration, period=period) for block, period in pairs],
        (1.0, highest),
        resolution=RESOLUTION,
        most_impacts=1,
        finer=FINER,
    )
    minima = [
        (block.uplift_acceleration * some[0].lower[1], some[0].number_of_impacts > 0)
        if some
        else (math.nan, False)
        for (block, _), some in zip(pairs, intervals, strict=True)
    ]
    accelerations, after_impact = np.reshape(minima, (len(blocks), axis.size, 2)).transpose(2, 0, 1)
    at, name = ("structure", "period"), "minimum overturning acceleration"
    result = xarray.Dataset(
        {
            "acceleration": (at, accelerations, {"units": "g", "long_name": name}),
            "after_impact": (at, after_impact > 0.0),
        },
        coords={"period": ("period", axis, {"units": "s"})} | structure_coordinates(blocks),
        attrs={"shape": shape},
    )
    return result if are_several(structure) else result.isel(structure=0)
