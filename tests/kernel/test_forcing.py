"""The ground as the kernel has it: pulses, records, and two records at once."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from steps.shared import plain
from tests.cases import pulse_forcing
from topheavy import Pulse, Record, RockingBlock
from topheavy.ground.shapes import PULSE_SHAPES
from topheavy.kernel.forcing import (
    bounds_after,
    equation,
    extent,
    forcing_of,
    ground,
    impulse_after,
    next_uplift,
    piece_of,
    record_waveform,
    unit_pulse,
    variation,
)
from topheavy.kernel.rest import comes_to_rest
from topheavy.kernel.taylor import Method, State, oscillator

RATIO = 2.5  # ω/p; with p = 1 the kernel's time is that of a `Pulse`
PULSES = [*((shape, 1) for shape in PULSE_SHAPES), ("one-sine", 3), ("one-cosine", 7)]
EVERY = pytest.mark.parametrize(("shape", "cycles"), PULSES)


def inside(shape: str, number: int = 97, cycles: int = 1) -> np.ndarray:
    """Times within the pulse, neither its start nor its end."""
    end = min(pulse_forcing(shape, 1.0, RATIO, cycles).end, 6.0 * cycles)
    return end * (np.arange(number) + 0.37) / number


@EVERY
def test_pulse_is_that_of_the_library(shape, cycles):
    pulse = Pulse(shape, -0.7, angular_frequency=RATIO, cycles=cycles)
    forcing = pulse_forcing(shape, -0.7, RATIO, cycles)
    assert forcing.end == pytest.approx(pulse.duration, rel=1e-15)
    times = inside(shape, cycles=cycles)
    values = [ground(forcing, time)[0] for time in times]
    np.testing.assert_allclose(values, pulse.excitation(times), rtol=0, atol=1e-14)


@EVERY
def test_every_pulse_solves_its_linear_equation(shape, cycles):
    """a'' = −c a − (d₀ + d₁ (τ − τ₀)) a' about any τ₀: at τ₀ itself, and away from it."""
    forcing, h = pulse_forcing(shape, 1.3, RATIO, cycles), 1e-5
    for time in inside(shape, cycles=cycles):
        value, rate, _, _ = ground(forcing, time)
        bend = ground(forcing, time + h)[1] - ground(forcing, time - h)[1]
        for start in (time, time - 0.3):
            c, d0, d1 = equation(forcing, start)
            drag = d0 + d1 * (time - start)
            assert bend / (2 * h) == pytest.approx(-c * value - drag * rate, abs=1e-7)


def first_above(pulse: Pulse, start: float, stop: float, level: float) -> float:
    """Between the turning points of the plain solver |a| passes a level upward once at most."""
    corners = plain.ground_of(pulse, duration=stop)[0].corners / RATIO

    def excess(time: float) -> float:
        return abs(float(pulse.excitation(time))) - level

    for low, high in pairwise([start, *corners[corners > start]]):
        if excess(low) > 0.0:
            return low
        if excess(high) > 0.0:
            return brentq(excess, low, high, xtol=1e-300, rtol=1e-15, maxiter=10_000)
    return math.inf


@EVERY
@pytest.mark.parametrize("strength", [-0.9, 0.5, 1.0001, -1.2, 2.3, -3.3, 40.0])
def test_uplifts_are_those_between_the_turning_points(shape, cycles, strength):
    level = 0.25
    forcing = pulse_forcing(shape, strength * level, RATIO, cycles)
    pulse = Pulse(shape, strength * level, angular_frequency=RATIO, cycles=cycles)
    for start in (0.0, *inside(shape, 23, cycles)):
        expected = first_above(pulse, start, min(8.0 * cycles, pulse.duration), level)
        time, push, rate, side = next_uplift(forcing, start, level)
        if expected == math.inf and (shape != "harmonic" or abs(strength) <= 1.0):
            assert time == math.inf
        elif expected < math.inf:
            assert time == pytest.approx(expected, rel=1e-13)
            value = unit_pulse(forcing.wave, RATIO * time)[0] * strength * level
            assert side == -math.copysign(1.0, value)
            assert push == pytest.approx(abs(value) - level, abs=1e-14)
            assert push > 0.0 or rate > 0.0
            if time > start:  # it passes the level there: the excess is zero and not a rounding
                assert push == 0.0


