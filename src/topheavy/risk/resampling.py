"""Means over motions and over resamples of the motions, and the intervals that these give.

A motion is drawn with all its outcomes, under every structure and at every intensity, so that
structures stay paired. What is counted is a mean over motions; in every array below the first axis
holds the mean of the ensemble itself and then those of its resamples.
"""

from collections.abc import Hashable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

BLOCK = 1000  # motions whose weights are in memory at a time
POSITIVE, NEGATIVE = "is positive", "is negative"
"""In words: an interval that is wholly above zero, and one that is wholly below."""

Array = NDArray[np.float64]


def resampled(motions: int, resamples: int, seed: int) -> Array:
    """Return how much each motion counts: in the ensemble itself, then in its resamples.

    Returns
    -------
    ndarray, shape (1 + resamples, motions)
        Each row sums to 1.
    """
    even = np.full(motions, 1.0 / motions)
    drawn = np.random.default_rng(seed).multinomial(motions, even, resamples)
    return np.vstack([even, drawn / motions])


def means(weights: Array, outcomes: ArrayLike) -> Array:
    """Return the means over motions, by the weights of `resampled`.

    Parameters
    ----------
    weights : ndarray, shape (1 + resamples, motions)
    outcomes : array_like, shape (motions, ...)

    Returns
    -------
    ndarray, shape (1 + resamples, ...)
    """
    outcomes = np.asarray(outcomes, dtype=float)
    return np.tensordot(weights, outcomes, axes=1)


class ResampledMeans:
    """The `means` of outcomes that come in blocks of motions, of which one is held at a time.

    Of a resample, a binomial number of motions falls on each block, and there each is as likely. So
    a single block has the weights of `resampled`, and several have others of the same distribution.
    """

    def __init__(self, motions: int, resamples: int, seed: int | Sequence[int]) -> None:
        self._motions = self._awaited = motions
        self._left = np.full(resamples, motions)  # motions that each resample has still to draw
        self._random = np.random.default_rng(seed)
        self._sums: list[Array] = []

    def add(self, outcomes: Sequence[ArrayLike]) -> None:
        """Take up a block: several outcomes, each of shape (motions of the block, ...)."""
        size = len(np.asarray(outcomes[0]))
        drawn = self._left
        if size < self._awaited:
            drawn = self._random.binomial(self._left, size / self._awaited)
        counts = self._random.multinomial(drawn, np.full(size, 1.0 / size))
        self._awaited, self._left = self._awaited - size, self._left - drawn
        times = np.vstack([np.ones(size), counts])
        found = [means(times, each) for each in outcomes]
        self._sums = list(map(np.add, self._sums, found)) if self._sums else found

    def means(self) -> list[Array]:
        """Return the means of each outcome, of shape (1 + resamples, ...); errors as of `sums`."""
        return [found / self._motions for found in self.sums()]

    def sums(self) -> list[Array]:
        """Return the sums of each outcome over the motions, of shape (1 + resamples, ...).

        Those of yes and no are whole numbers, so that equal counts are equal.

        Raises
        ------
        ValueError
            When the blocks do not have all motions of the ensemble, or have more.
        """
        if self._awaited:
            raise ValueError(
                f"outcomes of {self._motions - self._awaited} motions were found; expected those "
                f"of {self._motions}: a shard is incomplete, delete it and run again"
            )
        return self._sums


def means_within(
    outcomes: ArrayLike, groups: Sequence[Hashable], resamples: int, seed: int
) -> Array:
    """Return the means of outcomes of shape (motions, ...), resampled within each group of motions.

    Every resample has as many motions of a group as the ensemble has: the scatter between groups
    is not in it. Every motion counts alike. One group has the weights of `resampled`.

    Parameters
    ----------
    outcomes : array_like, shape (motions, ...)
    groups : sequence, of length motions
        What the motions have in common, for instance the name of their earthquake.

    Returns
    -------
    ndarray, shape (1 + resamples, ...)
    """
    outcomes, members = np.asarray(outcomes), dict[Hashable, list[int]]()
    for motion, group in enumerate(groups):
        members.setdefault(group, []).append(motion)
    total = np.zeros((1 + resamples, *outcomes.shape[1:]))
    for number, motions in enumerate(members.values()):
        found = ResampledMeans(len(motions), resamples, [seed, number] if number else seed)
        for first in range(0, len(motions), BLOCK):
            found.add([outcomes[motions[first : first + BLOCK]]])
        total += found.sums()[0]
    return total / len(outcomes)


def interval(values: Array, confidence: float) -> tuple[Array, Array, Array]:
    """Return the value of the ensemble and both ends of its interval: percentiles of resamples.

    A resample whose value is NaN counts at both ends, as it could have any. An end on which these
    decide is NaN, and both are where the value of the ensemble is NaN.

    Parameters
    ----------
    values : ndarray, shape (1 + resamples, ...)
    confidence : float
        Between 0 and 1.

    Returns
    -------
    value, low, high : ndarray, shape (...)
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


def in_words(low: float, high: float) -> str:
    """Return what an interval says of the sign: "is positive", "is negative", or "includes zero".

    The words are a predicate of "the interval". An end at zero belongs to it.

    Raises
    ------
    ValueError
        For ends that are not in ascending order, or not numbers.
    """
    if not low <= high:
        raise ValueError(f"an interval goes from {low} to {high}; expected ascending ends")
    return POSITIVE if low > 0.0 else NEGATIVE if high < 0.0 else "includes zero"
