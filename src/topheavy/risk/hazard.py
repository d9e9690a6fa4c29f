"""The mean annual rate of overturning under a hazard that falls as a power of the intensity.

The intensity s is exceeded at the rate s⁻ᵏ, in units of the rate at s = 1. A motion that overturns
a structure from a to b then contributes a⁻ᵏ − b⁻ᵏ: no curve is fitted to the outcomes.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def rate_at_levels(
    levels: ArrayLike, exponent: float, ends: tuple[float, float] = (0.0, math.inf)
) -> Array:
    """Return the rate at which the intensity is nearest to each level, in equal ratios.

    The outcome of a motion is taken to change midway, in ln s, between two levels of unlike
    outcome. The sum of these rates over the levels that overturn is then Σ (a⁻ᵏ − b⁻ᵏ) of the
    motion; of probabilities in place of outcomes it is the mean over motions. At the lowest level
    the intensity counts from that level on; at the highest, to the end.

    Parameters
    ----------
    levels : array_like, shape (n,)
        Of the intensity: positive and ascending.
    exponent : float
        k, more than 0.
    ends : (float, float)
        Intensities below the first and above the second do not occur.

    Returns
    -------
    ndarray, shape (n,)
        In units of the rate at which the intensity exceeds 1.

    Raises
    ------
    ValueError
        For an exponent that is not positive, and ends that are not ascending.
    """
    if not 0.0 < exponent < math.inf:
        raise ValueError(f"exponent is {exponent:g}; expected more than zero, for example 2")
    low, high = ends
    if not 0.0 <= low < high:
        raise ValueError(f"ends are {low:g} and {high:g}; expected ascending intensities")
    found = np.asarray(levels, dtype=float)
    edges = np.concatenate([found[:1], np.sqrt(found[1:] * found[:-1]), [math.inf]])
    exceeded = np.clip(edges, low, high) ** -exponent
    return np.asarray(exceeded[:-1] - exceeded[1:])
