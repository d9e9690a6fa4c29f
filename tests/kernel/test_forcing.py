"""The ground motion as the kernel sees it: each pulse by its equation, its turns, its uplifts."""

import math

import numpy as np
import pytest

from topheavy import Pulse, Record
from topheavy.kernel import forcing
from topheavy.kernel.forcing import (
    IMPULSE,
    NO_RECORD,
    RUN,
    SHAPES,
    equation,
    ground,
    next_turn,
    next_uplift,
    piece_at,
    prepare_record,
    pulse_forcing,
    record_forcing,
    strongest_after,
    unit_pulse,
)

RATIO = 2.5  # ω/p; with p = 1 the kernel's time is that of a `Pulse`
EVERY = pytest.mark.parametrize("shape", sorted(SHAPES))
ENDING = pytest.mark.parametrize("shape", sorted(set(SHAPES) - {"harmonic"}))


def inside(shape: str, number: int = 97) -> np.ndarray:
    """Times within the pulse, neither its start nor its end."""
    end = min(pulse_forcing(SHAPES[shape], 1.0, RATIO).end, 6.0)
    return end * (np.arange(number) + 0.37) / number


@EVERY
def test_pulse_is_that_of_the_library(shape):
    pulse, there = Pulse(shape, -0.7, RATIO), pulse_forcing(SHAPES[shape], -0.7, RATIO)
    assert there.end == pytest.approx(pulse.duration, rel=1e-15)
    values = [ground(there, NO_RECORD, time)[0] for time in inside(shape)]
    np.testing.assert_allclose(values, pulse.excitation(inside(shape)), rtol=0, atol=1e-14)


@EVERY
def test_second_value_is_the_derivative(shape):
    there, h = pulse_forcing(SHAPES[shape], -0.7, RATIO), 1e-5
    for time in inside(shape):
        rise = ground(there, NO_RECORD, time + h)[0] - ground(there, NO_RECORD, time - h)[0]
        assert ground(there, NO_RECORD, time)[1] == pytest.approx(rise / (2 * h), abs=1e-8)


@EVERY
def test_every_pulse_solves_its_linear_equation(shape):
    """a'' = −c a − (d₀ + d₁ (τ − τ₀)) a' about any τ₀: at τ₀ itself, and away from it."""
    there, h = pulse_forcing(SHAPES[shape], 1.3, RATIO), 1e-5
    for time in inside(shape):
        value, rate = ground(there, NO_RECORD, time)
        bend = ground(there, NO_RECORD, time + h)[1] - ground(there, NO_RECORD, time - h)[1]
        for start in (time, time - 0.3):
            c, d0, d1 = equation(there, start)
            drag = d0 + d1 * (time - start)
            assert bend / (2 * h) == pytest.approx(-c * value - drag * rate, abs=1e-7)


@ENDING
def test_ground_rests_once_the_pulse_is_over(shape):
    there = pulse_forcing(SHAPES[shape], 0.7, RATIO)
    assert ground(there, NO_RECORD, there.end) == (0.0, 0.0)
    assert strongest_after(there, NO_RECORD, there.end)[0] == 0.0
    assert equation(there._replace(shape=forcing.NONE), 0.0) == (0.0, 0.0, 0.0)


@EVERY
def test_bound_on_what_is_left_holds(shape):
    there = pulse_forcing(SHAPES[shape], -0.7, RATIO)
    largest = max(abs(ground(there, NO_RECORD, time)[0]) for time in inside(shape, 20_001))
    assert largest <= strongest_after(there, NO_RECORD, 0.0)[0] < 0.7 * 1.001


@EVERY
def test_pulse_is_monotone_between_its_turns(shape):
    there = pulse_forcing(SHAPES[shape], 0.7, RATIO)
    time, pieces = 0.0, 0
    while time < min(there.end, 10.0):
        turn = next_turn(there, time)
        assert turn > time
        assert next_turn(there, 0.5 * (time + turn)) == turn
        values = [0.7 * unit_pulse(there.shape, RATIO * t)[0] for t in np.linspace(time, turn, 200)]
        steps = np.diff(values)
        assert (steps >= -1e-15).all() or (steps <= 1e-15).all()
        time, pieces = turn, pieces + 1
    expected = {"constant": 1, "half-sine": 2, "one-cosine": 2, "one-sine": 3}
    expected |= {"ricker-symmetric": 4, "ricker-antisymmetric": 5, "harmonic": 9}
    assert pieces == expected[shape]
    if shape != "harmonic":
        assert time == there.end
        assert next_turn(there, math.nextafter(there.end, 0.0)) == there.end


