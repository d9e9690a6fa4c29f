"""simulate(): published overturning amplitudes, closed forms, and the ways solvers go wrong."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from topheavy import (
    Column,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    judge,
    overturning_intervals,
    overturning_map,
    reference,
    simulate,
)
from topheavy.checks import LARGEST_ACCELERATION

BLOCK = RockingBlock(2.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
OUTCOMES = ("no uplift", "rests", "rocking", "overturned")


def energy(block: RockingBlock, rotation, velocity):
    """Energy above the block standing upright, in units of p²."""
    tilt = np.abs(rotation)
    kinetic = 0.5 * (np.asarray(velocity) / block.frequency_parameter) ** 2
    if block.linearised:
        return kinetic + tilt * (block.slenderness - tilt / 2)
    return kinetic + np.cos(block.slenderness - tilt) - math.cos(block.slenderness)


def quarter_period(block: RockingBlock, rotation: float) -> float:
    """p times the time from `rotation`, released, to upright: quadrature of the energy integral."""
    incline = block.slenderness - rotation

    def slowness(root):  # θ = θ0 − s² takes the singularity at the turning point away
        half = root**2 / 2
        if block.linearised:
            return 2 / math.sqrt(2 * (incline + half))
        lost = math.sin(half) / half if half > 0 else 1.0
        return 2 / math.sqrt(2 * math.sin(incline + half) * lost)

    value, _ = quad(slowness, 0.0, math.sqrt(rotation), epsabs=1e-12, epsrel=1e-12)
    return value


# ---------------------------------------------------------------------------- brute force


@dataclass(frozen=True)
class Brute:
    peak: float  # NaN if overturned
    overturned: bool


GROUND = {  # shape: its duration in cycles T = 2π/ω, and its value as a function of t/T
    "one-sine": (1.0, lambda cycles: math.sin(2 * math.pi * cycles)),
    "one-cosine": (1.0, lambda cycles: math.cos(2 * math.pi * cycles)),
    "ricker-symmetric": (
        4.5,
        lambda cycles: (
            (1 - 2 * (math.pi * (cycles - 2.25)) ** 2)
            * math.exp(-((math.pi * (cycles - 2.25)) ** 2))
        ),
    ),
}


def brute_force(
    block: RockingBlock, shape: str, amplitude: float, omega: float, steps: int = 1600
) -> Brute:
    """Response of the exact equation to a pulse by fixed small Runge-Kutta steps, in plain Python.

    Shares nothing with the library: x = |θ|, the side is a state, impacts and turning points are
    roots within a step, and the free motion afterwards is integrated until it lies flat or has
    met the ground twice. Bounces below 1e-10 α are at rest.
    """
    p, alpha, keep = block.frequency_parameter, block.slenderness, block.restitution
    cycles, form = GROUND[shape]
    end = 2 * math.pi / omega * cycles
    step = end / steps

    def pulse(t):
        return amplitude * form(omega * t / (2 * math.pi))

    def ground(t):
        return pulse(t) if t < end else 0.0

    def fall(x, side, a):  # Eq. (23) for x = side θ
        return -(p**2) * (math.sin(alpha - x) + side * a * math.cos(alpha - x))

    def advance(t, x, v, side, h):
        a0, a1, a2 = (pulse(s) if t < end - step / 2 else 0.0 for s in (t, t + h / 2, t + h))
        k1 = fall(x, side, a0)
        k2 = fall(x + h / 2 * v, side, a1)
        k3 = fall(x + h / 2 * v + h * h / 4 * k1, side, a1)
        k4 = fall(x + h * v + h * h / 2 * k2, side, a2)
        return (x + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4))

    def first_root(function, h):
        return brentq(function, 0.0, h, xtol=1e-15, rtol=1e-14)

    x, v, side, peak, bounces, index = 0.0, 0.0, 0, 0.0, 0, 0
    threshold = math.tan(alpha)
    while True:
        t, stop = index * step, (index + 1) * step
        index += 1
        while t < stop:
            h = stop - t
            if side == 0:  # at rest
                if index > steps:
                    return Brute(peak, False)
                if abs(ground(stop)) <= threshold or index == steps:
                    break
                sign = math.copysign(1.0, ground(stop))

                def excess(s, t=t, sign=sign):
                    return sign * pulse(t + s) - threshold

                t += first_root(excess, h) if excess(0.0) < 0 else 0.0
                x, v, side = 0.0, 0.0, -int(sign)
                continue
            x1, v1 = advance(t, x, v, side, h)
            if v > 0 > v1 or v < 0 < v1:  # a turning point within the step

                def turning(s, state=(t, x, v, side)):
                    return advance(*state, s)[1]

                s = first_root(turning, h)
                x_turn = advance(t, x, v, side, s)[0]
                if x_turn < 0 or v > 0:
                    peak = max(peak, x_turn)
                if x_turn < 0:  # a grazing impact on the way
                    x1, h = x_turn, s
            if x1 >= 0:
                t, x, v = t + h, x1, v1
                peak = max(peak, x)
                if x >= math.pi / 2:
                    return Brute(math.nan, True)
                continue

            def height(s, state=(t, x, v, side)):  # over s, which takes the root at zero away
                if state[1] > 0:
                    return advance(*state, s)[0]
                return advance(*state, s)[0] / s if s > 0 else state[2]

            s = first_root(height, h)
            v = -keep * advance(t, x, v, side, s)[1]
            t, x, side = t + s, 0.0, -side
            bounces += index > steps
            a = ground(t)
            pull = -fall(0.0, side, a)
            if v <= 0 or (pull > 0 and v * v / (2 * pull) < 1e-10 * alpha):
                v, side = 0.0, 0 if abs(a) <= threshold else -int(math.copysign(1.0, a))
            if bounces == 2:
                return Brute(peak, False)


# ---------------------------------------------------------------------------- published numbers


@dataclass(frozen=True)
class Boundary:
    source: str
    block: RockingBlock
    shape: str
    omega: float
    value: float  # (g), or αg for a linear block whose unit is α
    unit: float
    tolerance: float
    overturns_above: bool
    impacts: int | None  # before overturning, just across the boundary


def _frame_of_zhou() -> RockingBlock:
    return RockingFrame(Column(0.75, 3.5), 13.23).block()


def _no_impact_root(ratio: float) -> float:
    """Lowest a/αg that overturns a linear block without impact; ratio = ω/p."""

    def condition(psi):
        swing = ratio * math.sin(psi) - math.cos(psi)
        return swing + math.exp(-(2 * math.pi - psi) / ratio)

    return 1 / math.sin(brentq(condition, 1e-6, 0.5, xtol=1e-15))


LINEAR = RockingBlock(1.0, 0.2, 0.9, linearised=True)
TALL = RockingBlock(2.14, 0.25, 0.9, linearised=True)
BOUNDARIES = [
    Boundary("Zhang & Makris 2001, lowest", LINEAR, "one-sine", 5.0, 3.0186, 0.2, 1e-3, True, None),
    Boundary(
        "Zhang & Makris 2001, with impact ends",
        LINEAR,
        "one-sine",
        5.0,
        6.3181,
        0.2,
        1e-3,
        False,
        1,
    ),
    Boundary(
        "Zhang & Makris 2001, without impact", LINEAR, "one-sine", 5.0, 7.16813, 0.2, 1e-5, True, 0
    ),
    Boundary("Zhang & Makris 2001, p = 2.14", TALL, "one-sine", 15.7, 3.230, 1.0, 1e-3, True, 0),
    Boundary(
        "PEER 2001/07, one-cosine of 2 s",
        RockingBlock(2.0, math.radians(15.0), 0.89952),
        "one-cosine",
        math.pi,
        0.315034,
        1.0,
        1e-5,
        True,
        None,
    ),
    Boundary(
        "Makris & Roussos 2000, half-sine of 0.5 s",
        Column(0.2, 0.6).block().linear(),
        "half-sine",
        2 * math.pi,
        0.554586,
        1.0,
        1e-4,
        True,
        None,
    ),
    Boundary(
        "Zhou, Du & Han 2019, a frame under a Ricker wavelet of 3.14 s",
        _frame_of_zhou(),
        "ricker-symmetric",
        2 * math.pi / 3.14,
        0.3134,
        1.0,
        2e-4,
        True,
        None,
    ),
]


@pytest.mark.parametrize("row", BOUNDARIES, ids=lambda row: row.source)
def test_overturning_begins_where_it_was_published(row):
    below, above = (
        simulate(
            row.block,
            Pulse(row.shape, row.value * row.unit * (1 + side * row.tolerance), row.omega),
            samples=2,
        )
        for side in (-1, 1)
    )
    over, safe = (above, below) if row.overturns_above else (below, above)
    assert over.overturned
    assert not safe.overturned
    if row.impacts is not None:
        assert over.number_of_impacts == row.impacts


def test_first_overturning_of_zhang_and_makris_has_one_impact():
    response = simulate(LINEAR, Pulse("one-sine", 3.1 * 0.2, 5.0))
    assert response.overturned
    assert response.number_of_impacts == 1


def test_overturning_without_impact_begins_at_the_root_of_its_condition():
    critical = _no_impact_root(5.0)
    assert critical == pytest.approx(7.16813, rel=1e-6)
    for margin in (1e-4, 1e-6, 1e-7):
        below = simulate(LINEAR, Pulse("one-sine", 0.2 * critical * (1 - margin), 5.0), samples=2)
        above = simulate(LINEAR, Pulse("one-sine", 0.2 * critical * (1 + margin), 5.0), samples=2)
        assert (below.overturned, above.overturned) == (False, True)
        assert above.number_of_impacts == 0


@pytest.mark.parametrize("p", [0.5, 2.0])
def test_constant_push_overturns_after_the_logarithm_of_housner(p):
    # p · duration = ln(A/(A − 1)) with A in units of αg; 1.098612 at A = 1.5
    block = RockingBlock(p, 0.2, 0.9, linearised=True)
    assert math.log(1.5 / 0.5) == pytest.approx(1.098612, abs=1e-6)
    for factor, overturned in ((1 - 1e-6, False), (1 + 1e-6, True)):
        omega = math.pi * p / (1.098612289 * factor)
        assert simulate(block, Pulse("constant", 0.3, omega)).overturned is overturned


FREE_QUARTER_PERIODS = [
    # block, θ0/α, p · (quarter period), tolerance
    (LINEAR, 0.5, 1.316958, 1e-6),
    (LINEAR, 0.9, 2.993223, 1e-6),
    (BLOCK, 0.5, 1.319376, 1e-5),
    (BLOCK, 0.9, 2.994637, 1e-5),
]


@pytest.mark.parametrize(("block", "fraction", "value", "tolerance"), FREE_QUARTER_PERIODS)
def test_free_quarter_period_is_that_of_housner(block, fraction, value, tolerance):
    response = simulate(block, rotation=fraction * block.slenderness)
    found = response.impacts[0] * block.frequency_parameter
    assert found == pytest.approx(value, abs=tolerance)
    integral = quarter_period(block, fraction * block.slenderness)
    assert found == pytest.approx(integral, abs=1e-8)
    if block.linearised:
        assert integral == pytest.approx(math.acosh(1 / (1 - fraction)), abs=1e-10)


def test_peaks_of_free_rocking_decay_as_housner_found():
    block = RockingBlock(2.0, 0.25, math.sqrt(0.7), linearised=True)
    start = simulate(block, rotation=0.5 * 0.25)
    middles = (start.impacts[:5] + start.impacts[1:6]) / 2  # each bounce is symmetric in time
    response = simulate(block, rotation=0.5 * 0.25, samples=middles)
    peaks = np.abs(response.rotation) / 0.25
    bounces = np.arange(1, 6)
    expected = 1 - np.sqrt(1 - 0.7**bounces * (1 - 0.5**2))
    np.testing.assert_allclose(peaks, expected, atol=1e-7)
    np.testing.assert_allclose(peaks[[0, 1, 4]], [0.310798, 0.204701, 0.065148], atol=1e-5)
    assert np.all(np.sign(response.rotation) == [-1, 1, -1, 1, -1])


# ---------------------------------------------------------------------------- at rest


@BOTH
@pytest.mark.parametrize("shape", ["one-sine", "one-cosine", "half-sine", "constant"])
@pytest.mark.parametrize("fraction", [0.5, 0.999, 1.0, -1.0])
def test_nothing_lifts_up_to_the_threshold(block, shape, fraction):
    response = simulate(block, Pulse(shape, fraction * block.uplift_acceleration, 5.0))
    assert response.outcome == "no uplift"
    assert not np.any(response.rotation)
    assert not np.any(response.velocity)
    assert len(response.impacts) == 0
    assert response.number_of_impacts == 0
    assert response.peak_rotation == 0
    assert not response.overturned


@BOTH
@pytest.mark.parametrize("shape", ["one-sine", "one-cosine", "half-sine", "constant"])
def test_everything_lifts_above_the_threshold(block, shape):
    response = simulate(block, Pulse(shape, 1.01 * block.uplift_acceleration, 5.0))
    assert response.outcome == "rests"
    assert response.peak_rotation > 0


def test_nothing_moves_without_excitation_and_initial_state():
    response = simulate(BLOCK)
    assert response.outcome == "no uplift"
    assert not np.any(response.rotation)
    assert not np.any(response.velocity)
    assert len(response.impacts) == 0
    assert response.peak_rotation == 0
    assert simulate(BLOCK, duration=3.0, samples=4).time[-1] == 3.0


@BOTH
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_ground_that_accelerates_to_one_side_tips_the_block_to_the_other(block, sign):
    pulse = Pulse("half-sine", sign * 1.5 * block.uplift_acceleration, 10.0)
    response = simulate(block, pulse, duration=math.pi / 10.0)
    assert not response.overturned
    assert np.all(sign * response.rotation <= 0)
    assert sign * response.rotation[-1] < 0


@pytest.mark.parametrize("degrees", [2.0, 5.0, 8.0, 14.0, 20.0])
@pytest.mark.parametrize("ratio", [1.0001, 1.01, 1.1, 1.5, 3.0])
def test_uplift_is_never_taken_for_an_impact(degrees, ratio):
    # From uplift until |a| falls below the threshold again the block is only pushed outwards.
    block = RockingBlock(2.0, math.radians(degrees), 0.93)
    omega = 8.0
    lift = math.asin(1 / ratio) / omega
    lower = math.pi / omega - lift
    pulse = Pulse("one-sine", ratio * block.uplift_acceleration, omega)
    times = np.concatenate([[0.0, 0.999 * lift], np.linspace(lift, lower, 40)[1:]])
    response = simulate(block, pulse, duration=lower, samples=times)
    during = response.impacts[response.impacts <= lower]
    assert len(during) == 0
    assert not np.any(response.rotation[:2])
    assert np.all(response.rotation[2:] < 0)
    assert np.all(np.diff(response.rotation[1:]) < 0)


@BOTH
@pytest.mark.parametrize(
    "shape", ["one-sine", "half-sine", "ricker-symmetric", "ricker-antisymmetric"]
)
@pytest.mark.parametrize("ratio", [1.05, 1.5, 2.3, 3.0, 4.0, 20.0])
def test_block_lifts_when_the_ground_first_exceeds_the_threshold(block, shape, ratio):
    # Beyond 2.24 and 3.2 times the threshold it is a side lobe of the wavelets that lifts it,
    # and to the side opposite to that of the main lobe.
    pulse = Pulse(shape, ratio * block.uplift_acceleration, 12.0)
    times = np.linspace(0.0, pulse.duration, 20001)
    ground = pulse.excitation(times)
    first = np.flatnonzero(np.abs(ground) > block.uplift_acceleration)[0]
    response = simulate(block, pulse, samples=times[: first + 21])
    moving = np.flatnonzero(response.rotation)
    assert moving[0] == pytest.approx(first, abs=1)
    assert np.sign(response.rotation[-1]) == -np.sign(ground[first])


def test_ricker_lifts_the_block_in_its_side_lobe_first():
    block = BLOCK  # the side lobe is 0.446 of the peak, the other way round: θ > 0 first
    pulse = Pulse("ricker-symmetric", 3.0 * block.uplift_acceleration, 12.0)
    period = 2 * math.pi / 12.0
    lobe = np.linspace(2.25 - 0.38, 2.25 - 1 / (math.pi * math.sqrt(2)), 50) * period
    response = simulate(block, pulse, samples=lobe)
    assert np.all(response.rotation > 0)


# ---------------------------------------------------------------------------- rest, renewed uplift


def twin_record(peak: float, gap: float, second: float = 1.0) -> Record:
    """Two triangles of 0.4 s, `gap` seconds apart; the second is `second` times the first."""
    step = 0.1
    triangle = np.array([0.0, 0.5, 1.0, 0.5, 0.0])
    quiet = np.zeros(round(gap / step) - 1)
    return Record(step, peak * np.concatenate([triangle, quiet, second * triangle]))


@BOTH
@pytest.mark.parametrize(
    ("pulse", "rotation"),
    [
        (Pulse("half-sine", 0.1, 4.0), 0.0),  # no uplift
        (Pulse("one-sine", 0.4, 6.0), 0.1),  # at rest after the forcing
        (Pulse("ricker-symmetric", 0.27, 12.0), 0.0),  # at rest before its end
        (Pulse("one-sine", 0.9, 3.0), 0.0),  # overturned
    ],
)
def test_first_and_last_of_samples_are_those_of_any_number(block, pulse, rotation):
    few, more = (simulate(block, pulse, rotation=rotation, samples=n) for n in (2, 3))
    assert few.outcome == more.outcome
    for name in ("time", "rotation", "velocity"):
        expected = pytest.approx(getattr(more, name)[[0, 2]], abs=1e-13)
        assert getattr(few, name) == expected


@BOTH
@pytest.mark.parametrize("restitution", [0.0, 0.3])
def test_block_lifts_again_after_it_has_come_to_rest(block, restitution):
    block = block.with_restitution(restitution)
    peak = 2.0 * block.uplift_acceleration
    shift = 0.4 + 10.0
    twice = simulate(
        block,
        twin_record(peak, 10.0),
        samples=np.concatenate([np.linspace(0, 3, 301)] * 2) + np.repeat([0.0, shift], 301),
    )
    once, again = twice.rotation[:301], twice.rotation[301:]
    assert np.max(np.abs(once)) > 1e-3
    np.testing.assert_allclose(again, once, atol=1e-7 * block.slenderness)
    assert not np.any(np.abs(once[-20:]) > 1e-6 * block.slenderness)
    mirrored = simulate(block, twin_record(peak, 10.0, -1.0), samples=twice.time)
    np.testing.assert_allclose(mirrored.rotation[301:], -once, atol=1e-7 * block.slenderness)


def test_peak_of_a_record_is_that_of_its_strongest_part():
    block = BLOCK.with_restitution(0.2)
    weak = 1.5 * block.uplift_acceleration
    alone = simulate(block, twin_record(1.4 * weak, 10.0, 0.0))
    both = simulate(block, twin_record(weak, 10.0, 1.4))
    assert both.peak_rotation == pytest.approx(alone.peak_rotation, rel=1e-7)
    assert both.outcome == "rests"


@BOTH
def test_block_without_restitution_rests_at_its_first_impact(block):
    block = block.with_restitution(0.0)
    free = simulate(block, rotation=0.1)
    assert free.outcome == "rests"
    assert len(free.impacts) == 1
    later = simulate(block, rotation=0.1, samples=free.impacts[0] + np.linspace(0.01, 5.0, 50))
    assert not np.any(later.rotation)
    assert not np.any(later.velocity)
    twice = simulate(block, twin_record(2 * block.uplift_acceleration, 10.0))
    assert len(twice.impacts) == 2
    assert twice.outcome == "rests"


@BOTH
def test_block_without_restitution_lifts_at_once_when_it_lands_on_strong_ground(block):
    # It lands while the ground pushes beyond the threshold: no rest, the other side at once.
    block = block.with_restitution(0.0)
    push = 3.0 * block.uplift_acceleration
    response = simulate(
        block, Pulse("constant", push, math.pi / 0.6), rotation=0.02, duration=0.6, samples=601
    )
    assert response.number_of_impacts == 1
    landing = response.impacts[0]
    after = response.time > landing + 1e-3
    assert np.all(response.rotation[after] < 0)
    # from the landing on it is the motion of a block that the same push lifts from rest
    fresh = simulate(
        block, Pulse("constant", push, math.pi / 0.6), samples=response.time[after] - landing
    )
    np.testing.assert_allclose(response.rotation[after], fresh.rotation, atol=1e-8)


@BOTH
def test_bounces_die_in_a_time_that_is_a_sum_of_quarter_periods(block):
    block = block.with_restitution(0.5)
    start = 0.6 * block.slenderness
    response = simulate(block, rotation=start)
    assert response.outcome == "rests"
    level, total, number = float(energy(block, start, 0.0)), 0.0, 0
    expected = []
    for number in range(12):
        if block.linearised:
            tilt = block.slenderness - math.sqrt(block.slenderness**2 - 2 * level)
        else:
            tilt = block.slenderness - math.acos(math.cos(block.slenderness) + level)
        total += (1 if number == 0 else 2) * quarter_period(block, tilt)
        expected.append(total / block.frequency_parameter)
        level *= block.restitution**2
        if tilt < 1e-4 * block.slenderness:
            break
    assert len(expected) > 5
    np.testing.assert_allclose(response.impacts[: len(expected)], expected, atol=1e-6)
    assert response.peak_rotation == pytest.approx(start, rel=1e-12)
    assert len(response.impacts) < 40


# ---------------------------------------------------------------------------- energy


@BOTH
@pytest.mark.parametrize("restitution", [0.5, 0.9, 1.0])
def test_energy_is_kept_between_impacts_and_cut_at_each(block, restitution):
    block = block.with_restitution(restitution)
    times = np.linspace(0.0, 6.0, 1201)
    response = simulate(block, rotation=0.2, velocity=-0.05, duration=6.0, samples=times)
    level = energy(block, response.rotation, response.velocity)
    passed = np.searchsorted(response.impacts, times)
    live = (passed < 8) & (np.min(np.abs(times[:, None] - response.impacts), axis=1) > 1e-7)
    start = float(energy(block, 0.2, -0.05))
    expected = start * restitution ** (2 * passed[live])
    np.testing.assert_allclose(level[live], expected, rtol=1e-6, atol=1e-9 * start)
    assert passed[live].max() >= 2


@BOTH
def test_lossless_block_rocks_on_and_returns_to_where_it_began(block):
    block = block.with_restitution(1.0)
    start = 0.5 * block.slenderness
    quarter = quarter_period(block, start) / block.frequency_parameter
    turns = 2 * quarter * np.arange(1, 11)
    response = simulate(block, rotation=start, duration=21 * quarter, samples=turns)
    assert response.outcome == "rocking"
    signs = np.where(np.arange(1, 11) % 2, -1.0, 1.0)
    np.testing.assert_allclose(response.rotation, signs * start, rtol=1e-7)
    np.testing.assert_allclose(response.impacts[:10], quarter * np.arange(1, 20, 2), rtol=1e-8)


# ---------------------------------------------------------------------------- overturning


def test_tilt_beyond_the_slenderness_can_be_survived():
    # Zhang & Makris 2001: 1.33 α at 7.17 αg, just short of overturning without impact
    block = RockingBlock(1.0, 0.2, 0.9, linearised=True)
    response = simulate(block, Pulse("one-sine", 7.16 * 0.2, 5.0))
    assert not response.overturned
    assert response.outcome == "rests"
    assert response.peak_rotation > 1.2 * 0.2


@BOTH
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_initial_speed_overturns_from_the_height_of_the_barrier(block, sign):
    barrier = float(energy(block, block.slenderness, 0.0))
    critical = sign * block.frequency_parameter * math.sqrt(2 * barrier)
    below = simulate(block, velocity=critical * (1 - 1e-5))
    above = simulate(block, velocity=critical * (1 + 1e-5))
    assert below.outcome == "rests"
    assert above.outcome == "overturned"
    assert math.isnan(above.peak_rotation)
    assert above.number_of_impacts == 0
    falling = simulate(block, velocity=critical * (1 + 1e-5), samples=[0.0, 1.0, 2.0])
    assert np.all(np.diff(sign * falling.rotation) > 0)
    assert 0.99 * block.slenderness < below.peak_rotation < block.slenderness


@BOTH
def test_peak_after_an_initial_speed_is_where_its_energy_is_spent(block):
    level = 0.5 * float(energy(block, block.slenderness, 0.0))
    speed = block.frequency_parameter * math.sqrt(2 * level)
    response = simulate(block, velocity=-speed)
    if block.linearised:
        expected = block.slenderness - math.sqrt(block.slenderness**2 - 2 * level)
    else:
        expected = block.slenderness - math.acos(math.cos(block.slenderness) + level)
    assert response.peak_rotation == pytest.approx(expected, rel=1e-8)
    assert np.min(response.rotation) < 0
    assert response.outcome == "rests"


@BOTH
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_block_beyond_its_slenderness_comes_back_only_over_the_barrier(block, sign):
    tilt = 1.2 * block.slenderness
    barrier = float(energy(block, block.slenderness, 0.0))
    speed = block.frequency_parameter * math.sqrt(2 * (barrier - float(energy(block, tilt, 0.0))))
    back = simulate(block, rotation=sign * tilt, velocity=-sign * speed * 1.0001)
    assert back.outcome == "rests"
    assert back.peak_rotation == pytest.approx(tilt, rel=1e-9)
    for velocity in (-sign * speed * 0.9999, 0.0, sign * 0.1):
        over = simulate(block, rotation=sign * tilt, velocity=velocity)
        assert over.outcome == "overturned"
        assert over.number_of_impacts == 0


@BOTH
def test_energy_left_after_an_impact_can_still_overturn(block):
    # Inward over the barrier, with more than 1/r of it: through the impact and over the other side.
    barrier = float(energy(block, block.slenderness, 0.0))
    for factor, outcome in ((0.999, "rests"), (1.001, "overturned")):
        level = factor * barrier / block.restitution**2
        kinetic = level - float(energy(block, 0.1, 0.0))
        velocity = -block.frequency_parameter * math.sqrt(2 * kinetic)
        response = simulate(block, rotation=0.1, velocity=velocity)
        assert response.outcome == outcome
        if outcome == "overturned":
            assert response.number_of_impacts == 1
            later = response.impacts[0] + np.array([0.1, 0.2])
            after = simulate(block, rotation=0.1, velocity=velocity, samples=later)
            assert np.all(after.rotation < 0)


@BOTH
def test_history_of_a_block_that_is_lost_from_the_start_shows_where_it_started(block):
    response = simulate(block, rotation=-0.3, velocity=-0.1)
    assert response.outcome == "overturned"
    assert (response.rotation[0], response.velocity[0]) == (-0.3, -0.1)


def test_exact_block_lies_flat_at_a_right_angle_and_nothing_is_known_beyond():
    times = np.linspace(0.0, 20.0, 2001)
    response = simulate(BLOCK, rotation=0.26, velocity=0.2, samples=times)
    assert response.outcome == "overturned"
    np.testing.assert_array_equal(response.time, times)
    known = np.isfinite(response.rotation)
    fallen = np.flatnonzero(~known)
    assert len(fallen) > 0
    assert np.all(known[: fallen[0]])
    assert not np.any(known[fallen[0] :])
    assert np.all(np.diff(response.rotation[known]) > 0)
    assert 1.4 < response.rotation[known][-1] <= math.pi / 2


# ---------------------------------------------------------------------------- near the threshold


def agree_with_brute_force(structure, shape: str, amplitude: float, omega: float, steps: int):
    block = structure if isinstance(structure, RockingBlock) else structure.block()
    expected = brute_force(block, shape, amplitude, omega, steps)
    response = simulate(structure, Pulse(shape, amplitude, omega), samples=2)
    assert response.overturned is expected.overturned
    if not expected.overturned:
        assert response.peak_rotation == pytest.approx(
            expected.peak, abs=1e-7 * structure.slenderness
        )


@pytest.mark.parametrize("frequency", [0.75, 1.5, 3.0, 5.0])  # in units of p of the column
@pytest.mark.parametrize("ratio", [1.001, 1.02, 1.06, 1.12, 1.2])
@pytest.mark.parametrize("degrees", [5.0, 8.0])
def test_response_just_above_the_threshold_is_that_of_brute_force(degrees, ratio, frequency):
    column = Column(2.0 * math.sin(math.radians(degrees)), 2.0 * math.cos(math.radians(degrees)))
    frame = RockingFrame(column, 1.0)
    omega = frequency * column.frequency_parameter
    agree_with_brute_force(frame, "one-sine", ratio * frame.uplift_acceleration, omega, 1600)


@pytest.mark.parametrize(("ratio", "frequency"), [(1.001, 2.0), (1.1, 5.0), (2.0, 5.0)])
def test_response_to_ground_that_starts_at_its_peak_is_that_of_brute_force(ratio, frequency):
    block = RockingBlock(2.0, math.radians(8.0), 0.93)
    amplitude = -ratio * block.uplift_acceleration
    agree_with_brute_force(block, "one-cosine", amplitude, 2.0 * frequency, 1600)


@pytest.mark.parametrize("restitution", [0.0, 0.9])
@pytest.mark.parametrize("ratio", [1.05, 2.3, 3.0])  # from 2.24 on the side lobes lift it, too
@pytest.mark.parametrize("frequency", [3.0, 8.0])
def test_response_to_a_ricker_wavelet_is_that_of_brute_force(ratio, frequency, restitution):
    block = RockingBlock(2.0, math.radians(8.0), restitution)
    amplitude = ratio * block.uplift_acceleration
    agree_with_brute_force(block, "ricker-symmetric", amplitude, 2.0 * frequency, 4500)


def grazing_speed(block: RockingBlock, start: float, push: float) -> float:
    """Speed towards upright with which a block that is pushed outwards just touches the ground."""

    def potential(x):  # of x = θ > 0 under the constant ground acceleration −push, over p²
        if block.linearised:
            return x * (block.slenderness - x / 2) - push * x
        return math.cos(block.slenderness - x) + push * math.sin(block.slenderness - x)

    return block.frequency_parameter * math.sqrt(2 * (potential(0.0) - potential(start)))


@BOTH
@pytest.mark.parametrize("margin", [1e-3, 1e-5])  # 1e-6 dips by less than 1e-6 α: no impact
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_grazing_impacts_are_neither_missed_nor_invented(block, margin, sign):
    # Thrown at the ground while it pushes outwards: short of the critical speed it turns back
    # before it touches; beyond, it touches, dips to the other side, and returns at once.
    push = 2.0 * block.uplift_acceleration
    start = 0.2 * block.slenderness
    critical = grazing_speed(block, start, push)
    pulse = Pulse("constant", -sign * push, math.pi / 0.35)
    for factor, impacts in ((1 - margin, 0), (1 + margin, 2)):
        response = simulate(
            block, pulse, rotation=sign * start, velocity=-sign * critical * factor, duration=0.35
        )
        assert np.count_nonzero(response.impacts <= 0.35) == impacts
        assert sign * response.rotation[-1] > 0


# ---------------------------------------------------------------------------- symmetry and scale


PULSES = [
    Pulse("one-sine", 0.5, 9.0),
    Pulse("one-cosine", 0.5, 8.0),
    Pulse("half-sine", 0.6, 9.0),
    Pulse("constant", 0.4, 9.0),
    Pulse("ricker-symmetric", 0.6, 12.0),
    Pulse("ricker-antisymmetric", 0.6, 12.0),
]


@BOTH
@pytest.mark.parametrize("pulse", PULSES, ids=lambda pulse: pulse.shape)
def test_mirrored_ground_motion_mirrors_the_response(block, pulse):
    right, left = simulate(block, pulse), simulate(block, pulse.scaled(-1.0))
    assert right.peak_rotation > 0
    assert left.outcome == right.outcome
    np.testing.assert_allclose(left.time, right.time, rtol=1e-12)
    np.testing.assert_allclose(left.rotation, -right.rotation, rtol=0, atol=1e-12)
    np.testing.assert_allclose(left.impacts, right.impacts, rtol=1e-12)
    assert left.peak_rotation == pytest.approx(right.peak_rotation, rel=1e-12)


@BOTH
def test_initial_state_is_mirrored_with_the_ground_motion(block):
    pulse = Pulse("one-sine", 0.5, 9.0)
    right = simulate(block, pulse, rotation=0.05, velocity=0.1)
    left = simulate(block, pulse.scaled(-1.0), rotation=-0.05, velocity=-0.1)
    np.testing.assert_allclose(left.rotation, -right.rotation, rtol=0, atol=1e-12)
    assert (right.rotation[0], right.velocity[0]) == (0.05, 0.1)
    assert (left.rotation[0], left.velocity[0]) == (-0.05, -0.1)


@BOTH
@pytest.mark.parametrize("pulse", PULSES[:3] + PULSES[4:], ids=lambda pulse: pulse.shape)
def test_frequencies_scaled_together_scale_time_alone(block, pulse):
    factor = 2.7
    fast = RockingBlock(
        factor * block.frequency_parameter, block.slenderness, block.restitution, block.linearised
    )
    quick = Pulse(pulse.shape, pulse.amplitude, factor * pulse.angular_frequency)
    times = np.linspace(0.0, 1.5 * pulse.duration, 200)
    slow = simulate(block, pulse, samples=times)
    scaled = simulate(fast, quick, samples=times / factor)
    np.testing.assert_allclose(
        scaled.rotation, slow.rotation, rtol=0, atol=1e-6 * block.slenderness
    )
    assert scaled.peak_rotation == pytest.approx(slow.peak_rotation, rel=1e-7)
    assert scaled.outcome == slow.outcome


# ---------------------------------------------------------------------------- frame, column, block


def same_bits(first, second) -> None:
    for name in ("time", "rotation", "velocity", "impacts"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
    assert first.outcome == second.outcome
    assert first.number_of_impacts == second.number_of_impacts
    np.testing.assert_array_equal(first.peak_rotation, second.peak_rotation)


@pytest.mark.parametrize(
    "structure",
    [Column(0.5, 2.0), *(RockingFrame(Column(0.5, 2.0), g) for g in (0.0, 0.434, 4.0, math.inf))],
)
def test_structure_and_its_block_respond_alike_to_the_last_bit(structure):
    pulse = Pulse("one-sine", 0.6, 7.0)
    same_bits(simulate(structure, pulse), simulate(structure.block(), pulse))


@pytest.mark.parametrize("mass_ratio", [0.434, 4.0, math.inf])
def test_frame_responds_as_the_larger_column_of_the_same_slenderness(mass_ratio):
    column = Column(0.5, 2.0)
    frame = RockingFrame(column, mass_ratio)
    enlarged = frame.equivalent_size / column.size
    twin = Column(0.5 * enlarged, 2.0 * enlarged).block(restitution=frame.restitution)
    pulse = Pulse("one-sine", 0.45, 7.0)
    times = np.linspace(0.0, 2.0, 300)
    first, second = simulate(frame, pulse, samples=times), simulate(twin, pulse, samples=times)
    assert first.peak_rotation > 0
    np.testing.assert_allclose(first.rotation, second.rotation, rtol=0, atol=1e-10)
    assert first.peak_rotation == pytest.approx(second.peak_rotation, abs=1e-10)


def test_same_call_gives_the_same_bits():
    pulse = Pulse("ricker-symmetric", 0.6, 12.0)
    same_bits(simulate(BLOCK, pulse), simulate(BLOCK, pulse))


# ---------------------------------------------------------------------------- time


@BOTH
def test_cutting_the_motion_short_cuts_the_forcing(block):
    # a one-sine that ends at half its duration is a half-sine
    whole = Pulse("one-sine", 0.5, 9.0)
    half = Pulse("half-sine", 0.5, 9.0)
    cut = simulate(block, whole, duration=half.duration)
    judged = simulate(block, half)
    assert cut.time[-1] == pytest.approx(half.duration, rel=1e-12)
    assert cut.overturned == judged.overturned
    assert cut.peak_rotation == pytest.approx(judged.peak_rotation, rel=1e-8)
    assert cut.peak_rotation > 1.01 * np.max(np.abs(cut.rotation))  # reached after the history


def test_outcome_does_not_depend_on_how_long_one_looks():
    pulse = Pulse("one-sine", 0.5, 9.0)
    reference = simulate(BLOCK, pulse)
    for duration in (1.001 * pulse.duration, 2.0 * pulse.duration, 30.0):
        response = simulate(BLOCK, pulse, duration=duration)
        assert response.peak_rotation == pytest.approx(reference.peak_rotation, rel=1e-9)
        assert response.overturned == reference.overturned
        assert response.number_of_impacts == reference.number_of_impacts
        assert response.time[-1] == pytest.approx(duration, rel=1e-12)


def test_one_cycle_of_the_harmonic_is_the_one_sine():
    sine = simulate(BLOCK, Pulse("one-sine", 0.5, 9.0), duration=2 * math.pi / 9.0)
    harmonic = simulate(BLOCK, Pulse("harmonic", 0.5, 9.0), duration=2 * math.pi / 9.0)
    assert harmonic.peak_rotation == pytest.approx(sine.peak_rotation, rel=1e-8)
    np.testing.assert_allclose(harmonic.rotation, sine.rotation, rtol=0, atol=1e-9)


def test_harmonic_needs_a_duration():
    with pytest.raises(ValueError, match="duration"):
        simulate(BLOCK, Pulse("harmonic", 0.7, 9.0))


def test_number_of_samples_are_uniform_times_from_zero():
    response = simulate(BLOCK, Pulse("one-sine", 0.5, 9.0), duration=2.0, samples=41)
    np.testing.assert_allclose(response.time, np.linspace(0.0, 2.0, 41), rtol=1e-14)
    assert response.rotation.shape == response.velocity.shape == (41,)
    assert len(simulate(BLOCK, rotation=0.1).time) == 1000


@pytest.mark.parametrize("restitution", [1.0, 0.999])
@BOTH
def test_last_sample_of_a_history_that_is_cut_off_is_known(block, restitution):
    for k in range(40):
        slow = replace(block, restitution=restitution, frequency_parameter=1.0 + 0.1 * k)
        response = simulate(slow, rotation=0.5 * slow.slenderness, samples=3)
        assert response.outcome == "rocking"
        assert response.time[-1] == response.impacts[-1]
        assert np.isfinite(response.rotation).all()
        assert np.isfinite(response.velocity).all()


@BOTH
def test_samples_only_look_and_never_touch(block):
    pulse = Pulse("one-sine", 0.5, 9.0)
    coarse = simulate(block, pulse, samples=np.array([0.1, 0.4, 0.45, 1.0]))
    fine = simulate(block, pulse, samples=np.linspace(0.0, 1.0, 1001))
    np.testing.assert_array_equal(coarse.time, [0.1, 0.4, 0.45, 1.0])
    np.testing.assert_allclose(coarse.rotation, fine.rotation[[100, 400, 450, 1000]], atol=1e-9)
    np.testing.assert_allclose(coarse.velocity, fine.velocity[[100, 400, 450, 1000]], atol=1e-7)
    assert coarse.peak_rotation == pytest.approx(fine.peak_rotation, rel=1e-9)


@BOTH
@pytest.mark.parametrize("amplitude", [0.5, 3.0])
def test_samples_that_stop_early_leave_the_verdict_to_the_whole_forcing(block, amplitude):
    pulse = Pulse("one-sine", amplitude, 9.0)
    early = simulate(block, pulse, samples=[0.0, 0.01, 0.05])
    end = judge(block, pulse)
    assert end.overturned == (amplitude > 1)
    assert (early.overturned, early.number_of_impacts) == (end.overturned, end.impacts)
    close = 1e-9 * block.slenderness
    assert early.peak_rotation == pytest.approx(end.peak, abs=close, nan_ok=True)


@BOTH
def test_velocity_is_the_derivative_of_rotation(block):
    pulse = Pulse("one-sine", 0.5, 9.0)
    response = simulate(block, pulse, samples=np.linspace(0.0, 1.0, 4001))
    middle = (response.rotation[2:] - response.rotation[:-2]) / (2 * 0.00025)
    apart = np.min(np.abs(response.time[1:-1, None] - response.impacts), axis=1) > 0.001
    smooth = apart & (np.abs(response.rotation[1:-1]) > 1e-3)
    assert np.count_nonzero(smooth) > 1000
    np.testing.assert_allclose(middle[smooth], response.velocity[1:-1][smooth], atol=1e-5)


def test_history_shows_the_block_at_rest_after_it_has_come_to_rest():
    block = BLOCK.with_restitution(0.3)
    response = simulate(
        block, Pulse("one-sine", 0.5, 9.0), samples=np.linspace(0.0, 60.0, 601), duration=60.0
    )
    assert response.outcome == "rests"
    assert not np.any(response.rotation[-100:])
    assert not np.any(response.velocity[-100:])


@BOTH
@pytest.mark.parametrize("pulse", PULSES, ids=lambda pulse: pulse.shape)
def test_response_is_consistent_with_itself(block, pulse):
    for amplitude in (0.2, 1.0, 6.0):
        response = simulate(block, pulse.scaled(amplitude))
        assert response.outcome in OUTCOMES
        assert response.overturned == (response.outcome == "overturned")
        assert math.isnan(response.peak_rotation) == response.overturned
        assert np.all(np.diff(response.impacts) > 0)
        assert np.all(response.impacts > 0)
        assert np.all(np.diff(response.time) > 0)
        assert response.time[0] == 0
        assert 0 <= response.number_of_impacts <= len(response.impacts)
        if not response.overturned:
            highest = np.max(np.abs(response.rotation))
            assert highest <= response.peak_rotation * (1 + 1e-9)
            assert response.peak_rotation == pytest.approx(highest, rel=0.02)
            forced = np.count_nonzero(response.impacts <= pulse.duration)
            assert response.number_of_impacts == forced


def test_initial_rotation_counts_as_a_peak():
    response = simulate(BLOCK, Pulse("one-sine", 0.05, 9.0), rotation=-0.15)
    assert response.peak_rotation >= 0.15
    assert simulate(BLOCK, rotation=-0.15).peak_rotation == pytest.approx(0.15, rel=1e-12)


@BOTH
def test_record_of_a_sine_is_answered_like_the_sine(block):
    pulse = Pulse("one-sine", 0.5, 9.0)
    step = pulse.duration / 400
    record = Record(step, pulse.excitation(step * np.arange(401)))
    assert simulate(block, record).peak_rotation == pytest.approx(
        simulate(block, pulse).peak_rotation, rel=2e-3
    )


# ---------------------------------------------------------------------------- bad input


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"rotation": math.nan}, "rotation.*nan"),
        ({"rotation": math.inf}, "rotation.*inf"),
        ({"velocity": math.nan}, "velocity.*nan"),
        ({"velocity": -math.inf}, "velocity.*-inf"),
        ({"rotation": 1.6}, r"rotation.*1\.6"),
        ({"rotation": -1.6}, r"rotation.*-1\.6"),
        ({"rotation": math.pi / 2}, r"rotation.*1\.57"),
        ({"duration": -1.0}, r"duration.*-1"),
        ({"duration": math.nan}, "duration.*nan"),
        ({"samples": 1}, r"samples.*\b1\b"),
        ({"samples": 0}, r"samples.*\b0\b"),
        ({"samples": -3}, r"samples.*-3"),
        ({"samples": np.array([0.0, 0.2, 0.1])}, "samples.*increasing"),
        ({"samples": np.array([0.0, 0.1, 0.1])}, "samples.*increasing"),
        ({"samples": np.array([0.0, math.nan])}, "samples"),
    ],
)
def test_bad_options_are_refused_by_name_and_value(options, says):
    with pytest.raises(ValueError, match=f"(?is){says}"):
        simulate(BLOCK, **({"rotation": 0.1} | options))


def test_linear_block_knows_no_right_angle():
    assert simulate(BLOCK.linear(), rotation=1.6).outcome == "overturned"


def test_structure_that_cannot_rock_is_refused():
    stocky = Column(2.0, 1.0)
    for structure in (stocky, RockingFrame(stocky, 1.0)):
        with pytest.raises(ValueError, match=r"1\.107|63\.4"):
            simulate(structure, Pulse("one-sine", 3.0, 9.0))
    assert simulate(stocky.block(restitution=0.5), Pulse("one-sine", 1.0, 9.0)).outcome == (
        "no uplift"
    )


def test_record_of_one_sample_is_refused():
    for samples in ([], [0.3], 0.3):
        with pytest.raises(ValueError, match=r"'Kos': acceleration has shape.*two samples"):
            simulate(BLOCK, Record(0.01, np.array(samples), "Kos"))
    shortest = Record(0.1, np.array([2.0, 1.0]) * BLOCK.uplift_acceleration)
    assert simulate(BLOCK, shortest).outcome == "rests"


# ---------------------------------------------------------------------------- extreme input


@pytest.mark.parametrize("linearised", [False, True])
@pytest.mark.parametrize("degrees", [0.1, 14.0, 80.0])
@pytest.mark.parametrize("ratio", [1e-3, 1e3])
@pytest.mark.parametrize("strength", [1 + 1e-9, 1.5, 1e3])
def test_extreme_input_is_answered_alike_by_both_routes(strength, ratio, degrees, linearised):
    block = RockingBlock(2.0, math.radians(degrees), 0.9, linearised)
    for shape in ("one-sine", "one-cosine", "ricker-symmetric", "ricker-antisymmetric"):
        pulse = Pulse(shape, strength * block.uplift_acceleration, ratio * 2.0)
        end, whole = judge(block, pulse), simulate(block, pulse, samples=5)
        assert (end.overturned, end.impacts) == (whole.overturned, whole.number_of_impacts)
        close = 1e-9 * block.slenderness
        assert end.peak == pytest.approx(whole.peak_rotation, abs=close, nan_ok=True)
        expected = reference.judge(block, pulse)
        assert end.overturned == expected.overturned
        assert strength < 1.1 or end.overturned == (ratio < 1)
        assert end.peak == pytest.approx(expected.peak, abs=close, nan_ok=True)


def test_stocky_frame_rocks_with_a_restitution_of_its_own():
    angle = math.radians(80.0)
    column = Column(math.sin(angle), math.cos(angle))
    for structure in (column, RockingFrame(column, 2.0)):
        block = structure.block(restitution=0.3)
        end = judge(block, Pulse("one-sine", 1.2 * block.uplift_acceleration, 20.0))
        assert not end.overturned
        assert 0 < end.peak < angle


def test_heaviest_cap_is_the_limit_of_heavy_caps():
    column, pulse = Column(0.5, 2.0), Pulse("one-sine", 0.6, 7.0)
    heavy, limit = (judge(RockingFrame(column, g), pulse) for g in (1e9, math.inf))
    assert (heavy.overturned, heavy.impacts) == (limit.overturned, limit.impacts)
    assert heavy.peak == pytest.approx(limit.peak, rel=1e-8)
    assert heavy.peak != judge(RockingFrame(column, 1e3), pulse).peak


def test_history_that_cannot_be_followed_says_so():
    # A nudge and a long quiet: without loss, bounces of 1e-4 s each go on through all of it.
    lossless = RockingBlock(1.0, 0.2, 1.0)
    nudge = Record(1.0, 1.0001 * lossless.uplift_acceleration * np.array([0, 1, *np.zeros(300)]))
    with pytest.raises(ArithmeticError, match=r"restitution 1,.*bounces too often"):
        judge(lossless, nudge)


# ---------------------------------------------------------------------------- both routes


@pytest.mark.parametrize("row", BOUNDARIES, ids=lambda row: row.source)
def test_published_boundary_is_that_of_the_reference_too(row):
    """Rows 5 to 9, on either side of what the kernel gives to 1e-7."""
    unit = Pulse(row.shape, row.unit, row.omega)
    wide = row.value * np.array([1 - 2 * row.tolerance, 1 + 2 * row.tolerance])
    found = overturning_intervals(row.block, unit, tuple(wide), resolution=row.tolerance)
    # the narrow bays and intervals near a boundary are nobody's printed number
    edge = found[0].lower if row.overturns_above else found[-1].upper
    assert edge[0] == pytest.approx(row.value, rel=row.tolerance)
    below, above = (
        reference.judge(row.block, unit.scaled(value))
        for value in (edge[0] * (1 - 1e-7), edge[1] * (1 + 1e-7))
    )
    over, safe = (above, below) if row.overturns_above else (below, above)
    assert over.overturned
    assert not safe.overturned
    if row.impacts is not None:
        assert over.impacts == row.impacts


@BOTH
@pytest.mark.parametrize("shape", ["one-sine", "ricker-symmetric", "ricker-antisymmetric"])
def test_largest_amplitude_overturns(block, shape):
    pulse = Pulse(shape, LARGEST_ACCELERATION, 5.0)
    assert judge(block, pulse).overturned
    assert reference.judge(block, pulse).overturned


def test_record_and_factor_that_would_overflow_are_refused():
    with pytest.raises(ValueError, match="sample 1 of 2 is 1e\\+200 g"):
        Record(0.01, [0.0, 1e200])
    with pytest.raises(ValueError, match="expected at most"):
        overturning_intervals(BLOCK, Pulse("one-sine", 1.0, 5.0), (0.0, 1e200), resolution=1e199)
    with pytest.raises(ValueError, match="expected at most"):
        overturning_map(BLOCK, "one-sine", [5.0], [0.1, 1e200])
