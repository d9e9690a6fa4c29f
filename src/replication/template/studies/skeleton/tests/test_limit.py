"""The first step of the study."""

import math

import pytest

from studies.skeleton.steps.limit import largest_amplitude


def test_small_share_is_that_of_the_series():
    assert largest_amplitude(1e-6) == pytest.approx(math.sqrt(16e-6), rel=1e-6)