@EVERY
@pytest.mark.parametrize("strength", [-0.9, 0.5, 1.0001, -1.2, 2.3, -3.3, 40.0])
def test_uplifts_are_those_that_the_segments_have(shape, strength):
    level = 0.25
    there = pulse_forcing(SHAPES[shape], strength * level, RATIO)
    pulse = Pulse(shape, strength * level, RATIO)
    for start in (0.0, *inside(shape, 23)):
        expected = math.inf
        for segment in pulse.segments(8.0):
            found = segment.uplift(max(start, segment.start), level)
            if segment.stop > start and found is not None:
                expected = found
                break
        time, push, rate, side = next_uplift(there, NO_RECORD, start, level)
        if expected == math.inf and (shape != "harmonic" or abs(strength) <= 1.0):
            assert time == math.inf
        elif expected < math.inf:
            assert time == pytest.approx(expected, rel=1e-13)
            value = unit_pulse(there.shape, RATIO * time)[0] * strength * level
            assert side == -math.copysign(1.0, value)
            assert push == pytest.approx(abs(value) - level, abs=1e-14)
            assert push > 0.0 or rate > 0.0
            if time > start:  # it passes the level there: the excess is zero and not a rounding
                assert push == 0.0


@EVERY
@pytest.mark.parametrize("strength", [1.0001, -2.0, 12.0])
def test_a_motion_that_is_cut_off_lifts_when_the_whole_does_or_not_at_all(shape, strength):
    whole = pulse_forcing(SHAPES[shape], strength * 0.25, RATIO)
    for start in (0.0, *inside(shape, 7)):
        time, *rest = next_uplift(whole, NO_RECORD, start, 0.25)
        for cut in inside(shape, 31):
            found = next_uplift(whole._replace(end=cut), NO_RECORD, start, 0.25)
            if start < cut and time < cut:
                assert found == pytest.approx((time, *rest), rel=1e-12, abs=1e-14)
            else:
                assert found[0] == math.inf


def test_amplitude_at_the_level_does_not_lift():
    for shape in ("one-sine", "one-cosine", "half-sine", "constant", "harmonic"):
        for sign in (-1.0, 1.0):
            there = pulse_forcing(SHAPES[shape], sign * 0.25, RATIO)
            assert next_uplift(there, NO_RECORD, 0.0, 0.25)[0] == math.inf


def test_antisymmetric_wavelet_exceeds_its_amplitude_by_its_five_digits():
    for strength, lifts in ((1 - 1.3e-5, True), (1 - 1.5e-5, False)):
        there = pulse_forcing(forcing.RICKER_ANTISYMMETRIC, strength * 0.25, RATIO)
        assert (next_uplift(there, NO_RECORD, 0.0, 0.25)[0] < math.inf) == lifts


def test_way_8_a_ricker_wavelet_lifts_the_block_in_its_side_lobe():
    level = math.tan(math.radians(14.0))
    pulse = pulse_forcing(forcing.RICKER_SYMMETRIC, 3 * level, 2.0)
    time, push, rate, side = next_uplift(pulse, NO_RECORD, 0.0, level)
    phase = 2.0 * time
    assert phase < forcing.RICKER_TURNS[0, 0]
    assert push == 0.0
    assert rate > 0.0
    assert side == 1.0  # the side lobe is negative
    assert 3 * unit_pulse(forcing.RICKER_SYMMETRIC, phase)[0] == pytest.approx(-1, rel=1e-13)


# ---------------------------------------------------------------------------- records


def test_record_is_that_of_the_library():
    samples = np.random.default_rng(1).normal(size=40)
    record, there = prepare_record(samples), record_forcing(prepare_record(samples), 0.07, -1.5)
    library = Record(0.07, -1.5 * samples, unit="g")
    assert there.end == pytest.approx(library.duration)
    times = np.linspace(0.0, there.end, 333)[:-1]
    found = np.array([ground(there, record, time) for time in times])
    np.testing.assert_allclose(found[:, 0], library.excitation(times), atol=1e-13)
    slopes = (np.diff(library.acceleration) / 0.07)[[piece_at(there, time) for time in times]]
    np.testing.assert_allclose(found[:, 1], slopes, rtol=1e-12)
    assert ground(there, record, there.end) == (0.0, 0.0)


