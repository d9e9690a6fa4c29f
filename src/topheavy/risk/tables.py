"""Curves of structures and differences of pairs, with intervals, as labelled arrays.

In every `means` and `terms` the first axis holds the ensemble and then its resamples.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import beta, binomtest

from topheavy.risk.curve import curve, dispersions, medians
from topheavy.risk.resampling import interval

if TYPE_CHECKING:
    import xarray

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
    """
    import xarray  # it imports pandas, a second that only tables need

    low, high = exact_interval(overturned, motions, confidence)
    at, one = ("structure", "level"), ("structure",)
    variables: Variables = {
        "overturned": (at, overturned),
        "probability": (at, overturned / motions),
        "probability_low": (at, low),
        "probability_high": (at, high),
        "fitted": (at, curve(levels, terms[0])),
        "terms": (("structure", "term"), terms[0]),
    }
    variables |= _resampled("median_capacity", one, medians(levels, terms), confidence)
    variables |= _resampled("dispersion", one, dispersions(terms), confidence)
    return xarray.Dataset(variables, {"term": list("abc")})


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
    variables: Variables = {
        "only_first": (at, only_first),
        "only_second": (at, only_second),
        "sign_test": (at, sign_test(only_first, only_second)),
    }
    variables |= _resampled("less", at, means[:, first] - means[:, second], confidence)
    variables |= _resampled("gain", one, gain, confidence)
    return xarray.Dataset(variables)


def exact_interval(
    counts: NDArray[np.int64], trials: int, confidence: float
) -> tuple[Array, Array]:
    """Return the exact interval of a probability from counts (Clopper & Pearson 1934).

    `trials` is the number of trials of each count; both ends have the shape of the counts.
    """
    tail, left = 0.5 * (1.0 - confidence), trials - counts
    low = np.where(counts > 0, beta.ppf(tail, counts, left + 1), 0.0)
    high = np.where(left > 0, beta.ppf(1.0 - tail, counts + 1, left), 1.0)
    return low, high


def sign_test(ones: NDArray[np.int64], others: NDArray[np.int64]) -> Array:
    """Return the two-sided p-value of the exact test that both outcomes are equally likely.

    The exact test of McNemar: of pairs that differ, the `ones` are binomial with 1/2.
    """
    p_values = [
        binomtest(int(one), int(one + other)).pvalue if one + other else 1.0
        for one, other in zip(ones.ravel(), others.ravel(), strict=True)
    ]
    return np.array(p_values, dtype=float).reshape(ones.shape)


def _resampled(name: str, dims: tuple[str, ...], values: Array, confidence: float) -> Variables:
    keys = (name, f"{name}_low", f"{name}_high")
    return {key: (dims, x) for key, x in zip(keys, interval(values, confidence), strict=True)}
