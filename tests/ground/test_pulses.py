"""Pulse shapes: values at known times, support, symmetry, scaling, bad input."""

import math

import numpy as np
import pytest

from topheavy import PULSE_SHAPES, Pulse

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
SYMMETRIC = {"one-sine": -1, "ricker-antisymmetric": -1} | dict.fromkeys(
    ("one-cosine", "half-sine", "constant", "ricker-symmetric"), 1
)
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
    return Pulse(shape, amplitude, omega)


def times_of(shape, number=2001):
    return np.linspace(0.0, CYCLES.get(shape, 3.0) * PERIOD, number)


@pytest.mark.parametrize(("shape", "time", "value"), KNOWN_VALUES)
def test_pulse_has_its_known_values(shape, time, value):
    assert pulse(shape).excitation(time) == pytest.approx(0.3 * value, abs=1e-13)


@FINITE
def test_pulse_lasts_its_number_of_cycles_and_is_zero_after_them(shape):
    one = pulse(shape)
    assert one.duration == pytest.approx(CYCLES[shape] * PERIOD, rel=1e-15)
    assert not one.excitation(one.duration * np.array([1 + 1e-9, 1.25, 100.0])).any()
    assert one.excitation(1.25 * one.duration) == 0
    assert pulse("harmonic").duration == math.inf


@EVERY
def test_pulse_peaks_at_its_amplitude_whose_sign_mirrors_it_to_the_last_bit(shape):
    time = times_of(shape, 20001)
    plus, minus = (pulse(shape, side).excitation(time) for side in (0.3, -0.3))
    np.testing.assert_array_equal(minus, -plus)
    assert np.max(np.abs(plus)) == pytest.approx(0.3, rel=1e-4)


@FINITE
def test_pulse_is_even_or_odd_about_its_middle(shape):
    one = pulse(shape)
    ahead, middle = np.linspace(0.0, 0.499 * one.duration, 501), one.duration / 2
    mirrored = SYMMETRIC[shape] * one.excitation(middle - ahead)
    np.testing.assert_allclose(one.excitation(middle + ahead), mirrored, atol=1e-13)


@pytest.mark.parametrize(
    ("shape", "velocity", "tolerance"),
    [
        *(("one-sine", 0.0, 1e-9), ("one-cosine", 0.0, 1e-9), ("ricker-symmetric", 0.0, 1e-6)),
        ("half-sine", 2 / OMEGA / PERIOD, 1e-7),
    ],
)
def test_ground_has_its_velocity_when_the_pulse_ends(shape, velocity, tolerance):
    time = times_of(shape, 20001)
    found = np.trapezoid(pulse(shape, 1.0).excitation(time), time) / PERIOD
    assert found == pytest.approx(velocity, abs=tolerance)


# ---------------------------------------------------------------------------- bad input


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("sawtooth", "sawtooth.*" + ".*".join(PULSE_SHAPES)),
        *((typed, f"(did you mean|meant|perhaps).{{0,8}}{meant}") for typed, meant in (
            ("onesine", "one-sine"), ("One-Sine", "one-sine"),
            ("half_sine", "half-sine"), ("ricker-symetric", "ricker-symmetric"))),
    ],
)  # fmt: skip
def test_unknown_shape_is_refused_with_a_suggestion_or_the_list_of_shapes(typed, says):
    with pytest.raises(ValueError, match=f"(?is){says}"):
        pulse(typed)


def test_times_that_are_no_numbers_are_refused():
    with pytest.raises(ValueError, match=r"^t: element 0 is '0\.3'; expected a number$"):
        pulse("one-sine").excitation("0.3")
    with pytest.raises(ValueError, match=r"^t has 1 masked of 2 elements"):
        pulse("one-sine").excitation(np.ma.array([0.1, 0.2], mask=[0, 1]))
