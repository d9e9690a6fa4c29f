"""Records in memory: samples, units, peaks, and warnings of doubtful ones."""

import math
import warnings

import numpy as np
import pytest

from steps.shared import plain
from topheavy import STANDARD_GRAVITY, Column, Record, judge, overturned_by, simulate
from topheavy.ground.records import acceleration_in_g

SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)
FIVE = Record(0.02, np.array(SAMPLES), name="five samples")


def test_record_passes_through_its_samples_by_straight_lines_and_is_zero_outside():
    times = [0.0, 0.02, 0.04, 0.06, 0.08, 0.01, 0.045]
    assert FIVE.excitation(times) == pytest.approx([*SAMPLES, -0.05, 0.3], abs=1e-14)
    fine = FIVE.excitation(np.linspace(0.04, 0.06, 21))
    np.testing.assert_allclose(np.diff(fine, 2), 0.0, atol=1e-14)
    outside = np.array([-1.0, -1e-9, 0.08 + 1e-9, 0.1, 1e3])
    assert not FIVE.excitation(outside).any()
    assert (FIVE.duration, FIVE.name) == (pytest.approx(0.08, rel=1e-15), "five samples")


def test_last_sample_is_that_of_the_end_and_of_no_later_time():
    for step in np.random.default_rng(1).uniform(0.001, 1.0, 200):
        for size in (2, 4, 100):
            record = Record(float(step), np.full(size, 0.5))
            assert record.excitation(record.duration) == 0.5
            assert record.excitation(math.nextafter(record.duration, math.inf)) == 0.0


def test_samples_are_converted_to_g():
    record = Record(0.02, 981.0 * np.array(SAMPLES), unit="gal")
    np.testing.assert_allclose(record.acceleration, SAMPLES, rtol=1e-15)
    with pytest.raises(ValueError, match=r"record 'a': unit is 'm/s'; expected one of g, %g"):
        Record(0.02, SAMPLES, "a", unit="m/s")


def test_units_are_understood_in_their_usual_spellings_and_no_others():
    for length, metres in {"m": 1.0, "cm": 0.01, "mm": 0.001}.items():
        for form in ("/s/s", "/s2", "/s^2", "/s**2", "/s²", "/sec/sec", "/(sec^2)", " s-2", "·s⁻²"):
            assert acceleration_in_g(length + form) == metres / STANDARD_GRAVITY
            assert acceleration_in_g((length + form).upper()) == metres / STANDARD_GRAVITY
    for text, factor in {"g": 1.0, "G's": 1.0, "% g": 0.01, "mg": 0.001}.items():
        assert acceleration_in_g(text) == factor
    assert acceleration_in_g("Gals") == 0.01 / STANDARD_GRAVITY
    for text in ("cm/s", "m/s^3", "g/s", "g*10", "2 g", "0.1g", "s", "kg", "counts", "g^2", ""):
        assert acceleration_in_g(text) is None


def test_peaks_are_the_largest_acceleration_and_the_integral_of_the_straight_lines():
    for samples, peak in (([0.1, -0.4, 0.3], 0.4), ([0.1, 0.3, -0.5], 0.5)):
        record = Record(0.02, samples)  # in the middle, at an end; the velocity the other way round
        assert record.peak_acceleration == peak
        expected = 0.2 * 0.02 * STANDARD_GRAVITY
        assert record.peak_velocity == pytest.approx(expected, rel=1e-14)
        assert record.scaled(-2.0).peak_velocity == pytest.approx(2.0 * expected, rel=1e-14)


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


TIME = 0.01 * np.arange(400)
MOTION = 0.3 * np.sin(2.5 * np.pi * TIME) * np.exp(-(((TIME - 2.0) / 0.8) ** 2))


@pytest.mark.parametrize("line", [-0.0078, 0.001 + 0.002 * TIME])
def test_offset_and_drift_are_removed(line):
    shifted = Record(0.01, MOTION + line, "shifted", start=1.0)
    level, whole = shifted.detrended(), Record(0.01, MOTION)
    assert (level.name, level.start, level.time_step) == ("shifted", 1.0, 0.01)
    np.testing.assert_allclose(level.acceleration, whole.detrended().acceleration)
    assert level.peak_velocity == pytest.approx(whole.peak_velocity, rel=0.01)
    with warnings.catch_warnings(action="error"):
        Record(0.01, level.acceleration)


def test_components_that_start_at_different_times_are_refused_together():
    column = Column.of_dimensions(width=1.6, height=8.0)
    across, same, late = (Record(0.01, MOTION, start=start) for start in (10.0, 10.004, 12.0))
    says = "excitation starts at 10 s, vertical at 12 s; expected the same"
    for solve in (simulate, judge, plain.simulate):
        with pytest.raises(ValueError, match=says):
            solve(column, across, vertical=late)
    with pytest.raises(ValueError, match=says):
        overturned_by(column, across, [1.0], vertical=late.scaled(0.5))
    whole = Record(0.01, MOTION)
    assert judge(column, across, vertical=same) == judge(column, whole, vertical=whole)
