"""Fragility and its intervals, where the answer is known."""

import math

import numpy as np
import pytest
from scipy.special import ndtr

from topheavy.synthetic import fragility

LEVELS = np.geomspace(0.5, 2.0, 9)
RATIOS = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, math.inf]


def test_first_row_is_the_ensemble_and_others_scatter_as_a_binomial():
    fell = np.arange(400)[:, None] < [40, 200]
    means = fragility.means(fragility.resampled(400, 4000, 1), fell)
    assert means[0] == pytest.approx([0.1, 0.5], rel=1e-12)
    assert means[1:].mean(axis=0) == pytest.approx([0.1, 0.5], abs=2e-3)
    assert means[1:].std(axis=0) == pytest.approx(np.sqrt([0.09 / 400, 0.25 / 400]), rel=0.05)


def test_structures_that_fall_together_fall_together_in_every_resample():
    fell = np.random.default_rng(3).random(50) < 0.5
    means = fragility.means(fragility.resampled(50, 20, 1), np.stack([fell, ~fell], axis=1))
    assert np.ptp(means[:, 0]) > 0.05
    assert means.sum(axis=1) == pytest.approx(np.ones(21))


def in_blocks(sizes, *outcomes, resamples=20):
    found = fragility.ResampledMeans(len(outcomes[0]), resamples, 1)
    for part in np.split(np.arange(len(outcomes[0])), np.cumsum(sizes)):
        found.add([each[part] for each in outcomes])
    return found.means()


def test_means_of_a_single_block_are_those_of_all_weights():
    random = np.random.default_rng(5)
    fell, first = random.random((50, 3, 2)) < 0.3, random.random(50) < 0.5
    weights = fragility.resampled(50, 20, 1)
    found = in_blocks([], fell, first)
    assert found[0] == pytest.approx(fragility.means(weights, fell), rel=1e-14)
    assert found[1] == pytest.approx(fragility.means(weights, first), rel=1e-14)


def test_means_by_blocks_scatter_as_those_of_all_weights():
    """Motions of the first block fall more often; each resample draws 400, of whichever blocks."""
    fell = np.arange(400)[:, None] < [40, 200]
    (means,) = in_blocks([30, 170, 1], fell, resamples=4000)
    assert means[0] == pytest.approx([0.1, 0.5], rel=1e-12)
    assert means[1:].mean(axis=0) == pytest.approx([0.1, 0.5], abs=2e-3)
    assert means[1:].std(axis=0) == pytest.approx(np.sqrt([0.09 / 400, 0.25 / 400]), rel=0.05)
    (everything,) = in_blocks([30, 170, 1], np.ones(400))
    assert everything == pytest.approx(np.ones(21), rel=1e-12)


def test_missing_motions_are_missed():
    found = fragility.ResampledMeans(50, 20, 1)
    found.add([np.ones(49)])
    with pytest.raises(ValueError, match="49 motions were found; expected those of 50"):
        found.means()


def test_interval_holds_the_middle_of_the_resamples():
    values = np.concatenate([[5.0], np.arange(101.0)])
    assert fragility.interval(values, 0.9) == pytest.approx((5.0, 5.0, 95.0))


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (0.01, 0.03, "is positive"),
        (-0.08, -0.05, "is negative"),
        (-0.01, 0.03, "includes zero"),
        (0.0, 0.03, "includes zero"),
        (-0.03, 0.0, "includes zero"),
    ],
)
def test_words_name_the_sign_of_the_whole_interval(low, high, words):
    assert fragility.in_words(low, high) == words


@pytest.mark.parametrize(("low", "high"), [(0.2, 0.1), (math.nan, 0.1), (0.1, math.nan)])
def test_ends_in_the_wrong_order_have_no_words(low, high):
    with pytest.raises(ValueError, match="expected ascending ends"):
        fragility.in_words(low, high)


def test_lognormal_curve_is_found_again():
    centre, spread = np.array([0.8, 1.1]), np.array([0.3, 0.6])
    curves = ndtr(np.log(LEVELS / centre[:, None]) / spread[:, None])
    terms = np.stack([-np.log(centre) / spread, 1.0 / spread, np.zeros(2)], axis=1)
    assert fragility.fit(LEVELS, curves) == pytest.approx(terms, abs=1e-6)
    assert fragility.medians(LEVELS, curves) == pytest.approx(centre, rel=1e-7)


@pytest.mark.parametrize("bend", [-0.8, 0.8])
def test_median_of_a_skewed_curve_is_where_it_passes_a_half(bend):
    x = np.log(LEVELS / 0.9)
    assert fragility.medians(LEVELS, ndtr(2.0 * x + bend * x**2)) == pytest.approx(0.9, rel=1e-7)


def test_no_curve_nearby_is_likelier():
    share = np.array([0.0, 0.05, 0.2, 0.15, 0.55, 0.7, 0.95, 0.9, 1.0])

    def log_likelihood(terms):
        fit = fragility.curve(LEVELS, terms)
        return (share * np.log(fit) + (1.0 - share) * np.log1p(-fit)).sum()

    terms = fragility.fit(LEVELS, share)
    for term in range(3):
        for off in (-0.02, 0.02):
            assert log_likelihood(terms + off * np.eye(3)[term]) < log_likelihood(terms)


def test_step_is_not_fitted():
    with pytest.raises(ValueError, match="expected three points between"):
        fragility.fit(LEVELS, np.repeat([0.0, 0.5, 1.0], [4, 1, 4]))


@pytest.mark.parametrize("centre", [0.4, 2.5])
def test_curve_that_does_not_pass_a_half_is_refused(centre):
    with pytest.raises(ValueError, match="widen the intensities"):
        fragility.medians(LEVELS, ndtr(np.log(LEVELS / centre) / 0.5))


def test_share_of_size_is_that_of_equation_24():
    ratios = [(1 + 3 * gamma) / (1 + 2 * gamma) for gamma in RATIOS[:-1]] + [1.5]
    assert 1.0 + fragility.share_of_size(RATIOS) / 2.0 == pytest.approx(ratios)


def test_share_of_the_gain_of_size_alone():
    medians = 1.0 + fragility.share_of_size(RATIOS) / 2.0  # as R̂ itself: γ/(1 + 2γ) is the gain
    found = fragility.mass_ratios_of_gain(RATIOS, medians, [0.5, 0.9])
    assert found == pytest.approx([0.5, 4.5])


def test_share_of_a_bent_gain_solves_its_parabola():
    x = fragility.share_of_size(RATIOS)
    medians = np.stack([1.0 + 0.3 * x - 0.1 * x**2, 2.0 + 0.2 * x])
    found = fragility.mass_ratios_of_gain(RATIOS, medians, [0.5])[:, 0]
    at = fragility.share_of_size(found)
    assert 0.3 * at[0] - 0.1 * at[0] ** 2 == pytest.approx(0.1)
    assert found[1] == pytest.approx(0.5)
