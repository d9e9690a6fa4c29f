"""Outcomes under many motions, with the resamples of these that every interval is made of."""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.risk.resampling import interval, means_within

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Outcomes of structures under motions, which are resampled within their groups.

    Attributes
    ----------
    outcomes : ndarray of bool, shape (motions, structures, levels)
    groups : sequence, of length motions
        What motions have in common, such as an earthquake; None for one group.
    resamples, seed : int
    confidence : float
        Of the intervals.
    """

    outcomes: NDArray[np.bool_]
    groups: Sequence[Hashable] | None
    resamples: int
    seed: int
    confidence: float

    def means(self, values: ArrayLike | None = None) -> Array:
        """Return means over the motions, of the ensemble and then of its resamples.

        Of the outcomes, or of values of shape (motions, ...): the shape is (1 + resamples, ...).
        """
        of = self.outcomes if values is None else values
        groups = self.groups or [None] * len(self.outcomes)
        return means_within(of, groups, self.resamples, self.seed)

    def bounds(self, name: str, values: Array) -> dict[str, Array]:
        """Return a value of the ensemble and the ends of its interval, named for a table."""
        ends = interval(values, self.confidence)
        return dict(zip((name, f"{name}_low", f"{name}_high"), ends, strict=True))
