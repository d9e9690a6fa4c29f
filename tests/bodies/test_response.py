"""Where a response is sampled, and what it says of itself."""

import math

import pytest

from topheavy.bodies.response import sample_times


@pytest.mark.parametrize("samples", [1, 0, -3, 2.5, math.nan, math.inf, "many", None])
def test_what_is_no_whole_number_from_two_on_is_refused(samples):
    with pytest.raises(ValueError, match="samples is"):
        sample_times(samples)
