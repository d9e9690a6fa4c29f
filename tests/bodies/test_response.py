"""Where a response is sampled, and what it says of itself."""

import math

import numpy as np
import pytest

from topheavy import Response
from topheavy.bodies.response import sample_times


@pytest.mark.parametrize("samples", [2, 1000, 3.0, np.int64(5), np.float64(7.0)])
def test_number_of_samples_stays_a_number(samples):
    number = sample_times(samples)
    assert number == samples
    assert type(number) is int


@pytest.mark.parametrize("samples", [1, 0, -3, 2.5, math.nan, math.inf, "many", None])
def test_what_is_no_whole_number_from_two_on_is_refused(samples):
    with pytest.raises(ValueError, match="samples is"):
        sample_times(samples)


@pytest.mark.parametrize("samples", [[0.0], [3.0], [0, 1, 2], (0.1, 0.2), np.linspace(0, 1, 9)])
def test_increasing_times_are_taken_as_they_are(samples):
    times = sample_times(samples)
    np.testing.assert_array_equal(times, samples)
    assert times.dtype == np.float64


def test_times_are_a_copy():
    mine = np.array([0.0, 1.0])
    times = sample_times(mine)
    times[1] = 5.0
    assert mine[1] == 1.0


@pytest.mark.parametrize("samples", [[0.0, 0.0], [1.0, 0.5], [-0.1, 0.5], [0.0, 1.0, 1.0]])
def test_times_that_do_not_increase_from_zero_are_refused(samples):
    with pytest.raises(ValueError, match="not an increasing array of times from 0 on"):
        sample_times(samples)


@pytest.mark.parametrize("samples", [[], [0.0, math.nan], [0.0, math.inf], [[0.0, 1.0]]])
def test_what_is_no_list_of_times_is_refused(samples):
    with pytest.raises(ValueError, match=r"expected (a list of )?times in s"):
        sample_times(samples)


@pytest.mark.parametrize("outcome", ["no uplift", "rests", "rocking", "overturned"])
def test_overturned_is_one_of_the_outcomes(outcome):
    none = np.zeros(0)
    response = Response(none, none, none, none, outcome, 0, 0.1)
    assert response.overturned == (outcome == "overturned")
