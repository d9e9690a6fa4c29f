"""The first step of the study."""

import math

import pytest

from studies.skeleton.steps.limit import error_of


def test_error_falls_with_the_square_of_the_intervals():
    assert error_of(1000) == pytest.approx(math.pi**2 / 12e6, rel=1e-5)