def test_strongest_sample_still_to_come_is_kept_below_each_sample():
    record = prepare_record(np.array([0.1, -0.8, 0.3, 0.5, -0.2]))
    np.testing.assert_array_equal(record[1], [0.8, 0.8, 0.5, 0.5, 0.2])
    there = record_forcing(record, 0.5, -2.0)
    assert strongest_after(there, record, 0.6)[0] == 1.6  # of the piece that begins at 0.5
    assert strongest_after(there, record, 1.1)[0] == 1.0
    assert strongest_after(there, record, 2.0)[0] == 0.0


@pytest.mark.parametrize("factor", [-1.0, 1.0, 2.7])
def test_uplifts_of_a_record_are_those_that_its_segments_have(factor):
    samples, level = np.random.default_rng(2).normal(size=60) * 0.15, 0.25
    record = prepare_record(samples)
    there, library = record_forcing(record, 0.07, factor), Record(0.07, factor * samples, unit="g")
    for start in np.linspace(0.0, 59 * 0.07, 201):
        expected = math.inf
        for segment in library.segments(math.inf):
            if segment.stop > start:
                found = segment.uplift(max(start, segment.start), level)
                if found is not None:
                    expected = found
                    break
        time, push, rate, side = next_uplift(there, record, start, level)
        assert time == (expected if expected == math.inf else pytest.approx(expected, rel=1e-12))
        if time < math.inf:
            assert side == -math.copysign(1.0, library.excitation(time))
            assert push == pytest.approx(abs(library.excitation(time)) - level, abs=1e-13)
            assert push > 0.0 or rate > 0.0
            assert push == 0.0 or time == start


def test_record_that_is_over_lifts_nothing():
    record = prepare_record(np.array([0.0, 0.5, 0.5]))
    there = record_forcing(record, 1.0, 1.0)
    assert next_uplift(there, record, 1.9, 0.25)[1:3] == (0.25, 0.0)
    assert next_uplift(there, record, 2.0, 0.25)[0] == math.inf


def test_uplift_in_a_record_uses_the_piece_that_begins():
    """(k Δ)/Δ rounds to below k for some k, which names the piece before."""
    step = 2.14 * 0.01
    rounded_down = [k for k in range(1, 5000) if int((k * step) / step) < k]
    assert rounded_down
    for k in rounded_down[:50]:
        samples = np.zeros(k + 3)
        samples[k + 1] = 1.0
        record = prepare_record(samples)
        there = record_forcing(record, step, 1.0)
        assert piece_at(there, k * step) == k
        assert piece_at(there, math.nextafter(k * step, 0.0)) == k - 1
        assert ground(there, record, k * step)[1] == pytest.approx(1 / step)
        assert next_turn(there, k * step) == (k + 1) * step


def first_sample_above(samples, factor, level, time, step):
    """The number of the first sample after `time` that exceeds the level, one by one."""
    return next(
        (k for k, a in enumerate(samples) if k * step > time and abs(factor * a) > level), None
    )


@pytest.mark.parametrize("length", [2, RUN - 1, RUN, RUN + 1, 5 * RUN + 3])
def test_wait_for_uplift_passes_over_weak_runs_only(length):
    rng, step = np.random.default_rng(length), 0.02
    for strong in (0.02, 0.2):
        samples = rng.uniform(-0.1, 0.1, length)
        samples[rng.random(length) < strong] *= rng.choice([5.0, 7.0])
        record = prepare_record(samples)
        for factor in (1.0, -1.3):
            forcing = record_forcing(record, step, factor)
            for time in np.linspace(0.0, forcing.end, 41)[:-1]:
                if abs(ground(forcing, record, time)[0]) > 0.3:
                    continue
                lifted, _, _, _ = next_uplift(forcing, record, time, 0.3)
                k = first_sample_above(samples, factor, 0.3, time, step)
                if k is None:
                    assert lifted == math.inf
                else:
                    assert max(time, (k - 1) * step) <= lifted <= k * step


def test_impulse_to_come_is_the_area_under_the_moduli_of_the_samples():
    samples = np.sin(np.arange(40) ** 2)
    for k in (0, 7, 38, 39):
        area = np.trapezoid(np.abs(samples[k:]))
        assert prepare_record(samples)[IMPULSE, k] == pytest.approx(area, abs=1e-14)


def test_largest_of_each_run_is_kept():
    samples = np.sin(np.arange(3 * RUN + 5) ** 2)
    runs = prepare_record(samples)[2]
    for k in range(4):
        assert runs[k] == np.abs(samples[k * RUN : (k + 1) * RUN]).max()
