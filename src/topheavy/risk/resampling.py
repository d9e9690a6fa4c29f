"""Means over motions and over resamples of the motions, and the intervals that these give.

A motion is drawn with all its outcomes, for every structure and at every intensity, so that
structures stay paired. The first axis of every result holds the mean of the ensemble, followed by
the means of its resamples.
"""

from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

MOTIONS_PER_BLOCK = 1000  # motions whose weights are in memory at a time

Array = NDArray[np.float64]


def _sums(outcomes: Array, resamples: int, seed: int | Sequence[int]) -> Array:
    """Return the sums of outcomes over the motions, and over those of each resample.

    Of a resample, a binomial number of motions falls on each block; in a block, all motions are
    equally likely. Sums of outcomes are whole numbers, so that equal counts stay equal.
    """
    random, unplaced = np.random.default_rng(seed), np.full(resamples, len(outcomes))
    total = np.zeros((1 + resamples, *outcomes.shape[1:]))
    for first in range(0, len(outcomes), MOTIONS_PER_BLOCK):
        block = outcomes[first : first + MOTIONS_PER_BLOCK]
        size, remaining = len(block), len(outcomes) - first
        placed = unplaced
        if size < remaining:
            placed = random.binomial(unplaced, size / remaining)
        counts = random.multinomial(placed, np.full(size, 1.0 / size))
        unplaced = unplaced - placed
        total += np.tensordot(np.vstack([np.ones(size), counts]), block.astype(float), axes=1)
    return total


def interval(values: Array, confidence: float) -> tuple[Array, Array, Array]:
    """Return the value of the ensemble and both ends of its interval: percentiles of resamples.

    The first axis of the values has the ensemble and its resamples. Undefined resamples (NaN) count
    as −∞ for the lower end and as +∞ for the upper end. An end that would be infinite is NaN; both
    are NaN where the value of the ensemble is.
    """
    tail = (1.0 - confidence) / 2.0
    unknown = np.isnan(values[1:])
    if not (unknown.any() or np.isnan(values[0]).any()):
        low, high = np.quantile(values[1:], (tail, 1.0 - tail), axis=0)
        return values[0], low, high
    with np.errstate(invalid="ignore"):  # infinity less infinity, between two such resamples
        low = np.quantile(np.where(unknown, -np.inf, values[1:]), tail, axis=0)
        high = np.quantile(np.where(unknown, np.inf, values[1:]), 1.0 - tail, axis=0)
    known = np.isfinite(values[0])
    low, high = (np.where(known & np.isfinite(end), end, np.nan) for end in (low, high))
    return values[0], low, high


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
        Every resample has as many motions of a group as the ensemble has: the scatter between
        groups is not in it.
        """
        of = np.asarray(self.outcomes if values is None else values)
        members = dict[Hashable, list[int]]()
        for motion, group in enumerate(self.groups or [None] * len(of)):
            members.setdefault(group, []).append(motion)
        total = np.zeros((1 + self.resamples, *of.shape[1:]))
        for number, motions in enumerate(members.values()):
            seed = [self.seed, number] if number else self.seed
            total += _sums(of[motions], self.resamples, seed)
        return total / len(of)

    def bounds(self, name: str, values: Array) -> dict[str, Array]:
        """Return a value of the ensemble and the ends of its interval, named for a table."""
        ends = interval(values, self.confidence)
        return dict(zip((name, f"{name}_low", f"{name}_high"), ends, strict=True))
