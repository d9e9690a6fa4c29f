"""The period by its two routes."""

import math

import pytest

from theory.period import by_elliptic_integral, by_integration


@pytest.mark.parametrize("amplitude", [0.01, 1.0, 3.0])
def test_both_routes_give_the_same_period(amplitude):
    assert by_integration(amplitude) == pytest.approx(by_elliptic_integral(amplitude), rel=1e-10)


def test_period_of_small_swings_is_one():
    assert by_elliptic_integral(1e-6) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("amplitude", [0.0, math.pi, math.nan])
def test_pendulum_that_does_not_come_down_is_refused(amplitude):
    with pytest.raises(ValueError, match="expected one between 0 and π"):
        by_integration(amplitude)
