"""The first step of the study."""

import math

import pytest

from studies.skeleton.steps.limit import error_of


def test_error_is_that_of_the_sum_in_closed_form():
    half = math.pi / 20
    assert error_of(10) == pytest.approx(1.0 - half / math.tan(half), rel=1e-10)
