"""Curves of structures and differences of pairs, with intervals, in words and as labelled arrays.

In every `means` and `terms` the first axis holds the ensemble and then its resamples.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import beta, binomtest

from topheavy.risk.curve import curve, dispersions, medians, why_no_fit, why_no_median
from topheavy.risk.resampling import in_words, interval

if TYPE_CHECKING:
    import xarray

UNKNOWN = "is not known"
"""In words: an interval with an end that is NaN."""

Array = NDArray[np.float64]
Outcomes = NDArray[np.bool_]
Variables = dict[str, tuple[tuple[str, ...], Any]]


def curve_table(
    overturned: NDArray[np.int64],
    motions: int,
    levels: Array,
    means: Array,
    terms: Array,
    confidence: float,
    *,
    skewed: bool,
) -> "xarray.Dataset":
    """Return the `curves` of a `Fragility`, without its coordinates.

    Parameters
    ----------
    overturned : ndarray of int, shape (structures, levels)
        How many motions overturn each.
    motions : int
    levels : ndarray, shape (levels,)
    means : ndarray, shape (1 + resamples, structures, levels)
        Shares that overturn.
    terms : ndarray, shape (1 + resamples, structures, 3)
        Of the curves of these shares.
    confidence : float
    skewed : bool
        As of `fit`.
    """
    import xarray  # here: with pandas it takes a second that only tables need

    low, high = exact_interval(overturned, motions, confidence)
    at, one = ("structure", "level"), ("structure",)
    middles, spreads = medians(levels, terms), dispersions(terms)
    no_fit = [why_no_fit(*each, skewed=skewed) for each in zip(means[0], terms[0], strict=True)]
    no_median = [
        why_no_median(levels, *each, skewed=skewed) for each in zip(means[0], terms[0], strict=True)
    ]
    no_spread = [
        "" if np.isfinite(spread) else reason or "the curve does not rise past Φ(−1) and Φ(1)"
        for spread, reason in zip(spreads[0], no_fit, strict=True)
    ]
    found: Variables = {
        "overturned": (at, overturned),
        "probability": (at, overturned / motions),
        "probability_low": (at, low),
        "probability_high": (at, high),
        "fitted": (at, curve(levels, terms[0])),
        "terms": (("structure", "term"), terms[0]),
    }
    found |= _resampled("median_capacity", one, middles, confidence)
    reasons = _reasons(no_median, middles, found, "median_capacity")
    found |= {"median_capacity_reason": (one, reasons)}
    found |= _resampled("dispersion", one, spreads, confidence)
    found |= {"dispersion_reason": (one, _reasons(no_spread, spreads, found, "dispersion"))}
    return xarray.Dataset(found, {"term": list("abc")})


def pair_table(
    outcomes: Outcomes,
    levels: Array,
    means: Array,
    terms: Array,
    places: Sequence[tuple[int, int]],
    confidence: float,
) -> "xarray.Dataset":
    """Return the `pairs` of a `Fragility`, without its coordinates.

    Parameters
    ----------
    outcomes : ndarray of bool, shape (motions, structures, levels)
    levels, means, terms, confidence
        As of `curve_table`.
    places : sequence of (int, int)
        The first and the second structure of each pair.
    """
    import xarray

    first, second = np.array(places, dtype=int).reshape(-1, 2).T
    only_first = (outcomes[:, first] & ~outcomes[:, second]).sum(axis=0)
    only_second = (outcomes[:, second] & ~outcomes[:, first]).sum(axis=0)
    middles = medians(levels, terms)
    gain = middles[:, second] / middles[:, first] - 1.0
    at, one = ("pair", "level"), ("pair",)
    no_gain = ["one of both has no median" if np.isnan(value) else "" for value in gain[0]]
    found: Variables = {
        "only_first": (at, only_first),
        "only_second": (at, only_second),
        "sign_test": (at, sign_test(only_first, only_second)),
    }
    found |= _resampled("less", at, means[:, first] - means[:, second], confidence)
    found |= {"less_words": (at, _words(found, "less"))}
    found |= _resampled("gain", one, gain, confidence)
    found |= {"gain_words": (one, _words(found, "gain"))}
    found |= {"gain_reason": (one, _reasons(no_gain, gain, found, "gain"))}
    return xarray.Dataset(found)


def exact_interval(counts: NDArray[np.int64], of: int, confidence: float) -> tuple[Array, Array]:
    """Return the exact interval of a probability from counts (Clopper & Pearson 1934).

    Parameters
    ----------
    counts : ndarray of int, any shape
    of : int
        Trials of each count.
    confidence : float

    Returns
    -------
    low, high : ndarray, of the shape of the counts
    """
    tail, left = 0.5 * (1.0 - confidence), of - counts
    low = np.where(counts > 0, beta.ppf(tail, counts, left + 1), 0.0)
    high = np.where(left > 0, beta.ppf(1.0 - tail, counts + 1, left), 1.0)
    return low, high


def sign_test(ones: NDArray[np.int64], others: NDArray[np.int64]) -> Array:
    """Return the two-sided p-value of the exact test that both outcomes are equally likely.

    The exact test of McNemar: of pairs that differ, the `ones` are binomial with 1/2.
    """
    found = [
        binomtest(int(one), int(one + other)).pvalue if one + other else 1.0
        for one, other in zip(ones.ravel(), others.ravel(), strict=True)
    ]
    return np.array(found, dtype=float).reshape(ones.shape)


def _resampled(name: str, dims: tuple[str, ...], values: Array, confidence: float) -> Variables:
    keys = (name, f"{name}_low", f"{name}_high")
    found = interval(values, confidence)
    return {key: (dims, number) for key, number in zip(keys, found, strict=True)}


def _words(found: Variables, name: str) -> NDArray[np.object_]:
    low, high = (np.asarray(found[f"{name}_{end}"][1]) for end in ("low", "high"))
    words = [
        in_words(*ends) if np.isfinite(ends).all() else UNKNOWN
        for ends in zip(low.ravel().tolist(), high.ravel().tolist(), strict=True)
    ]
    return np.array(words, dtype=object).reshape(low.shape)


def _reasons(
    reasons: Sequence[str], values: Array, found: Variables, name: str
) -> NDArray[np.object_]:
    """Return the reason of each value that is NaN, or of an end of its interval that is NaN."""
    resamples = len(values) - 1
    ends = np.array([found[f"{name}_{end}"][1] for end in ("low", "high")])
    missing = np.isnan(values[1:]).sum(axis=0)
    said = [
        reason
        if reason or np.isfinite(both).all()
        else "no resample differs from the one motion"
        if count == resamples
        else f"{count} of {resamples} resamples have no {name.replace('_', ' ')}"
        for reason, both, count in zip(reasons, ends.T, missing, strict=True)
    ]
    return np.array(said, dtype=object)
