"""The share of a gain over the mass ratio, where the answer is known."""

import math

import numpy as np
import pytest

from topheavy.risk.gain import mass_ratios_of_gain, share_of_size

RATIOS = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, math.inf]


def test_share_of_size_is_that_of_equation_24():
    ratios = [(1 + 3 * gamma) / (1 + 2 * gamma) for gamma in RATIOS[:-1]] + [1.5]
    assert 1.0 + share_of_size(RATIOS) / 2.0 == pytest.approx(ratios)


def test_share_of_the_gain_of_size_alone():
    medians = 1.0 + share_of_size(RATIOS) / 2.0  # as R̂ itself: γ/(1 + 2γ) is the gain
    found = mass_ratios_of_gain(RATIOS, medians, [0.5, 0.9])
    assert found == pytest.approx([0.5, 4.5])


def test_share_of_a_bent_gain_solves_its_parabola():
    x = share_of_size(RATIOS)
    medians = np.stack([1.0 + 0.3 * x - 0.1 * x**2, 2.0 + 0.2 * x])
    found = mass_ratios_of_gain(RATIOS, medians, [0.5])[:, 0]
    at = share_of_size(found)
    assert 0.3 * at[0] - 0.1 * at[0] ** 2 == pytest.approx(0.1)
    assert found[1] == pytest.approx(0.5)
