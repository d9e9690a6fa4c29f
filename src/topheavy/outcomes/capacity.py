"""The capacity of a structure under a record: from which factor on most factors overturn it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.records import Record
from topheavy.outcomes.search import overturned_by

WINDOWS = (0.025, 0.05, 0.1, 0.2)
"""Widths of the windows that `Capacity.range` compares."""


@dataclass(frozen=True, eq=False)
class Capacity:
    """Outcomes on a grid of factors, and the lowest window of factors in which most overturn.

    A window begins at a factor of the grid and ends at the factor that is nearest to 1 + width
    times the first.

    Attributes
    ----------
    factors : ndarray, shape (n,)
        Positive and increasing.
    overturned : ndarray of bool, shape (n,)
        The outcome under each factor.
    window : float
        Width of the window, relative to its first factor.
    share : float
        Of the factors in the window that have to overturn.
    unit_acceleration : float
        Peak ground acceleration of the factor 1, g.

    Examples
    --------
    >>> factors = np.linspace(1.0, 2.0, 101)
    >>> capacity = th.Capacity(factors, (abs(factors - 1.2) < 0.005) | (factors > 1.495))
    >>> round(capacity.factor, 2), round(capacity.over(0.2), 2)
    (1.5, 1.47)
    """

    factors: NDArray[np.float64]
    overturned: NDArray[np.bool_]
    window: float = 0.05
    share: float = 0.9
    unit_acceleration: float = math.nan

    def __post_init__(self) -> None:
        factors = checks.axis_values("factors", self.factors, zero_allowed=False)
        overturned = np.asarray(self.overturned, dtype=bool)
        if factors.size < 2 or (np.diff(factors) <= 0.0).any():
            raise ValueError("factors do not increase; expected two or more increasing factors")
        if overturned.shape != factors.shape:
            raise ValueError(
                f"overturned has shape {overturned.shape}; expected {factors.shape}, "
                "an outcome for each factor"
            )
        checks.positive("window", self.window)
        checks.fraction("share", self.share)
        object.__setattr__(self, "factors", factors)
        object.__setattr__(self, "overturned", overturned)

    def over(self, window: float) -> float:
        """Return the first factor of the lowest window of a width in which enough overturn.

        NaN if there is none up to the last factor.
        """
        logs, places = np.log(self.factors), np.arange(self.factors.size)
        ends = np.interp(logs + math.log1p(window), logs, places, right=np.inf)
        begins = places[np.isfinite(ends)]
        ends = np.rint(ends[begins]).astype(int) + 1
        count = np.concatenate([[0], np.cumsum(self.overturned)])
        enough = count[ends] - count[begins] >= self.share * (ends - begins)
        return float(self.factors[begins[enough][0]]) if enough.any() else math.nan

    @property
    def factor(self) -> float:
        """The capacity, as a factor; NaN if there is none up to the last factor."""
        return self.over(self.window)

    @property
    def acceleration(self) -> float:
        """The capacity as peak ground acceleration, g."""
        return self.factor * self.unit_acceleration

    @property
    def range(self) -> tuple[float, float]:
        """The least and the greatest factor over windows of 2.5 to 20 %; NaN if one has none."""
        factors = [self.over(window) for window in WINDOWS]
        return float(np.fmin.reduce(factors)), float(np.max(factors))

    def __str__(self) -> str:
        """Return a sentence with the capacity and its range over windows."""
        low, high = self.range
        return (
            f"A factor of {self.factor:.3g} ({self.acceleration:.3g} g), from which "
            f"{100 * self.share:g} % of the factors within {100 * self.window:g} % overturn; "
            f"{low:.3g} to {high:.3g} over windows of 2.5 to 20 %."
        )


def capacity(
    structure: Structure,
    record: Record,
    factors: ArrayLike,
    window: float = 0.05,
    share: float = 0.9,
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
    factors : array_like, shape (n,)
        Positive and increasing, with many steps in the narrowest window, 2.5 % of the factor.
    window : float
        Width of the window, relative to its first factor.
    share : float
        Of the factors in the window that have to overturn.

    Examples
    --------
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2")
    >>> capacity = th.capacity(th.Column(0.8, 4.8), record, np.geomspace(0.5, 8, 3000))
    >>> round(capacity.factor, 2), [round(factor, 2) for factor in capacity.range]
    (2.94, [2.94, 3.9])
    """
    scales = checks.axis_values("factors", factors, zero_allowed=False)
    overturned = overturned_by(
        structure, record, scales, vertical=vertical, scale_vertical=scale_vertical
    )
    return Capacity(scales, overturned, window, share, record.peak_acceleration)
