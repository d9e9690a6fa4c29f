"""Fragility curves."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

from topheavy.risk import curve as module
from topheavy.risk.curve import curve, dispersions, fit, medians, rises_past

LEVELS = np.geomspace(0.5, 2.0, 9)
WIDE = np.geomspace(0.1, 4.0, 12)
BOTH = pytest.mark.parametrize("skewed", [False, True])


def log_likelihood(terms, levels, shares):
    line = np.polynomial.polynomial.polyval(np.log(levels), terms)
    return float((shares * log_ndtr(line) + (1.0 - shares) * log_ndtr(-line)).sum())


def by_direct_maximisation(levels, shares, number):
    """The likelihood itself is maximised by the simplex of Nelder and Mead, then BFGS."""

    def less(terms):
        return -log_likelihood(terms, levels, shares)

    options = {"maxiter": 20000, "maxfev": 20000, "xatol": 1e-10, "fatol": 1e-14}
    rough = minimize(less, np.eye(number)[1], method="Nelder-Mead", options=options)
    return minimize(less, rough.x, method="BFGS", options={"gtol": 1e-9}).x


@BOTH
@pytest.mark.parametrize(
    ("levels", "shares"),
    [
        pytest.param(LEVELS, [0, 0.05, 0.2, 0.15, 0.55, 0.7, 0.95, 0.9, 1], id="regular"),
        pytest.param(WIDE, np.array([0, 0, 0, 0, 0, 0, 1, 1, 6, 7, 7, 7]) / 7, id="wide"),
        pytest.param(WIDE, np.array([0, 3, 0, 5, 1, 0, 7, 2, 3, 7, 4, 7]) / 7, id="ragged"),
        pytest.param(WIDE, np.array([0, 0, 0, 0, 1, 0, 0, 4, 6, 7, 7, 7]) / 7, id="outlier"),
        pytest.param(WIDE, np.array([1, 0, 0, 0, 0, 2, 7, 10, 10, 10, 10, 9]) / 10, id="slow"),
        pytest.param(WIDE, 1 - np.array([0, 1, 2, 2, 3, 4, 5, 5, 6, 7, 7, 7]) / 7, id="falling"),
    ],
)
def test_fit_is_that_of_direct_maximisation(levels, shares, skewed):
    shares = np.array(shares, dtype=float)
    terms = fit(levels, shares, skewed=skewed)
    other = by_direct_maximisation(levels, shares, 3 if skewed else 2)
    gain = log_likelihood(other, levels, shares) - log_likelihood(terms, levels, shares)
    assert gain < 1e-12
    assert curve(levels, terms) == pytest.approx(
        ndtr(np.polynomial.polynomial.polyval(np.log(levels), other)), abs=1e-5
    )


def test_lognormal_curve_is_found_again():
    centre, spread = np.array([0.8, 1.1]), np.array([0.3, 0.6])
    shares = ndtr(np.log(LEVELS / centre[:, None]) / spread[:, None])
    for skewed in (False, True):
        terms = fit(LEVELS, shares, skewed=skewed)
        assert medians(LEVELS, terms) == pytest.approx(centre, rel=1e-7)
        assert dispersions(terms) == pytest.approx(spread, rel=1e-6)
    assert (fit(LEVELS, shares, skewed=False)[:, 2] == 0.0).all()


@pytest.mark.parametrize(
    "terms", [(0.3, 2.0, 0.5), (0.3, -1.0, 2.0), (-1.0, -2.0, -0.9), (0.2, 0.3, -1.0)]
)
@pytest.mark.parametrize("share", [0.16, 0.5, 0.84])
def test_rise_past_a_share_is_where_the_curve_crosses_it_upwards(terms, share):
    x = np.linspace(-12.0, 12.0, 2_400_001)
    over = ndtr(np.polynomial.polynomial.polyval(x, terms)) > share
    rises = np.flatnonzero(~over[:-1] & over[1:])
    intensity = rises_past(share, np.array(terms))
    if rises.size:
        assert np.log(intensity) == pytest.approx(x[rises[0]], abs=2e-5)
    else:
        assert math.isnan(intensity)


@pytest.mark.parametrize(
    ("shares", "skewed"),
    [
        ([0, 0, 0, 0, 0], False),
        ([1, 1, 1, 1, 1], False),
        ([0, 0, 0.5, 1, 1], False),
        ([0, 0.3, 0.5, 1, 1], True),
        ([0, 0.5, 1 - 1e-16, 1, 1], False),
        ([1, 0, 1, 0, 1], False),
    ],
)
def test_too_few_points_have_no_fit(shares, skewed):
    levels, shares = np.geomspace(0.5, 2.0, 5), np.array(shares, dtype=float)
    terms = fit(levels, shares, skewed=skewed)
    assert np.isnan(terms).all()
    assert np.isnan(curve(levels, terms)).all()
    assert np.isnan(dispersions(terms))
    assert np.isnan(medians(levels, terms))


@pytest.mark.parametrize("centre", [0.4, 2.5])
def test_median_outside_the_levels_is_not_given(centre):
    shares = ndtr(np.log(LEVELS / centre) / 0.5)
    terms = fit(LEVELS, shares, skewed=False)
    assert np.isnan(medians(LEVELS, terms))
    assert dispersions(terms) == pytest.approx(0.5, rel=1e-6)


def test_fit_without_convergence_is_nan(monkeypatch):
    monkeypatch.setattr(module, "MAX_PASSES", 1)
    shares = np.array([[0, 0, 0.05, 0, 0, 0, 0.95, 1, 1], ndtr(np.log(LEVELS))])
    terms = fit(LEVELS, shares, skewed=False)
    assert np.isnan(terms).all(axis=-1).tolist() == [True, False]
