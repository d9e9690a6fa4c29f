"""Fragility curves, and intervals of what was sampled."""

import math

import numpy as np
import pytest
import scipy
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

from topheavy.risk import curve as module
from topheavy.risk import fragility, resampling
from topheavy.risk.curve import curve, dispersions, fit, medians, rises_past
from topheavy.risk.fragility import exact_interval, sign_test
from topheavy.risk.resampling import Ensemble, interval

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
    direct = by_direct_maximisation(levels, shares, 3 if skewed else 2)
    gain = log_likelihood(direct, levels, shares) - log_likelihood(terms, levels, shares)
    assert gain < 1e-12
    assert curve(levels, terms) == pytest.approx(
        ndtr(np.polynomial.polynomial.polyval(np.log(levels), direct)), abs=1e-5
    )


@BOTH
def test_every_curve_with_enough_points_is_fitted_however_wide_the_levels(skewed):
    """Undamped passes diverge for many of these: their steep curves are flat at most levels."""
    random, levels = np.random.default_rng(3), np.geomspace(0.01, 30.0, 40)
    spread = random.choice([0.02, 0.1, 0.5], (600, 1, 1))
    middle = np.exp(random.uniform(-4.0, 3.0, (600, 1, 1)))
    fell = middle * np.exp(spread * random.normal(size=(600, 20, 1))) <= levels
    noise = random.random(fell.shape) < random.choice([0.0, 0.1], (600, 1, 1))
    shares = (fell ^ noise).mean(axis=1)
    enough = module.points_between(shares) >= (3 if skewed else 2)
    assert enough.sum() > 300
    assert (np.isfinite(fit(levels, shares, skewed=skewed)).all(axis=-1) == enough).all()


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
        ([0, 0, 0.5, 1, 1], False),
        ([0, 0.3, 0.5, 1, 1], True),
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


def test_means_by_blocks_scatter_as_those_of_all_weights(monkeypatch):
    """Motions of the first blocks fall more often; a resample draws 400, of whichever blocks."""
    monkeypatch.setattr(resampling, "MOTIONS_PER_BLOCK", 70)
    fell = np.arange(400)[:, None] < [40, 200]
    means = Ensemble(fell, None, 4000, 1, 0.95).means()
    assert means[0] == pytest.approx([0.1, 0.5], rel=1e-12)
    assert means[1:].mean(axis=0) == pytest.approx([0.1, 0.5], abs=2e-3)
    assert means[1:].std(axis=0) == pytest.approx(np.sqrt([0.09 / 400, 0.25 / 400]), rel=0.05)
    everything = Ensemble(np.ones(400), None, 20, 1, 0.95).means()
    assert everything == pytest.approx(np.ones(21), rel=1e-12)


def test_paired_interval_is_that_of_scipy():
    """SciPy draws motions, and leaves the two structures of a motion together."""
    random = np.random.default_rng(8)
    first = random.random(60) < 0.5
    second = np.where(random.random(60) < 0.8, first, random.random(60) < 0.3)
    outcomes = np.stack([first, second], axis=1).astype(float)
    means = Ensemble(outcomes, None, 20000, 1, 0.95).means()
    value, *ends = interval(means[:, 0] - means[:, 1], 0.95)
    assert value == pytest.approx(first.mean() - second.mean())
    expected = scipy.stats.bootstrap(
        outcomes.T,
        lambda x, y, axis: x.mean(axis=axis) - y.mean(axis=axis),
        paired=True,
        vectorized=True,
        n_resamples=20000,
        confidence_level=0.95,
        method="percentile",
        rng=np.random.default_rng(2),
    )
    assert ends == pytest.approx(list(expected.confidence_interval), abs=1.01 / 60)  # of one motion
    assert means[1:].std(axis=0) == pytest.approx(outcomes.std(axis=0) / np.sqrt(60), rel=0.03)
    assert (means[1:, 0] - means[1:, 1]).std() == pytest.approx(expected.standard_error, rel=0.03)


def test_interval_within_groups_is_that_of_scipy():
    random = np.random.default_rng(9)
    parts = [random.random(25) < 0.1, random.random(40) < 0.7, random.random(35) < 0.95]
    fell, groups = np.concatenate(parts).astype(float), np.repeat(["a", "b", "c"], [25, 40, 35])
    means = Ensemble(fell, groups.tolist(), 20000, 1, 0.9).means()
    expected = scipy.stats.bootstrap(
        [part.astype(float) for part in parts],
        lambda *samples, axis: sum(sample.sum(axis=axis) for sample in samples) / 100.0,
        vectorized=True,
        n_resamples=20000,
        confidence_level=0.9,
        method="percentile",
        rng=np.random.default_rng(2),
    )
    assert interval(means, 0.9)[1:] == pytest.approx(list(expected.confidence_interval), abs=0.0101)
    assert means[1:].std() == pytest.approx(expected.standard_error, rel=0.03)


def test_resamples_without_a_value_count_at_both_ends():
    values = np.concatenate([[50.0], np.arange(101.0)])
    values[[10, 40]] = np.nan
    _, low, high = interval(values, 0.9)
    rest = np.delete(np.arange(101.0), [9, 39])
    assert low == pytest.approx(np.quantile(np.concatenate([[-1e9, -1e9], rest]), 0.05))
    assert high == pytest.approx(np.quantile(np.concatenate([rest, [1e9, 1e9]]), 0.95))
    assert low < np.quantile(rest, 0.05)
    assert high > np.quantile(rest, 0.95)


