"""The share of a gain in median capacity over the mass ratio γ of the cap beam."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


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
    return np.asarray(0.5 * at / (1.0 - at))
