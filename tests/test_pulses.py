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
FINITE = tuple(CYCLES)
RICKER_CENTRE = 2.25 * PERIOD
# (x² − 3) x e^(−x²/2) has its extremes at x² = 3 ± √6; x = 2πτ/(√3 T)
ANTISYMMETRIC_PEAK = math.sqrt(3 - math.sqrt(6)) * math.sqrt(3) / (2 * math.pi) * PERIOD

KNOWN_VALUES = [
    # shape, time, value at unit amplitude
    ("one-sine", 0.0, 0.0),
    ("one-sine", PERIOD / 12, 0.5),
    ("one-sine", PERIOD / 4, 1.0),
    ("one-sine", 0.75 * PERIOD, -1.0),
    ("one-cosine", 0.0, 1.0),
    ("one-cosine", PERIOD / 6, 0.5),
    ("one-cosine", PERIOD / 4, 0.0),
    ("one-cosine", PERIOD / 2, -1.0),
    ("half-sine", PERIOD / 4, 1.0),
    ("half-sine", PERIOD / 12, 0.5),
    ("constant", 0.0, 1.0),
    ("constant", 0.49 * PERIOD, 1.0),
    ("harmonic", PERIOD / 4, 1.0),
    ("harmonic", 100.75 * PERIOD, -1.0),
    ("ricker-symmetric", RICKER_CENTRE, 1.0),
    ("ricker-symmetric", RICKER_CENTRE + PERIOD / (math.pi * math.sqrt(2)), 0.0),
    # side lobes: −2 e^(−3/2) where 2π²τ²/T² = 3
    ("ricker-symmetric", RICKER_CENTRE - PERIOD * math.sqrt(3 / 2) / math.pi, -2 * math.exp(-1.5)),
    ("ricker-antisymmetric", RICKER_CENTRE, 0.0),
    # (4π²τ²/3T² − 3) vanishes at τ = 3T/2π
    ("ricker-antisymmetric", RICKER_CENTRE + 1.5 * PERIOD / math.pi, 0.0),
]


def times_of(shape: str, number: int = 2001) -> np.ndarray:
    return np.linspace(0.0, CYCLES.get(shape, 3.0) * PERIOD, number)


@pytest.mark.parametrize(("shape", "time", "value"), KNOWN_VALUES)
def test_pulse_has_its_known_values(shape, time, value):
    assert Pulse(shape, 0.3, OMEGA).excitation(time) == pytest.approx(0.3 * value, abs=1e-13)


@pytest.mark.parametrize("shape", FINITE)
def test_pulse_lasts_its_number_of_cycles(shape):
    assert Pulse(shape, 0.3, OMEGA).duration == pytest.approx(CYCLES[shape] * PERIOD, rel=1e-15)