def test_record_is_that_of_the_library():
    samples = np.random.default_rng(1).normal(size=40)
    record = record_waveform(samples)
    forcing = forcing_of(record, 0.07, -1.5, 0.0)
    library = Record(0.07, -1.5 * samples, unit="g")
    assert forcing.end == pytest.approx(library.duration)
    times = np.linspace(0.0, forcing.end, 333)[:-1]
    motion = np.array([ground(forcing, time) for time in times])
    np.testing.assert_allclose(motion[:, 0], library.excitation(times), atol=1e-13)
    pieces = [piece_of(forcing, time) for time in times]
    slopes = (np.diff(library.acceleration) / 0.07)[pieces]
    np.testing.assert_allclose(motion[:, 1], slopes, rtol=1e-12)
    assert ground(forcing, forcing.end) == (0.0, 0.0, 1.0, 0.0)


BLOCK = oscillator(RockingBlock(1.0, 0.2, 0.9))
STEP = 0.02
RATIOS = pytest.mark.parametrize("ratio", [1.0, 0.5, 3.0, 0.731])


def waves(seed, samples, step=STEP):
    """A few sines under an envelope that does not end at zero."""
    rng, time = np.random.default_rng(seed), step * np.arange(samples)
    total = sum(rng.normal() * np.sin(f * time + rng.uniform(0, 6)) for f in (2.0, 3.7, 6.1, 11.0))
    return total * (0.1 + np.sin(math.pi * time / time[-1]) ** 2)


def shaken(seed, ratio, samples=700, upward=500):
    """A horizontal record of largest 1, a vertical one of largest 0.5, and the two prepared."""
    across, up = waves(seed, samples), waves(seed + 50, round(upward / ratio), ratio * STEP)
    across, up = across / np.abs(across).max(), 0.5 * up / np.abs(up).max()
    return across, up, record_waveform(across, up, ratio)


def push_at(motion, time, level):
    """|a| − G level."""
    value, _, weight, _ = ground(motion, time)
    return abs(value) - weight * level


@RATIOS
@pytest.mark.parametrize("factor", [0.25, -0.5, 1.0])
def test_next_uplift_is_the_first_time_that_the_push_is_positive(ratio, factor):
    """Against a fine scan of |a| − G level, from many times on."""
    _, _, waveform = shaken(2, ratio)
    forcing = forcing_of(waveform, STEP, factor, 0.9)
    times = np.linspace(0.0, forcing.end, 80_001)[:-1]
    push = np.array([push_at(forcing, time, 0.2) for time in times])
    seen = set()
    for first in range(0, times.size, 1337):
        over = np.flatnonzero(push[first:] > 1e-9)
        time, excess, rate, side = next_uplift(forcing, times[first], 0.2)
        seen.add(over.size > 0)
        if not over.size:
            assert time == math.inf or abs(ground(forcing, time)[0]) < 0.2 + 1e-6
            continue
        begin = times[first + over[0]]
        assert begin - times[1] - 1e-12 <= time <= begin
        assert side == -math.copysign(1.0, ground(forcing, begin)[0])
        assert excess == 0.0 or time == times[first] or excess > 0.0
        assert push_at(forcing, time + 1e-7, 0.2) - excess == pytest.approx(1e-7 * rate, abs=1e-8)
    assert True in seen


def test_bounds_hold_for_the_rest_of_both_records():
    _, _, waveform = shaken(3, 0.731)
    forcing = forcing_of(waveform, STEP, 2.0, -1.1)
    times = np.linspace(0.0, forcing.end, 4001)[:-1]
    weights = np.array([ground(forcing, time)[2] for time in times])
    pushes = np.array([abs(ground(forcing, time)[0]) for time in times]) / weights
    for k in range(0, times.size, 37):
        strength, heaviest = bounds_after(forcing, times[k])
        assert strength >= pushes[k:].max()
        assert heaviest >= weights[k:].max()
    assert bounds_after(forcing, forcing.end) == (0.0, 1.0)
    falling = forcing_of(waveform, STEP, 2.0, 2.0)
    assert bounds_after(falling, 0.0)[0] == math.inf


