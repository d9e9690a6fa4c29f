"""The ground motion as the kernel sees it: each pulse by its equation, its turns, its uplifts."""

import math

import numpy as np
import pytest

from topheavy import Pulse, Record
from topheavy.kernel import forcing
from topheavy.kernel.forcing import (
    NO_RECORD,
    SHAPES,
    equation,
    ground,
    next_uplift,
    piece_at,
    prepare_record,
    pulse_forcing,
    record_forcing,
    unit_pulse,
)

RATIO = 2.5  # ω/p; with p = 1 the kernel's time is that of a `Pulse`
EVERY = pytest.mark.parametrize("shape", sorted(SHAPES))


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
