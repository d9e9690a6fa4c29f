"""What the checks let through, and what their messages say of what they refuse."""

import math
from fractions import Fraction

import numpy as np
import pytest

from topheavy import checks

EVERY = [
    checks.finite,
    checks.positive,
    checks.not_negative,
    checks.acceleration,
    checks.within_quarter_turn,
    checks.fraction,
]
NO_NUMBERS = [
    *(None, "tall", "0.25", b"0.25", np.str_("0.25"), np.array("0.25")),
    *(True, np.True_, np.array(True), 1j, 10**400, [1.0, 2.0]),
    *(np.array([0.25]), np.array([0.25, 0.5]), np.ma.masked, np.ma.array(0.25, mask=True)),
]


@pytest.mark.parametrize("check", EVERY)
@pytest.mark.parametrize("value", [0.25, np.float64(0.25), np.float32(0.25), np.array(0.25)])
def test_good_value_comes_back_as_a_float(check, value):
    assert check("thing", value) == 0.25
    assert type(check("thing", value)) is float


@pytest.mark.parametrize("check", EVERY)
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_value_that_is_not_finite_is_refused_by_every_check(check, value):
    with pytest.raises(ValueError, match=rf"thing is {value}; expected a finite number"):
        check("thing", value)


@pytest.mark.parametrize("check", [*EVERY, checks.number])
@pytest.mark.parametrize("value", NO_NUMBERS)
def test_what_is_no_number_is_refused_by_every_check(check, value):
    with pytest.raises(ValueError, match=r"thing is .*; expected a number"):
        check("thing", value)


@pytest.mark.parametrize(
    "values",
    [[1, 2.5], (0.25,), 3.0, np.arange(4), [], [Fraction(1, 4), 2], np.ma.array([1.0], mask=[0])],
)
def test_numbers_come_back_as_a_new_array_of_floats(values):
    found = checks.numbers("things", values)
    assert type(found) is np.ndarray
    assert found.dtype == np.float64
    assert found is not values
    np.testing.assert_array_equal(found, np.array(values, dtype=float))


@pytest.mark.parametrize("value", ["0.25", True, None, 1j])
def test_numbers_name_the_first_element_that_is_none(value):
    with pytest.raises(ValueError, match=r"^things: element 0 is .*; expected a number"):
        checks.numbers("things", [value, value])
    with pytest.raises(ValueError, match=r"^things: element 2 is .*; expected a number"):
        checks.numbers("things", np.array([0.1, 0.2, value], dtype=object))


@pytest.mark.parametrize("value", [5e-324, 1, 1e300])
def test_positive_takes_all_above_zero(value):
    assert checks.positive("thing", value) == value
