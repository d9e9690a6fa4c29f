"""Means of resampled motions and their intervals, by groups and with values that are missing."""

import math

import numpy as np
import pytest
from scipy.stats import bootstrap

from topheavy.risk import resampling
from topheavy.risk.resampling import (
    in_words,
    interval,
    means_within,
)


def test_means_by_blocks_scatter_as_those_of_all_weights(monkeypatch):
    """Motions of the first blocks fall more often; a resample draws 400, of whichever blocks."""
    monkeypatch.setattr(resampling, "BLOCK", 70)
    fell = np.arange(400)[:, None] < [40, 200]
    means = means_within(fell, [None] * 400, 4000, 1)
    assert means[0] == pytest.approx([0.1, 0.5], rel=1e-12)
    assert means[1:].mean(axis=0) == pytest.approx([0.1, 0.5], abs=2e-3)
    assert means[1:].std(axis=0) == pytest.approx(np.sqrt([0.09 / 400, 0.25 / 400]), rel=0.05)
    everything = means_within(np.ones(400), [None] * 400, 20, 1)
    assert everything == pytest.approx(np.ones(21), rel=1e-12)


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
    assert in_words(low, high) == words


@pytest.mark.parametrize(("low", "high"), [(0.2, 0.1), (math.nan, 0.1), (0.1, math.nan)])
def test_ends_in_the_wrong_order_have_no_words(low, high):
    with pytest.raises(ValueError, match="expected ascending ends"):
        in_words(low, high)


def test_equal_counts_are_equal():
    """Sums of weights depend on their order, and a difference of nothing would have a sign."""
    fell = np.random.default_rng(2).permuted(np.tile([[1], [0]], (49, 6)), axis=0)
    assert not np.diff(means_within(fell, [None] * 98, 10, 1)[0]).any()
    assert (means_within(np.ones(49), [None] * 49, 50, 1) == 1.0).all()


def test_groups_are_resampled_independently_of_each_other():
    """If both drew the same, their shares would vary together: the variance would be doubled."""
    fell, groups = np.tile([1.0, 0.0], 200), ["a"] * 200 + ["b"] * 200
    drawn = means_within(fell, groups, 4000, 1)[1:]
    assert drawn.std() == pytest.approx(np.sqrt(0.25 / 400), rel=0.05)


def test_group_in_blocks_scatters_as_a_whole(monkeypatch):
    monkeypatch.setattr(resampling, "BLOCK", 30)
    fell, groups = np.arange(200) % 2, ["a"] * 100 + ["b"] * 100
    drawn = means_within(fell, groups, 4000, 1)
    assert drawn[0] == pytest.approx(0.5)
    assert drawn[1:].std() == pytest.approx(np.sqrt(0.25 / 200), rel=0.05)


def test_paired_interval_is_that_of_scipy():
    """The second route: SciPy draws motions, and leaves the two structures of a motion together."""
    random = np.random.default_rng(8)
    first = random.random(60) < 0.5
    second = np.where(random.random(60) < 0.8, first, random.random(60) < 0.3)
    both = np.stack([first, second], axis=1).astype(float)
    drawn = means_within(both, [None] * 60, 20000, 1)
    value, *ends = interval(drawn[:, 0] - drawn[:, 1], 0.95)
    assert value == pytest.approx(first.mean() - second.mean())
    other = bootstrap(
        both.T,
        lambda x, y, axis: x.mean(axis=axis) - y.mean(axis=axis),
        paired=True,
        vectorized=True,
        n_resamples=20000,
        confidence_level=0.95,
        method="percentile",
        rng=np.random.default_rng(2),
    )
    assert ends == pytest.approx(list(other.confidence_interval), abs=1.01 / 60)  # of one motion
    assert drawn[1:].std(axis=0) == pytest.approx(both.std(axis=0) / np.sqrt(60), rel=0.03)
    assert (drawn[1:, 0] - drawn[1:, 1]).std() == pytest.approx(other.standard_error, rel=0.03)


def test_interval_within_groups_is_that_of_scipy():
    random = np.random.default_rng(9)
    parts = [random.random(25) < 0.1, random.random(40) < 0.7, random.random(35) < 0.95]
    fell, groups = np.concatenate(parts).astype(float), np.repeat(["a", "b", "c"], [25, 40, 35])
    drawn = means_within(fell, groups.tolist(), 20000, 1)
    other = bootstrap(
        [part.astype(float) for part in parts],
        lambda *each, axis: sum(one.sum(axis=axis) for one in each) / 100.0,
        vectorized=True,
        n_resamples=20000,
        confidence_level=0.9,
        method="percentile",
        rng=np.random.default_rng(2),
    )
    assert interval(drawn, 0.9)[1:] == pytest.approx(list(other.confidence_interval), abs=0.0101)
    assert drawn[1:].std() == pytest.approx(other.standard_error, rel=0.03)


def test_resamples_without_a_value_count_at_both_ends():
    values = np.concatenate([[50.0], np.arange(101.0)])
    values[[10, 40]] = np.nan
    _, low, high = interval(values, 0.9)
    rest = np.delete(np.arange(101.0), [9, 39])
    assert low == pytest.approx(np.quantile(np.concatenate([[-1e9, -1e9], rest]), 0.05))
    assert high == pytest.approx(np.quantile(np.concatenate([rest, [1e9, 1e9]]), 0.95))
    assert low < np.quantile(rest, 0.05)
    assert high > np.quantile(rest, 0.95)
