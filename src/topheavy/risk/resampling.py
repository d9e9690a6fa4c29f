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


def _sums(outcomes: Array, resamples: int, seed: int | Sequence[int]) -> Array:
    """Return the sums of outcomes over the motions, and over those of each resample.

    Of a resample, a binomial number of motions falls on each block, and there each is as likely. So
    a single block has the weights of `resampled`, and several have others of the same distribution.
    Sums of yes and no are whole numbers, so that equal counts are equal.
    """
    random, left = np.random.default_rng(seed), np.full(resamples, len(outcomes))
    total = np.zeros((1 + resamples, *outcomes.shape[1:]))
    for first in range(0, len(outcomes), BLOCK):
        block = outcomes[first : first + BLOCK]
        size, awaited = len(block), len(outcomes) - first
        drawn = left if size == awaited else random.binomial(left, size / awaited)
        counts = random.multinomial(drawn, np.full(size, 1.0 / size))
        left = left - drawn
        total += means(np.vstack([np.ones(size), counts]), block)
    return total


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
        total += _sums(outcomes[motions], resamples, [seed, number] if number else seed)
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
