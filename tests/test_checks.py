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


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan, Fraction(1, 4), np.ma.array(2.0)])
def test_number_may_be_infinite_or_undefined(value):
    np.testing.assert_equal(checks.number("thing", value), float(value))


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


def test_numbers_refuse_masked_elements_and_say_where():
    values = np.ma.array([1.0, 2.0, 3.0, 4.0], mask=[0, 1, 0, 1])
    with pytest.raises(
        ValueError, match=r"^things has 2 masked of 4 elements, the first at index 1"
    ):
        checks.numbers("things", values)


@pytest.mark.parametrize("value", [5e-324, 1, 1e300])
def test_positive_takes_all_above_zero(value):
    assert checks.positive("thing", value) == value


@pytest.mark.parametrize("value", [0.0, -0.0, -5e-324, -3])
def test_positive_refuses_zero_and_below(value):
    with pytest.raises(ValueError, match="expected more than zero"):
        checks.positive("thing", value)


def test_positive_names_the_unit_and_leaves_no_gap_without_one():
    with pytest.raises(ValueError, match=r"^height is -2 m; expected"):
        checks.positive("height", -2.0, "m")
    with pytest.raises(ValueError, match=r"^ratio is -2; expected"):
        checks.positive("ratio", -2.0)


@pytest.mark.parametrize("value", [5e-324, math.nextafter(math.pi / 2, 0.0)])
def test_quarter_turn_is_taken_up_to_its_ends(value):
    assert checks.within_quarter_turn("angle", value) == value


@pytest.mark.parametrize("value", [0.0, math.pi / 2, -0.1, 15.0])
def test_quarter_turn_excludes_its_ends_and_what_lies_beyond(value):
    with pytest.raises(ValueError, match="both excluded"):
        checks.within_quarter_turn("angle", value)


def test_angle_that_was_given_in_degrees_is_shown_in_both_units():
    with pytest.raises(ValueError, match=r"angle is 15 rad \(859\.4°\)"):
        checks.within_quarter_turn("angle", 15.0)


@pytest.mark.parametrize("value", [0, 0.0, 1, 1.0, 0.5])
def test_fraction_includes_its_ends(value):
    assert checks.fraction("share", value) == value


@pytest.mark.parametrize("value", [-5e-324, math.nextafter(1.0, 2.0), 2])
def test_fraction_refuses_what_lies_beyond_its_ends(value):
    with pytest.raises(ValueError, match=r"share is .*; expected a value from 0 to 1"):
        checks.fraction("share", value)


def test_not_negative_lets_zero_through_and_names_what_is_below():
    assert checks.not_negative("depth", 0, "m") == 0.0
    with pytest.raises(ValueError, match=r"^depth is -0\.5 m; expected zero or more$"):
        checks.not_negative("depth", -0.5, "m")
