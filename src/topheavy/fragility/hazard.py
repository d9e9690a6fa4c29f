"""The mean annual rate of overturning under a hazard that falls as a power of the intensity.

The intensity s is exceeded at the rate s⁻ᵏ, in units of the rate at s = 1. A motion that overturns
a structure from a to b then contributes a⁻ᵏ − b⁻ᵏ: no curve is fitted to the outcomes.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr

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
    low, high = _checked(exponent, ends)
    found = np.asarray(levels, dtype=float)
    edges = np.concatenate([found[:1], np.sqrt(found[1:] * found[:-1]), [math.inf]])
    exceeded = np.clip(edges, low, high) ** -exponent
    return np.asarray(exceeded[:-1] - exceeded[1:])


def lognormal_rate(
    median: ArrayLike,
    dispersion: ArrayLike,
    exponent: float,
    ends: tuple[float, float] = (0.0, math.inf),
) -> Array:
    """Return the rate of overturning of lognormal fragility curves, in closed form.

    With all intensities it is θ⁻ᵏ exp(k² β²/2), θ the median and β the dispersion (Cornell et al.
    2002, J. Struct. Eng. 128(4), 526–533, from memory). Units, exponent, ends, and errors as of
    `rate_at_levels`; the ends cut the integral of the curve by parts.
    """
    low, high = _checked(exponent, ends)
    theta, beta = np.asarray(median, dtype=float), np.asarray(dispersion, dtype=float)
    whole = theta**-exponent * np.exp(0.5 * (exponent * beta) ** 2)

    def integral(end: float) -> Array:
        """Return ∫ s⁻ᵏ dP − s⁻ᵏ P from 0 to an end."""
        if end == 0.0:
            return np.zeros_like(whole)
        far = (math.log(end) - np.log(theta)) / beta
        return np.asarray(whole * ndtr(far + exponent * beta) - end**-exponent * ndtr(far))

    return integral(high) - integral(low)


def _checked(exponent: float, ends: tuple[float, float]) -> tuple[float, float]:
    if not 0.0 < exponent < math.inf:
        raise ValueError(f"exponent is {exponent:g}; expected more than zero, for example 2")
    low, high = ends
    if not 0.0 <= low < high:
        raise ValueError(f"ends are {low:g} and {high:g}; expected ascending intensities")
    return low, high
