"""Pulses and records in memory: shapes, samples, units, peaks, and how they are scaled."""

import math
import warnings
from typing import get_args

import numpy as np
import pytest

from steps.shared import plain
from tests.cases import MOTION, TIME
from topheavy import STANDARD_GRAVITY, Column, Pulse, Record, judge, overturned_by, simulate
from topheavy.ground.records import acceleration_in_g
from topheavy.ground.shapes import ELEMENTARY, FINITE_SHAPES, PULSE_SHAPES, SHAPES, PulseShape

OMEGA = 2.5
PERIOD = 2 * math.pi / OMEGA
CYCLES = {  # duration in units of 2π/ω
    "one-sine": 1.0,
    "one-cosine": 1.0,
    "half-sine": 0.5,
    "constant": 0.5,
    "ricker-symmetric": 4.5,
    "ricker-antisymmetric": 4.5,
}
CENTRE = 2.25 * PERIOD
EVERY = pytest.mark.parametrize("shape", PULSE_SHAPES)
FINITE = pytest.mark.parametrize("shape", CYCLES)
KNOWN_VALUES = [
    # shape, time, value at unit amplitude
    *(("one-sine", PERIOD * x, y) for x, y in ((0.0, 0.0), (1 / 12, 0.5), (1 / 4, 1), (0.75, -1))),
    *(("one-cosine", PERIOD * x, y) for x, y in ((0, 1), (1 / 6, 0.5), (1 / 4, 0), (1 / 2, -1))),
    *(("half-sine", PERIOD / 4, 1.0), ("half-sine", PERIOD / 12, 0.5)),
    *(("constant", 0.0, 1.0), ("constant", 0.49 * PERIOD, 1.0)),
    *(("harmonic", PERIOD / 4, 1.0), ("harmonic", 100.75 * PERIOD, -1.0)),
    ("ricker-symmetric", CENTRE, 1.0),
    ("ricker-symmetric", CENTRE + PERIOD / (math.pi * math.sqrt(2)), 0.0),
    # side lobes: −2 e^(−3/2) where 2π²τ²/T² = 3
    ("ricker-symmetric", CENTRE - PERIOD * math.sqrt(3 / 2) / math.pi, -2 * math.exp(-1.5)),
    ("ricker-antisymmetric", CENTRE, 0.0),
    # (4π²τ²/3T² − 3) vanishes at τ = 3T/2π
    ("ricker-antisymmetric", CENTRE + 1.5 * PERIOD / math.pi, 0.0),
]


def pulse(shape, amplitude=0.3, omega=OMEGA):
    return Pulse(shape, amplitude, angular_frequency=omega)


def times_of(shape, number=2001):
    return np.linspace(0.0, CYCLES.get(shape, 3.0) * PERIOD, number)


@pytest.mark.parametrize(("shape", "time", "value"), KNOWN_VALUES)
def test_pulse_has_its_known_values(shape, time, value):
    assert pulse(shape).excitation(time) == pytest.approx(0.3 * value, abs=1e-13)


@FINITE
def test_pulse_lasts_its_number_of_cycles_and_is_zero_after_them(shape):
    motion = pulse(shape)
    assert motion.duration == pytest.approx(CYCLES[shape] * PERIOD, rel=1e-15)
    assert not motion.excitation(motion.duration * np.array([1 + 1e-9, 1.25, 100.0])).any()
    assert motion.excitation(1.25 * motion.duration) == 0
    assert pulse("harmonic").duration == math.inf


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
def test_pulse_of_several_cycles_repeats_its_first_and_then_ends(shape):
    single, three = pulse(shape), Pulse(shape, 0.3, angular_frequency=OMEGA, cycles=3)
    assert three.duration == pytest.approx(3.0 * PERIOD, rel=1e-15)
    time = np.linspace(0.0, 0.999 * PERIOD, 501)
    for cycle in range(3):
        np.testing.assert_allclose(
            three.excitation(time + cycle * PERIOD), single.excitation(time), atol=1e-14
        )
    assert not three.excitation(PERIOD * np.array([3.001, 3.5])).any()
    assert (
        three.scaled(2.0)
        == Pulse(shape, 0.6, angular_frequency=OMEGA, cycles=3)
        != pulse(shape, 0.6)
    )
    assert "cycles=3" in repr(three)
    corners = plain.ground_of(three)[0].corners[1:-1] / OMEGA
    turns = corners[np.abs(three.excitation(corners)) > 0.15]
    assert len(turns) == (6 if shape == "one-sine" else 5)
    assert three.excitation(turns) == pytest.approx(0.3 * np.sign(three.excitation(turns)))


@EVERY
def test_pulse_peaks_at_its_amplitude_whose_sign_mirrors_it_to_the_last_bit(shape):
    time = times_of(shape, 20001)
    plus, minus = (pulse(shape, side).excitation(time) for side in (0.3, -0.3))
    np.testing.assert_array_equal(minus, -plus)
    assert np.max(np.abs(plus)) == pytest.approx(0.3, rel=1e-4)


def test_lists_are_parts_of_the_one_list():
    finite = (
        name for name in SHAPES if Pulse(name, 1.0, angular_frequency=1.0).duration < math.inf
    )
    assert tuple(finite) == FINITE_SHAPES
    assert {*get_args(PulseShape)} == {*SHAPES}
    assert set(ELEMENTARY) == {name for name in SHAPES if not name.startswith("ricker")}


# ---------------------------------------------------------------------------- records


def test_number_that_could_be_a_period_or_a_frequency_is_refused():
    with pytest.raises(TypeError, match=r"period=1.5 for s, or angular_frequency=1.5 for rad/s"):
        Pulse("one-cosine", 0.29, 1.5)


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
    across, near, late = (Record(0.01, MOTION, start=start) for start in (10.0, 10.004, 12.0))
    says = "excitation starts at 10 s, vertical at 12 s; expected the same"
    for solve in (simulate, judge, plain.simulate):
        with pytest.raises(ValueError, match=says):
            solve(column, across, vertical=late)
    with pytest.raises(ValueError, match=says):
        overturned_by(column, across, [1.0], vertical=late.scaled(0.5))
    whole = Record(0.01, MOTION)
    assert judge(column, across, vertical=near) == judge(column, whole, vertical=whole)
