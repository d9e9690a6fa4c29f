"""Pulses, their shapes, and excitations as the solvers read them."""

import math
from typing import get_args

import numpy as np
import pytest

from steps.shared.segments import segments_of
from topheavy import Pulse
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


@pytest.mark.parametrize("shape", ["one-sine", "one-cosine"])
def test_pulse_of_several_cycles_repeats_its_first_and_then_ends(shape):
    one, three = pulse(shape), Pulse(shape, 0.3, OMEGA, cycles=3)
    assert three.duration == pytest.approx(3.0 * PERIOD, rel=1e-15)
    time = np.linspace(0.0, 0.999 * PERIOD, 501)
    for cycle in range(3):
        np.testing.assert_allclose(
            three.excitation(time + cycle * PERIOD), one.excitation(time), atol=1e-14
        )
    assert not three.excitation(PERIOD * np.array([3.001, 3.5])).any()
    assert three.scaled(2.0) == Pulse(shape, 0.6, OMEGA, cycles=3) != pulse(shape, 0.6)
    assert "cycles=3" in repr(three)
    turns = [segment.stop for segment in segments_of(three, three.duration)][:-1]
    assert len(turns) == (6 if shape == "one-sine" else 5)
    assert three.excitation(np.array(turns)) == pytest.approx(
        0.3 * np.sign(three.excitation(turns))
    )


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


def test_period_stands_for_the_angular_frequency():
    by_period = Pulse("one-cosine", 0.3, period=1.5)
    assert by_period == Pulse("one-cosine", 0.3, 2.0 * math.pi / 1.5)
    assert by_period.period == pytest.approx(1.5, rel=1e-15)
    assert by_period.scaled(2.0) == Pulse("one-cosine", 0.6, by_period.angular_frequency)


def test_lists_are_parts_of_the_one_list():
    finite = (name for name in SHAPES if Pulse(name, 1.0, 1.0).duration < math.inf)
    assert tuple(finite) == FINITE_SHAPES
    assert {*get_args(PulseShape)} == {*SHAPES}
    assert set(ELEMENTARY) == {name for name in SHAPES if not name.startswith("ricker")}