def test_ends_are_unknown_where_the_value_of_the_ensemble_is():
    values = np.tile(np.arange(101.0)[:, None], 2)
    values[1, 0] = values[0, 1] = np.nan
    _, low, high = interval(values, 0.5)
    assert np.isfinite([low, high]).tolist() == [[True, False]] * 2


GRID = np.geomspace(0.25, 4.0, 25)


def outcomes_of(capacities, levels=GRID):
    """Each motion overturns a structure from its capacity on: (motions, structures, levels)."""
    return np.asarray(capacities, dtype=float)[..., None] <= levels


def tables(capacities, levels=GRID):
    ensemble = Ensemble(outcomes_of(capacities, levels), None, 400, 1, 0.95)
    return fragility.tables(ensemble, levels, skewed=False)[:2]


def lognormal(motions, seed, *factors):
    """Capacities of structures under the same motions, with the dispersion 0.4 about factors."""
    return np.exp(0.4 * np.random.default_rng(seed).normal(size=(motions, 1))) * factors


def test_curve_of_a_table_is_that_of_the_ensemble():
    capacities = lognormal(40, 3, 1.0, 1.5)
    curves, _ = tables(capacities)
    expected = fit(GRID, outcomes_of(capacities).mean(axis=0), skewed=False)
    terms = [curves[f"term_{name}"] for name in "abc"]
    np.testing.assert_allclose(np.transpose(terms), expected, atol=1e-9)
    np.testing.assert_allclose(curves.fitted, curve(GRID, expected), atol=1e-9)


@pytest.mark.parametrize("confidence", [0.9, 0.95])
def test_exact_interval_has_half_of_the_rest_on_each_side(confidence):
    counts = np.arange(13).reshape(1, 13)
    low, high = exact_interval(counts, 12, confidence)
    tail = (1.0 - confidence) / 2.0
    assert scipy.stats.binom.sf(counts - 1, 12, low)[counts > 0] == pytest.approx(tail, rel=1e-6)
    assert scipy.stats.binom.cdf(counts, 12, high)[counts < 12] == pytest.approx(tail, rel=1e-6)
    assert (low[0, 0], high[0, -1]) == (0.0, 1.0)
    assert low[0, 1:] == pytest.approx(
        scipy.stats.beta.ppf(tail, counts[0, 1:], 13 - counts[0, 1:])
    )


def test_sign_test_is_exact():
    p_values = sign_test(np.array([[5, 0], [4, 3]]), np.array([[0, 0], [1, 3]]))
    assert p_values == pytest.approx(np.array([[2 / 32, 1.0], [12 / 32, 1.0]]))


@pytest.mark.sampled(0)
@pytest.mark.parametrize(("motions", "median", "dispersion"), [(7, 0.11, 0.32), (40, 0.08, 0.13)])
def test_intervals_miss_the_true_value_as_often_as_the_docstring_says(motions, median, dispersion):
    missed, samples = np.zeros(2), 400
    for seed in range(samples):
        fell = outcomes_of(lognormal(motions, [1, seed], 1.0)[:, 0])
        terms = fit(GRID, Ensemble(fell, None, 300, seed, 0.95).means(), skewed=False)
        for place, (values, true) in enumerate(
            ((medians(GRID, terms), 1.0), (dispersions(terms), 0.4))
        ):
            _, low, high = interval(values, 0.95)
            missed[place] += low > true or high < true
    assert missed / samples == pytest.approx([median, dispersion], abs=0.045)


def test_second_that_is_stronger_has_less_probability_and_a_gain():
    _, pairs = tables(lognormal(60, 3, 1.0, 1.25, 1.0))  # pairs of one with two and three, of both
    assert pairs.gain.to_numpy() == pytest.approx([0.25, 0.0, -0.2], abs=0.03)
    assert pairs.gain_low.to_numpy()[0] > 0.0 > pairs.gain_high.to_numpy()[2]
    assert (pairs.gain_low[1], pairs.gain_high[1]) == (0.0, 0.0)
    middle = pairs.isel(level=12)
    assert middle.less_low.to_numpy()[0] > 0.0 > middle.less_high.to_numpy()[2]
    assert middle.less.to_numpy()[0] == -middle.less.to_numpy()[2] > 0.1
    np.testing.assert_array_equal(pairs.only_first[0], pairs.only_second[2])
    assert not pairs.only_second[0].any()
    assert pairs.only_first[0].to_numpy() == pytest.approx(60 * pairs.less[0].to_numpy())
    ends = (pairs.less_low, pairs.less_high)
    assert (ends[0] <= pairs.less).all()
    assert (pairs.less <= ends[1]).all()


def test_paired_structures_are_compared_under_the_same_motions():
    """Motions differ much more than the structures: unpaired, no difference would be seen."""
    random = np.random.default_rng(5)
    capacities = np.exp(random.normal(size=(40, 1))) * [1.0, 1.1]
    _, pairs = tables(capacities)
    assert pairs.gain_low.item() > 0.0
    assert pairs.gain_high.item() - pairs.gain_low.item() < 0.3
    assert (pairs.less_high - pairs.less_low).max() < 0.25
    apart = capacities.copy()
    random.shuffle(apart[:, 1])
    shuffled = tables(apart)[1]
    assert shuffled.gain_low.item() < 0.0 < shuffled.gain_high.item()
