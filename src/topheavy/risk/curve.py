"""The fragility curve Φ(a + b ln s + c ln² s) over the intensity s: fit, median, dispersion.

With c = 0 the curve is lognormal; c is for the skewness that fragility under scaled motions has.
The functions take the shares of an ensemble and of its resamples together. Where nothing can be
fitted, or where a curve has no median, the value is NaN.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import log_ndtr, ndtr, ndtri

MAX_PASSES = 50
MAX_HALVINGS = 40  # of a pass
EXPECTED_PASSES = 25  # with the expected curvature of the likelihood; then with the observed one
SCORE_TOLERANCE = 1e-9  # for a single motion at each level
ROUNDING = 1e-12  # of the log-likelihood, for a single motion at each level
MIN_SHARE = 1e-12  # of a fitted share, and of its difference to 1

Array = NDArray[np.float64]


def fit(levels: ArrayLike, shares: ArrayLike, *, skewed: bool) -> Array:
    """Return the likeliest curves Φ(a + b ln s + c ln² s) as (a, b, c); NaN where there is none.

    The same number of motions is at every level. The likelihood is maximised by reweighted least
    squares (McCullagh & Nelder 1989, Generalized Linear Models, Sec. 2.5), started at the data. A
    pass that makes the data less likely is halved until it does not: it has gone too far, as passes
    do where many levels are far from the median. The logarithm of the likelihood is concave, and
    with as many shares between 0 and 1 as there are terms it has one maximum.

    Parameters
    ----------
    levels : array_like, shape (n,)
        Intensities s, positive and ascending.
    shares : array_like, shape (..., n)
        Of the motions, those that overturn at each level.
    skewed : bool
        Whether c is fitted; otherwise it is 0.

    Returns
    -------
    ndarray, shape (..., 3)
    """
    logs, shares = np.log(np.asarray(levels, dtype=float)), np.asarray(shares, dtype=float)
    middle, width = logs.mean(), np.ptp(logs) / 2.0 or 1.0
    number = 3 if skewed else 2
    powers, centred = (
        np.power.outer(x, np.arange(number)) for x in (logs, (logs - middle) / width)
    )
    terms = np.full((*shares.shape[:-1], 3), math.nan)
    fitted = np.asarray(points_between(shares) >= number)
    terms[fitted, :number] = _likeliest(powers, centred, shares[fitted])
    terms[~np.isnan(terms[..., 0]), number:] = 0.0
    # The terms in (ln s - middle)/width, expanded to those in ln s.
    a, b, c = np.moveaxis(terms, -1, 0)
    b, c = b / width, c / width**2
    return np.stack([a - b * middle + c * middle**2, b - 2.0 * c * middle, c], axis=-1)


def _likeliest(powers: Array, centred: Array, shares: Array) -> Array:
    """Return the likeliest terms in the centred powers, shape (m, number), of shares (m, n).

    NaN without convergence, which the score in the `powers` of ln s decides.
    """
    result = np.full((len(shares), powers.shape[-1]), math.nan)
    left = np.arange(len(shares))  # the curves that have not converged
    probit = ndtri(np.clip(shares, 0.02, 0.98))
    weights, slopes = np.ones_like(shares), np.zeros_like(shares)
    terms, likely = np.zeros_like(result), np.full(len(shares), -math.inf)
    for passed in range(MAX_PASSES):
        normal = centred.T @ (weights[..., None] * centred)
        right = (weights * probit + slopes) @ centred
        next_terms = np.linalg.solve(normal, right[..., None])[..., 0]
        for _ in range(MAX_HALVINGS):
            probit = next_terms @ centred.T
            over, under = log_ndtr(probit), log_ndtr(-probit)
            likelihood = (shares * over + (1.0 - shares) * under).sum(axis=-1)
            worse = likelihood < likely - ROUNDING
            if not worse.any():
                break
            next_terms[worse] = 0.5 * (next_terms[worse] + terms[worse])
        terms, likely = next_terms, likelihood
        density = -0.5 * (probit**2 + math.log(2.0 * math.pi))  # its logarithm, as of the shares
        up, down = np.exp(density - over), np.exp(density - under)
        slopes = shares * up - (1.0 - shares) * down
        weights = up * down  # the expected curvature
        if passed >= EXPECTED_PASSES:
            weights = shares * up * (up + probit) + (1.0 - shares) * down * (down - probit)
        # At the maximum the residuals are orthogonal to every power.
        moving = (np.abs(slopes @ powers) >= SCORE_TOLERANCE).any(axis=-1)
        result[left[~moving]] = terms[~moving]
        left, shares, probit, weights, slopes, terms, likely = (
            values[moving] for values in (left, shares, probit, weights, slopes, terms, likely)
        )
        if not left.size:
            break
    return result


def _share(line: Array) -> Array:
    return np.asarray(np.clip(ndtr(line), MIN_SHARE, 1.0 - MIN_SHARE))


def curve(levels: ArrayLike, terms: Array) -> Array:
    """Return the fitted shares that overturn, shape (..., n), of the terms of `fit`."""
    return _share(terms @ np.log(np.asarray(levels)) ** np.arange(3)[:, None])


def points_between(shares: Array) -> NDArray[np.int64]:
    """Return the number of levels, of the last axis, whose share is neither 0 nor 1.

    The mean of weights may miss either by rounding.
    """
    return np.asarray(((shares > MIN_SHARE) & (shares < 1.0 - MIN_SHARE)).sum(axis=-1))


def rises_past(share: float, terms: Array) -> Array:
    """Return the intensities at which the curves of `fit` rise past a share; NaN where they do not.

    The terms have the shape (..., 3), the intensities the shape (...).
    """
    a, b, c = np.moveaxis(terms, -1, 0)
    a = a - ndtri(share)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        root = np.sqrt(b**2 - 4.0 * a * c)  # the slope at the crossing
        # One of both forms of the same root: neither subtracts nearly equal numbers.
        crossing = np.exp(np.where(b >= 0.0, -2.0 * a / (b + root), (root - b) / (2.0 * c)))
    return np.where((root > 0.0) & np.isfinite(crossing) & (crossing > 0.0), crossing, math.nan)


def medians(levels: ArrayLike, terms: Array) -> Array:
    """Return the median capacities: the intensities at which the curves rise past 1/2.

    A median outside the levels, which ascend, is NaN. The terms are those of `fit`.
    """
    levels, middle = np.asarray(levels), rises_past(0.5, terms)
    return np.where((levels[0] < middle) & (middle < levels[-1]), middle, math.nan)


def dispersions(terms: Array) -> Array:
    """Return half of ln(s₈₄/s₁₆), the intensities at which a curve rises past Φ(1) and Φ(−1).

    Of a lognormal curve it is the standard deviation of ln s, 1/b. NaN where a curve does not rise
    past both.
    """
    low, high = (np.log(rises_past(float(ndtr(probit)), terms)) for probit in (-1.0, 1.0))
    return np.asarray(0.5 * (high - low))
