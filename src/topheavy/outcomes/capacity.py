"""The capacity of a structure under a record: from which factor on most factors overturn it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure, as_block
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.records import Record, both_records
from topheavy.outcomes.search import overturned_by

WINDOW = 0.05
"""Width of the window of the capacity that is stated, relative to its first factor."""

WINDOWS = (0.025, WINDOW, 0.1, 0.2)
"""Widths of the windows that `Capacity.range` compares."""

MIN_STEPS = 10
"""In a window: the share that overturns is hardly known from fewer."""

GROWTH = 1.001
"""Ratio of neighbouring factors where `capacity` chooses them."""

MAX_OVER_UPLIFT = 100.0
"""Where these factors end, over the factor of uplift."""

FACTORS_PER_CALL = 500
"""Of these factors, from the lowest up, until all windows have a capacity."""


@dataclass(frozen=True, eq=False, repr=False)
class Capacity:
    """Outcomes on a grid of factors, and the lowest window of factors in which most overturn.

    A window begins at a factor of the grid and ends at the factor that is nearest to 1 + width
    times the first.

    Attributes
    ----------
    factors : ndarray, shape (n,)
        Positive and increasing, with ten steps or more in a window of 2.5 %.
    overturned : ndarray of bool, shape (n,)
        The outcome under each factor.
    share : float
        Of the factors in the window that have to overturn.
    unit_acceleration : float
        Peak ground acceleration of the factor 1, g.

    Examples
    --------
    >>> factors = 1.001 ** np.arange(700)
    >>> capacity = th.Capacity(factors, (abs(factors - 1.2) < 0.005) | (factors > 1.5))
    >>> round(capacity.factor, 2), round(capacity.over(0.2), 2)
    (1.49, 1.47)
    """

    factors: NDArray[np.float64]
    overturned: NDArray[np.bool_]
    share: float = 0.9
    unit_acceleration: float = math.nan

    def __post_init__(self) -> None:
        factors = checks.axis_values("factors", self.factors)
        overturned = checks.truths("overturned", self.overturned)
        if factors.size < 2 or (np.diff(factors) <= 0.0).any():
            raise ValueError("factors do not increase; expected two or more increasing factors")
        if overturned.shape != factors.shape:
            raise ValueError(
                f"overturned has shape {overturned.shape}; expected {factors.shape}, "
                "an outcome for each factor"
            )
        object.__setattr__(self, "factors", factors)
        object.__setattr__(self, "overturned", overturned)
        unit = checks.number("unit_acceleration", self.unit_acceleration)
        if not math.isnan(unit):
            unit = checks.not_negative("unit_acceleration", unit)
        checks.set_fields(
            self,
            share=checks.positive("share", checks.fraction("share", self.share)),
            unit_acceleration=unit,
        )
        self.shares(WINDOWS[0])  # refuses a grid that is too coarse

    def shares(self, window: float) -> NDArray[np.float64]:
        """Return of each factor the share that overturns in the window that begins with it.

        NaN where the window would end beyond the last factor.

        Raises
        ------
        ValueError
            If steps between factors are more than a tenth of the window.
        """
        logs, places = np.log(self.factors), np.arange(self.factors.size)
        width = math.log1p(checks.positive("window", window))
        if (widest := float(np.diff(logs).max())) * MIN_STEPS > width:
            first, last = self.factors[[0, -1]]
            fewest = math.ceil(MIN_STEPS * (logs[-1] - logs[0]) / width) + 1
            raise ValueError(
                f"factors have steps of up to {math.expm1(widest):.2%} of the factor; expected at "
                f"most {math.expm1(width / MIN_STEPS):.2%} for a window of {window:.3g}, for "
                f"instance np.geomspace({first:.6g}, {last:.6g}, {fewest})"
            )
        ends = np.interp(logs + width, logs, places, right=np.inf)
        begins = places[np.isfinite(ends)]
        ends = np.rint(ends[begins]).astype(int) + 1
        count = np.concatenate([[0], np.cumsum(self.overturned)])
        result = np.full(places.size, np.nan)
        result[begins] = (count[ends] - count[begins]) / (ends - begins)
        return result

    def over(self, window: float) -> float:
        """Return the first factor of the lowest window of a width in which enough overturn.

        NaN if there is none up to the last factor.
        """
        (enough,) = np.nonzero(self.shares(window) >= self.share)
        return float(self.factors[enough[0]]) if enough.size else math.nan

    @property
    def factor(self) -> float:
        """The capacity over a window of 5 %, as a factor; NaN if there is none."""
        return self.over(WINDOW)

    @property
    def acceleration(self) -> float:
        """The capacity as peak ground acceleration, g."""
        return self.factor * self.unit_acceleration

    @property
    def range(self) -> tuple[float, float]:
        """The least and the greatest factor over windows of 2.5 to 20 %; NaN if one has none.

        It shows how far the definition of a capacity matters here. It is no interval of confidence:
        another record or a slightly different √r can have a capacity far outside.
        """
        factors = [self.over(window) for window in WINDOWS]
        return float(np.fmin.reduce(factors)), float(np.max(factors))

    def __repr__(self) -> str:
        """Return a sentence with the capacity and its range over windows."""
        first, last = (f"{factor:.3g}" for factor in self.factors[[0, -1]])
        window, share = f"{100 * WINDOW:g} %", f"{100 * self.share:g} %"
        if math.isnan(self.factor):
            return (
                f"No capacity from a factor of {first} to {last}: in no window of {window} do "
                f"{share} of the factors overturn; {self.overturned.sum()} of "
                f"{self.overturned.size} factors overturn."
            )
        low, high = self.range
        most = f"more than {last}" if math.isnan(high) else f"{high:.3g}"
        in_g = "" if math.isnan(self.unit_acceleration) else f" ({self.acceleration:.3g} g)"
        return (
            f"A factor of {self.factor:.3g}{in_g}, from which {share} of the factors within "
            f"{window} overturn; {low:.3g} to {most} over windows of 2.5 to 20 %."
        )


def capacity(
    structure: Structure,
    record: Record,
    factors: ArrayLike | None = None,
    *,
    vertical: Record | None = None,
    scale_vertical: bool = True,
) -> Capacity:
    """Return the lowest factor on a record from which most factors within a window overturn.

    Under a record, the outcome can change between any two neighbouring factors, and the lowest
    factor that overturns depends on the grid. The share in a window hardly does.

    Parameters
    ----------
    structure, record, vertical, scale_vertical
        See `overturned_by`.
    factors : array_like, shape (n,), optional
        Positive and increasing, with ten steps or more in a window of 2.5 %. By default in steps of
        0.1 % from uplift, until each window has a capacity, or to 100 times uplift.

    Examples
    --------
    >>> pier = th.Column.of_dimensions(width=1.6, height=9.6)  # m
    >>> bent = th.RockingFrame.of_masses(pier, cap_mass=400, column_mass=60, columns=3)  # t
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2")
    >>> axes = th.plot.capacity(th.capacity(bent, record), label="bent")
    >>> result = th.capacity(pier, record)
    >>> round(result.factor, 2), [round(end, 2) for end in result.range]
    (2.92, [2.88, 3.9])
    >>> axes = th.plot.capacity(result, label="pier", axes=axes)
    """
    block = as_block(structure)
    checked_excitation(record, ends=True)

    def outcomes(some: NDArray[np.float64]) -> NDArray[np.bool_]:
        return overturned_by(block, record, some, vertical=vertical, scale_vertical=scale_vertical)

    peak = checks.positive("peak acceleration of the record", record.peak_acceleration)
    if factors is not None:
        scales = checks.axis_values("factors", factors)
        return Capacity(scales, outcomes(scales), unit_acceleration=peak)
    scale_vertical = checks.truth("scale_vertical", scale_vertical)
    first = block.uplift_acceleration / peak
    last = MAX_OVER_UPLIFT * first
    if vertical is not None:
        first *= 0.1  # it uplifts earlier while the ground falls
        fall = -float(both_records(record, vertical)[1].acceleration.min())
        if scale_vertical and fall * last >= 1.0:
            last = 0.999 / fall  # beyond, it would lose contact
    grid = first * GROWTH ** np.arange(math.log(last / first) / math.log(GROWTH))
    overturned = np.empty(0, bool)
    while True:
        more = grid[overturned.size : overturned.size + FACTORS_PER_CALL]
        overturned = np.append(overturned, outcomes(more))
        result = Capacity(grid[: overturned.size], overturned, unit_acceleration=peak)
        if math.isfinite(result.range[1]) or overturned.size == grid.size:
            return result