def test_impulse_and_variation_of_two_records_bound_those_that_are_left():
    """Against a fine scan, in which a piece that passes zero has less impulse than its chord."""
    _, _, waveform = shaken(5, 0.731)
    forcing = forcing_of(waveform, STEP, 2.0, -1.1)
    times = np.linspace(0.0, 1.01 * forcing.end, 60_001)
    motion = np.array([ground(forcing, time) for time in times])
    a, v = motion[:, 0], motion[:, 2] - 1.0
    steps = np.abs(np.diff(a)) + 0.2 * np.abs(np.diff(v))
    for k in range(0, times.size, 1771):
        impulses = impulse_after(
            forcing, times[k], min(piece_of(forcing, times[k]), waveform.record.shape[1] - 1)
        )
        for impulse, left in zip(impulses, (a, v), strict=True):
            exact = np.trapezoid(np.abs(left[k:]), times[k:])
            assert exact - 1e-9 <= impulse <= 1.2 * exact + 2 * STEP * np.abs(left).max()
        for end in (k + 3, k + 700, times.size - 1):
            end = min(end, times.size - 1)
            bound, exact = variation(forcing, times[k], times[end], 0.2), steps[k:end].sum()
            assert exact * (1 - 1e-9) - 1e-9 <= bound <= exact + steps.max() + 1e-9


@EVERY
def test_extent_and_impulse_of_a_pulse_are_those_of_a_fine_scan(shape, cycles):
    pulse = pulse_forcing(shape, -0.7, RATIO, cycles)
    if pulse.end == math.inf:
        return
    times = np.linspace(0.0, pulse.end * (1 - 1e-12), 40_001)
    a = np.array([ground(pulse, time)[0] for time in times])
    for k in range(1, times.size - 1, 999):
        impulse, exact = (
            impulse_after(pulse, times[k], 0)[0],
            np.trapezoid(np.abs(a[k:]), times[k:]),
        )
        assert impulse == math.inf or impulse == pytest.approx(exact, rel=1e-3, abs=1e-6)
        for end in (min(k + 500, times.size - 1), times.size - 1):
            largest, changes = extent(pulse, times[k], times[end])
            assert largest == pytest.approx(np.abs(a[k : end + 1]).max(), rel=1e-6)
            exact = np.abs(np.diff(a[k : end + 1])).sum()
            assert changes == pytest.approx(exact, rel=1e-4) or 8.0 < changes < exact
        beyond = extent(pulse, times[k], 1.1 * pulse.end)[1]
        assert beyond == pytest.approx(changes + abs(a[-1]), abs=1e-9)
        assert np.isfinite(impulse) == (
            "ricker" in shape and (np.sign(a[k:-1]) == np.sign(a[-1])).all()
        )


def test_rest_is_not_called_when_gravity_is_about_to_fall():
    """The ground pushes at 0.9 of the level all the time; gravity falls below that at sample 20."""
    across, up = np.full(200, 0.9 * BLOCK.uplift_level), np.zeros(200)
    up[20:] = -0.2
    for lift, expected in ((1.0, False), (0.0, True), (0.04, True)):
        waveform = record_waveform(across, up, 1.0)
        forcing = forcing_of(waveform, 1e-3, 1.0, lift)
        for side in (-1.0, 1.0):
            push = -side * 0.9 * BLOCK.uplift_level - BLOCK.uplift_level
            state = State(0.0185, side, 0.0, 2e-6, 0.0, 1.0, push, 0.0, 1.0, 0.0)
            method = Method(8, 3e-10, True)
            assert comes_to_rest(BLOCK, forcing, state, method, 1.0) is expected
