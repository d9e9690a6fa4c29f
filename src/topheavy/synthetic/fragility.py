"""The names by which the studies know `topheavy.fragility`; a curve without a median is an error.

A study publishes every value that it computes: it would publish NaN.
"""

from topheavy.fragility import curve as _curve
from topheavy.fragility.curve import curve, points_between
from topheavy.fragility.gain import mass_ratio_of_share, mass_ratios_of_gain, share_of_size
from topheavy.fragility.resampling import (
    BLOCK,
    NEGATIVE,
    POSITIVE,
    Array,
    ResampledMeans,
    in_words,
    interval,
    means,
    resampled,
)

__all__ = [
    "BLOCK",
    "NEGATIVE",
    "POSITIVE",
    "ResampledMeans",
    "curve",
    "fit",
    "in_words",
    "interval",
    "mass_ratio_of_share",
    "mass_ratios_of_gain",
    "means",
    "medians",
    "resampled",
    "share_of_size",
]


def fit(levels: Array, probabilities: Array) -> Array:
    """Return the likeliest skewed curves as (a, b, c), shape (..., 3).

    Raises
    ------
    ValueError
        For a curve that has not three points between 0 and 1: nothing can be fitted.
    ArithmeticError
        Where the fit does not converge.
    """
    if (points_between(probabilities) < 3).any():
        raise ValueError("a fragility curve steps from 0 to 1; expected three points between them")
    terms = _curve.fit(levels, probabilities, skewed=True)
    if not (terms == terms).all():
        raise ArithmeticError(f"no fit of the fragility curves in {_curve.MOST_PASSES} passes")
    return terms


def medians(levels: Array, probabilities: Array) -> Array:
    """Return the median capacities, shape (...), of shares that overturn, shape (..., n).

    Raises
    ------
    ValueError
        When a curve does not pass 1/2 within the levels.
    """
    terms = fit(levels, probabilities)
    if not (_curve.medians(levels, terms) > 0.0).all():
        found = _curve.rises_past(0.5, terms)
        raise ValueError(
            f"a fragility curve passes 1/2 at {found.min():.3g} to {found.max():.3g}; expected it "
            f"between {levels[0]:.3g} and {levels[-1]:.3g}: widen the intensities"
        )
    return _curve.medians(levels, terms)