def test_harmonic_goes_on_forever():
    assert Pulse("harmonic", 0.3, OMEGA).duration == math.inf


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_pulse_keeps_what_it_was_made_of(shape):
    pulse = Pulse(shape, -0.3, OMEGA)
    assert (pulse.shape, pulse.amplitude, pulse.angular_frequency) == (shape, -0.3, OMEGA)


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_pulse_is_zero_before_it_starts(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    assert np.all(pulse.excitation(np.array([-1e3, -PERIOD / 4, -1e-9])) == 0)


@pytest.mark.parametrize("shape", FINITE)
def test_pulse_is_zero_after_it_ends(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    later = pulse.duration * np.array([1 + 1e-9, 1.25, 100.0])
    assert np.all(pulse.excitation(later) == 0)
    assert pulse.excitation(1.25 * pulse.duration) == 0


@pytest.mark.parametrize("shape", PULSE_SHAPES)
@pytest.mark.parametrize("amplitude", [0.3, -0.3])
def test_pulse_peaks_at_its_amplitude(shape, amplitude):
    values = Pulse(shape, amplitude, OMEGA).excitation(times_of(shape, 20001))
    assert np.max(np.abs(values)) == pytest.approx(0.3, rel=1e-4)


def test_antisymmetric_ricker_peaks_at_its_amplitude_to_the_digits_of_its_norm():
    pulse = Pulse("ricker-antisymmetric", 0.3, OMEGA)
    # 1.3801 is rounded: the peak is the amplitude to about 3e-5, no better
    assert pulse.excitation(RICKER_CENTRE + ANTISYMMETRIC_PEAK) == pytest.approx(-0.3, rel=1e-4)
    assert pulse.excitation(RICKER_CENTRE - ANTISYMMETRIC_PEAK) == pytest.approx(0.3, rel=1e-4)


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_negative_amplitude_mirrors_the_pulse_to_the_last_bit(shape):
    time = times_of(shape)
    plus, minus = Pulse(shape, 0.3, OMEGA), Pulse(shape, -0.3, OMEGA)
    np.testing.assert_array_equal(minus.excitation(time), -plus.excitation(time))
    assert minus.duration == plus.duration


@pytest.mark.parametrize("shape", ["one-sine", "ricker-antisymmetric"])
def test_antisymmetric_pulse_is_odd_about_its_middle(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    ahead = np.linspace(0.0, 0.499 * pulse.duration, 501)
    middle = pulse.duration / 2
    np.testing.assert_allclose(
        pulse.excitation(middle + ahead), -pulse.excitation(middle - ahead), atol=1e-13
    )


@pytest.mark.parametrize("shape", ["one-cosine", "half-sine", "constant", "ricker-symmetric"])
def test_symmetric_pulse_is_even_about_its_middle(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    ahead = np.linspace(0.0, 0.499 * pulse.duration, 501)
    middle = pulse.duration / 2
    np.testing.assert_allclose(
        pulse.excitation(middle + ahead), pulse.excitation(middle - ahead), atol=1e-13
    )


@pytest.mark.parametrize(
    ("shape", "tolerance"), [("one-sine", 1e-9), ("one-cosine", 1e-9), ("ricker-symmetric", 1e-6)]
)
def test_ground_comes_to_rest_when_the_pulse_ends(shape, tolerance):
    pulse = Pulse(shape, 1.0, OMEGA)
    time = np.linspace(0.0, pulse.duration, 20001)
    velocity = np.trapezoid(pulse.excitation(time), time)
    assert velocity / PERIOD == pytest.approx(0.0, abs=tolerance)


def test_half_sine_leaves_the_ground_moving_at_two_amplitudes_over_frequency():
    pulse = Pulse("half-sine", 0.3, OMEGA)
    time = np.linspace(0.0, pulse.duration, 20001)
    velocity = np.trapezoid(pulse.excitation(time), time)
    assert velocity == pytest.approx(2 * 0.3 / OMEGA, rel=1e-7)


def test_one_sine_is_a_cycle_of_the_harmonic():
    time = np.linspace(0.0, 0.9999 * PERIOD, 301)
    np.testing.assert_array_equal(
        Pulse("one-sine", 0.3, OMEGA).excitation(time),
        Pulse("harmonic", 0.3, OMEGA).excitation(time),
    )


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_frequency_stretches_time_alone(shape):
    fast, slow = Pulse(shape, 0.3, 2 * OMEGA), Pulse(shape, 0.3, OMEGA)
    time = times_of(shape)[1:-1]
    np.testing.assert_allclose(fast.excitation(time / 2), slow.excitation(time), atol=1e-14)


# ---------------------------------------------------------------------------- interface


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_scaled_pulse_differs_in_amplitude_alone(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    assert pulse.scaled(-2.0) == Pulse(shape, -0.6, OMEGA)
    assert pulse.amplitude == 0.3


@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_excitation_of_an_array_is_that_of_its_elements(shape):
    pulse = Pulse(shape, 0.3, OMEGA)
    time = np.linspace(-1.0, 5.5 * PERIOD, 60).reshape(3, 20)
    values = pulse.excitation(time)
    assert isinstance(values, np.ndarray)
    assert values.shape == time.shape
    expected = [[pulse.excitation(float(t)) for t in row] for row in time]
    np.testing.assert_allclose(values, expected, rtol=1e-15, atol=1e-16)


@pytest.mark.parametrize("shape", PULSE_SHAPES)
@pytest.mark.parametrize("time", [-1.0, 0.0, 1, 0.3, 1e6])
def test_excitation_at_one_time_is_a_float(shape, time):
    assert isinstance(Pulse(shape, 0.3, OMEGA).excitation(time), float)


def test_excitation_leaves_the_times_alone():
    time = np.linspace(-1.0, 5.0, 50)
    kept = time.copy()
    Pulse("one-sine", 0.3, OMEGA).excitation(time)
    np.testing.assert_array_equal(time, kept)


def test_pulses_are_frozen():
    pulse = Pulse("one-sine", 0.3, OMEGA)
    with pytest.raises(AttributeError):
        pulse.amplitude = 0.4


# ---------------------------------------------------------------------------- bad input


def test_unknown_shape_is_refused_with_the_list_of_shapes():
    with pytest.raises(ValueError, match="sawtooth") as error:
        Pulse("sawtooth", 0.3, OMEGA)
    for shape in PULSE_SHAPES:
        assert error.match(shape)


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("onesine", "one-sine"),
        ("One-Sine", "one-sine"),
        ("half_sine", "half-sine"),
        ("ricker-symetric", "ricker-symmetric"),
    ],
)
def test_near_miss_of_a_shape_is_answered_with_a_suggestion(typed, meant):
    with pytest.raises(ValueError, match=f"(?is)(did you mean|meant|perhaps).{{0,8}}{meant}"):
        Pulse(typed, 0.3, OMEGA)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_amplitude_that_is_not_finite_is_refused(value):
    with pytest.raises(ValueError, match=f"amplitude.*{value}"):
        Pulse("one-sine", value, OMEGA)


@pytest.mark.parametrize("value", [0.0, -2.5, math.nan, math.inf])
def test_frequency_that_is_not_positive_is_refused(value):
    with pytest.raises(ValueError, match=f"angular_frequency.*{value:g}"):
        Pulse("one-sine", 0.3, value)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_factor_that_is_not_finite_is_refused(value):
    with pytest.raises(ValueError, match=str(value)):
        Pulse("one-sine", 0.3, OMEGA).scaled(value)


@pytest.mark.parametrize("value", ["0.31", True, np.array([0.3, 0.4]), np.ma.masked, None])
def test_what_is_no_number_is_refused(value):
    for name, make in (
        ("amplitude", lambda: Pulse("one-sine", value, OMEGA)),
        ("angular_frequency", lambda: Pulse("one-sine", 0.3, value)),
        ("factor", lambda: Pulse("one-sine", 0.3, OMEGA).scaled(value)),
    ):
        with pytest.raises(ValueError, match=rf"^{name} is .*; expected a number$"):
            make()


def test_times_that_are_no_numbers_are_refused():
    pulse = Pulse("one-sine", 0.3, OMEGA)
    with pytest.raises(ValueError, match=r"^t: element 0 is '0\.3'; expected a number$"):
        pulse.excitation("0.3")
    with pytest.raises(ValueError, match=r"^t has 1 masked of 2 elements"):
        pulse.excitation(np.ma.array([0.1, 0.2], mask=[0, 1]))
