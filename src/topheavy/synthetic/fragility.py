"""Fragility curves and what they say, with confidence intervals from resampled motions.

A motion is drawn with all its outcomes, under every structure and at every intensity, so that
structures stay paired. What is counted is a mean over motions; in every array below the first axis
holds the mean of the ensemble itself and then those of its resamples.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr, ndtri

MOST_PASSES = 50
CLOSE = 1e-9  # of the score, for a single motion at each level
FARTHEST = 1e-12  # from 0 and 1, of a fitted share
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

    def __init__(self, motions: int, resamples: int, seed: int) -> None:
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
        weights = np.vstack([np.ones(size), counts]) / self._motions
        found = [means(weights, each) for each in outcomes]
        self._sums = list(map(np.add, self._sums, found)) if self._sums else found

    def means(self) -> list[Array]:
        """Return the means of each outcome, of shape (1 + resamples, ...).

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


def interval(values: Array, confidence: float) -> tuple[Array, Array, Array]:
    """Return the value of the ensemble and both ends of its interval: percentiles of resamples."""
    tail = (1.0 - confidence) / 2.0
    low, high = np.quantile(values[1:], (tail, 1.0 - tail), axis=0)
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


def fit(levels: Array, probabilities: Array) -> Array:
    """Return the likeliest fragility curves Φ(a + b ln s + c ln² s) as (a, b, c).

    With c = 0 they were lognormal; c is for the skewness that fragility under scaled motions has.
    The same number of motions is at every level. The likelihood is maximised by reweighted least
    squares (McCullagh & Nelder 1989, Generalized Linear Models, Sec. 2.5), started at the data.

    Parameters
    ----------
    levels : ndarray, shape (n,)
        Intensities s.
    probabilities : ndarray, shape (..., n)
        Shares that overturn.

    Returns
    -------
    ndarray, shape (..., 3)

    Raises
    ------
    ValueError
        For a curve that has not three points between 0 and 1: nothing can be fitted.
    """
    if (((probabilities > 0.0) & (probabilities < 1.0)).sum(axis=-1) < 3).any():
        raise ValueError("a fragility curve steps from 0 to 1; expected three points between them")
    powers = np.log(levels)[:, None] ** np.arange(3)
    line, weights = ndtri(np.clip(probabilities, 0.02, 0.98)), np.ones_like(probabilities)
    for _ in range(MOST_PASSES):
        weighted = weights[..., None] * powers
        right = (weighted * line[..., None]).sum(axis=-2)
        terms = np.linalg.solve(powers.T @ weighted, right[..., None])[..., 0]
        share = curve(levels, terms)
        probit = ndtri(share)
        density = np.exp(-(probit**2) / 2.0) / math.sqrt(2.0 * math.pi)
        weights = density**2 / (share * (1.0 - share))
        line = probit + (probabilities - share) / density
        # At the maximum the residuals are orthogonal to every power.
        if np.abs((weights * (line - probit)) @ powers).max() < CLOSE:
            return terms
    raise ArithmeticError(f"no fit of the fragility curves in {MOST_PASSES} passes")


def curve(levels: Array, terms: Array) -> Array:
    """Return the fitted shares that overturn, shape (..., n), of the terms of `fit`."""
    line = terms @ np.log(levels) ** np.arange(3)[:, None]
    return np.clip(ndtr(line), FARTHEST, 1.0 - FARTHEST)


def medians(levels: Array, probabilities: Array) -> Array:
    """Return the median capacities: the intensities at which the fitted curves rise past 1/2.

    Parameters
    ----------
    levels : ndarray, shape (n,)
    probabilities : ndarray, shape (..., n)

    Returns
    -------
    ndarray, shape (...)

    Raises
    ------
    ValueError
        When a curve does not pass 1/2 within the levels.
    """
    a, b, c = np.moveaxis(fit(levels, probabilities), -1, 0)
    found = np.exp(-2.0 * a / (b + np.sqrt(np.maximum(b**2 - 4.0 * a * c, 0.0))))
    if not ((levels[0] < found) & (found < levels[-1])).all():
        raise ValueError(
            f"a fragility curve passes 1/2 at {found.min():.3g} to {found.max():.3g}; expected it "
            f"between {levels[0]:.3g} and {levels[-1]:.3g}: widen the intensities"
        )
    return found


def share_of_size(mass_ratios: ArrayLike) -> Array:
    """Return x = 2γ/(1 + 2γ): R̂/R is 1 + x/2, Eq. (24), so that x goes from 0 to 1."""
    return np.array([1.0 if math.isinf(g) else 2 * g / (1 + 2 * g) for g in np.ravel(mass_ratios)])


def mass_ratio_of_share(share: float) -> float:
    """Return the γ at which 2γ/(1 + 2γ), the share of the possible increase in size, is `share`."""
    return math.inf if share == 1.0 else share / (2.0 - 2.0 * share)


def mass_ratios_of_gain(mass_ratios: ArrayLike, medians: Array, shares: ArrayLike) -> Array:
    """Return the γ that brings each share of all that a cap can add to the median capacity.

    The gain is fitted by a x + b x² with x of `share_of_size`: none at γ = 0, all at γ = ∞.

    Parameters
    ----------
    mass_ratios : array_like, shape (n,)
        Ascending from 0.
    medians : ndarray, shape (..., n)

    Returns
    -------
    ndarray, shape (..., number of shares)
    """
    x = share_of_size(mass_ratios)
    gains = medians / medians[..., :1] - 1.0
    slope, bend = np.moveaxis(gains @ np.linalg.pinv(np.stack([x, x**2])), -1, 0)[..., None]
    wanted = np.asarray(shares) * (slope + bend)
    at = 2.0 * wanted / (slope + np.sqrt(slope**2 + 4.0 * bend * wanted))
    return 0.5 * at / (1.0 - at)
