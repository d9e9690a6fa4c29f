"""Ground motion records: interpolation, peaks, bad samples, and those in the repository."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from topheavy import STANDARD_GRAVITY, Record, read_at2, read_record

FOLDER = Path(__file__).parents[1] / "data" / "records"
SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)


@pytest.fixture
def record() -> Record:
    return Record(0.02, np.array(SAMPLES), name="five samples")


# ---------------------------------------------------------------------------- Record


def test_record_passes_through_its_samples(record):
    for index, value in enumerate(SAMPLES):
        assert record.excitation(index * 0.02) == pytest.approx(value, abs=1e-14)


def test_record_is_linear_between_samples(record):
    assert record.excitation(0.01) == pytest.approx(-0.05, abs=1e-14)
    assert record.excitation(0.045) == pytest.approx(0.3, abs=1e-14)
    fine = np.linspace(0.04, 0.06, 21)
    np.testing.assert_allclose(np.diff(record.excitation(fine), 2), 0.0, atol=1e-14)


def test_last_sample_is_that_of_the_end_and_of_no_later_time():
    for step in np.random.default_rng(1).uniform(0.001, 1.0, 200):
        for size in (2, 4, 100):
            record = Record(float(step), np.full(size, 0.5))
            assert record.excitation(record.duration) == 0.5
            assert record.excitation(math.nextafter(record.duration, math.inf)) == 0.0


def test_record_is_zero_outside_its_duration(record):
    outside = np.array([-1.0, -1e-9, 0.08 + 1e-9, 0.1, 1e3])
    assert np.all(record.excitation(outside) == 0)
    assert record.excitation(-1e-9) == 0
    assert record.excitation(0.08 + 1e-9) == 0


def test_record_lasts_from_its_first_sample_to_its_last(record):
    assert record.duration == pytest.approx(0.08, rel=1e-15)


def test_record_keeps_its_name_and_needs_none(record):
    assert record.name == "five samples"
    assert record.time_step == 0.02
    assert Record(0.02, SAMPLES).name == ""


@pytest.mark.parametrize(
    ("unit", "factor"), [("g", 1.0), ("m/s2", 9.81), ("cm/s²", 981.0), ("gal", 981.0), ("mg", 1e3)]
)
def test_record_in_memory_is_converted_to_g(record, unit, factor):
    found = Record(0.02, factor * np.array(SAMPLES), unit=unit)
    np.testing.assert_allclose(found.acceleration, record.acceleration, rtol=1e-15)


def test_unit_that_is_none_of_acceleration_is_refused():
    with pytest.raises(ValueError, match=r"record 'a': unit is 'm/s'; expected g, % g"):
        Record(0.02, SAMPLES, "a", unit="m/s")


def test_record_excitation_of_an_array_is_that_of_its_elements(record):
    time = np.linspace(-0.02, 0.1, 30).reshape(5, 6)
    values = record.excitation(time)
    assert values.shape == time.shape
    expected = [[record.excitation(float(t)) for t in row] for row in time]
    np.testing.assert_allclose(values, expected, rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("time", [-1.0, 0.0, 0, 0.03, 1])
def test_record_excitation_at_one_time_is_a_float(record, time):
    assert isinstance(record.excitation(time), float)


def test_scaled_record_differs_in_acceleration_alone(record):
    scaled = record.scaled(-2.0)
    np.testing.assert_array_equal(scaled.acceleration, -2.0 * np.array(SAMPLES))
    np.testing.assert_array_equal(record.acceleration, SAMPLES)
    assert scaled.time_step == record.time_step
    assert scaled.duration == record.duration


def test_record_holds_a_copy_that_nobody_can_change():
    mine = np.array(SAMPLES)
    record = Record(0.02, mine)
    mine[2] = 99.0  # still writable, and no longer the record's
    assert record.acceleration[2] == 0.4
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration[2] = 99.0
    with pytest.raises(AttributeError):
        record.time_step = 0.01


def test_record_takes_integers_and_lists_as_floats():
    assert Record(1, [0, 1, 0]).excitation(0.5) == pytest.approx(0.5)
    assert Record(0.1, np.array([0, 1], dtype=np.int32)).acceleration.dtype == np.float64


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_record_names_the_sample_that_is_not_finite(bad):
    samples = np.zeros(40)
    samples[17] = bad
    with pytest.raises(ValueError, match=r"\b17\b") as error:
        Record(0.02, samples)
    assert error.match(str(bad))


@pytest.mark.parametrize("samples", [[], [0.1]])
def test_record_needs_two_samples(samples):
    with pytest.raises(ValueError, match=rf"\b{len(samples)}\b|two|2"):
        Record(0.02, samples)


def test_record_refuses_a_table_of_samples():
    with pytest.raises(ValueError, match=r"one.dimension|1.?[dD]\b|shape|dimension"):
        Record(0.02, np.zeros((3, 4)))


@pytest.mark.parametrize("value", [0.0, -0.02, math.nan, math.inf])
def test_record_refuses_a_time_step_that_is_not_positive(value):
    with pytest.raises(ValueError, match=f"time_step.*{value:g}"):
        Record(value, SAMPLES)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_record_refuses_a_factor_that_is_not_finite(record, value):
    with pytest.raises(ValueError, match=str(value)):
        record.scaled(value)


@pytest.mark.parametrize(
    ("samples", "says"),
    [
        (["0.1", "0.2"], "acceleration: element 0 is '0.1'; expected a number"),
        ([0.1, None], "acceleration: element 1 is None; expected a number"),
        ([True, False], "acceleration: element 0 is True; expected a number"),
        ([[0.1], [0.2, 0.3]], "acceleration: .*inhomogeneous.*; expected rows of equal length"),
        (np.ma.array([0.1, 9.9, 0.2], mask=[0, 1, 0]), "has 1 masked of 3 elements, .* index 1"),
        (np.ma.masked_all((2, 2)), "has 4 masked of 4 elements, the first at index 0"),
    ],
)
def test_record_refuses_samples_that_are_no_numbers(samples, says):
    with pytest.raises(ValueError, match=says):
        Record(0.02, samples)


def test_record_takes_a_masked_array_in_which_nothing_is_masked():
    record = Record(0.02, np.ma.array(SAMPLES, mask=False))
    assert type(record.acceleration) is np.ndarray
    np.testing.assert_array_equal(record.acceleration, SAMPLES)


@pytest.mark.parametrize("value", ["0.02", True, np.array([0.02, 0.02]), np.ma.masked])
def test_record_refuses_a_time_step_that_is_no_number(value):
    with pytest.raises(ValueError, match=r"^time_step is .*; expected a number$"):
        Record(value, SAMPLES)
    with pytest.raises(ValueError, match=r"^factor is .*; expected a number$"):
        Record(0.02, SAMPLES).scaled(value)


def test_record_refuses_times_that_are_no_numbers(record):
    with pytest.raises(ValueError, match=r"^t: element 0 is '0\.02'; expected a number$"):
        record.excitation("0.02")
    with pytest.raises(ValueError, match="t has 1 masked of 2 elements"):
        record.excitation(np.ma.array([0.0, 0.02], mask=[1, 0]))


# ---------------------------------------------------------------------------- peaks


def test_peak_acceleration_is_the_largest_of_either_sign():
    assert Record(0.02, [0.1, -0.4, 0.3]).peak_acceleration == 0.4


def test_peak_velocity_is_the_integral_of_the_straight_lines():
    expected = 0.2 * 0.02 * STANDARD_GRAVITY
    assert Record(0.02, [0.1, 0.3]).peak_velocity == pytest.approx(expected, rel=1e-14)


def test_peak_velocity_of_a_sine_is_twice_its_amplitude_over_its_frequency():
    time = np.linspace(0.0, 1.0, 2001)
    record = Record(time[1], 0.3 * np.sin(2.0 * math.pi * time))
    expected = 2.0 * 0.3 * STANDARD_GRAVITY / (2.0 * math.pi)  # ∫ sin over the first half
    assert record.peak_velocity == pytest.approx(expected, rel=1e-6)
    assert record.scaled(-2.0).peak_velocity == pytest.approx(2.0 * expected, rel=1e-6)


# ---------------------------------------------------------------------------- data/records


def certified() -> list[tuple[str, int, float, float]]:
    """Name, samples, time step (s) and peak (g) of each record, by the README of their folder."""
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\w+\.AT2) \|.*?\| (\d+) \| ([\d.]+) \| ([\d.]+) \|", text, re.M)
    return [(name, int(n), float(step), float(peak)) for name, n, step, peak in rows]


def test_every_record_in_the_repository_is_certified():
    assert sorted(path.name for path in FOLDER.glob("*.AT2")) == sorted(r[0] for r in certified())
    assert len(certified()) == 10


@pytest.mark.parametrize(("file", "samples", "time_step", "peak"), certified())
def test_record_has_the_certified_count_step_and_peak(file, samples, time_step, peak):
    record = read_record(FOLDER / file)
    assert record.acceleration.shape == (samples,)
    assert record.time_step == time_step
    assert record.duration == pytest.approx((samples - 1) * time_step, rel=1e-14)
    assert record.peak_acceleration == pytest.approx(peak, abs=5e-4)


def test_read_at2_keeps_first_and_last_values_in_place():
    record = read_at2(str(FOLDER / "el_centro_1940_NS.AT2"))  # a path in a string, too
    np.testing.assert_array_equal(record.acceleration[:3], [0.0063, 0.00364, 0.00099])
    np.testing.assert_array_equal(record.acceleration[-3:], [-0.00013, -0.00006, 0.0])


def test_read_record_refuses_another_ending(tmp_path):
    with pytest.raises(ValueError, match=r"motion\.txt: expected .* \.AT2 or \.csv"):
        read_record(tmp_path / "motion.txt")


def test_record_is_scaled_to_a_peak():
    record = Record(0.1, [0.0, 0.2, -0.5, 0.1])
    assert record.scaled_to(pga=1.0).peak_acceleration == pytest.approx(1.0)
    assert record.scaled_to(pgv=0.3).peak_velocity == pytest.approx(0.3)
    assert record.time == pytest.approx([0.0, 0.1, 0.2, 0.3])
    for wrong in ({}, {"pga": 1.0, "pgv": 1.0}):
        with pytest.raises(ValueError, match="expected one of both"):
            record.scaled_to(**wrong)
    with pytest.raises(ValueError, match="has no acceleration"):
        Record(0.1, [0.0, 0.0]).scaled_to(pga=1.0)
