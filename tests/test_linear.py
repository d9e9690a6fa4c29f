"""The piecewise exact solution of the linearised equation, alone and against simulate()."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from topheavy import (
    PULSE_SHAPES,
    Column,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    read_at2,
    simulate,
)
from topheavy.checks import LARGEST_ACCELERATION
from topheavy.linear import simulate_linear_exact
from topheavy.shapes import ELEMENTARY

EL_CENTRO = Path(__file__).parents[1] / "data" / "records" / "el_centro_1940_NS.AT2"
BLOCK = RockingBlock(1.0, 0.2, 0.9, linearised=True)


# ---------------------------------------------------------------------------- closed forms


@pytest.mark.parametrize(("fraction", "value"), [(0.5, 1.316958), (0.9, 2.993223)])
@pytest.mark.parametrize("p", [0.7, 2.0])
def test_free_quarter_period_is_housners_area_cosine(fraction, value, p):
    block = RockingBlock(p, 0.25, 0.9, linearised=True)
    found = p * simulate_linear_exact(block, rotation=fraction * 0.25).impacts[0]
    assert found == pytest.approx(value, abs=1e-6)
    assert found == pytest.approx(math.acosh(1 / (1 - fraction)), abs=1e-13)


def test_free_rotation_is_housners_hyperbolic_cosine():
    block = RockingBlock(2.0, 0.25, 0.9, linearised=True)
    times = np.linspace(0.0, 0.65, 50)
    response = simulate_linear_exact(block, rotation=0.125, samples=times)
    np.testing.assert_allclose(
        response.rotation, 0.25 - 0.125 * np.cosh(2.0 * times), rtol=0, atol=1e-14
    )
    np.testing.assert_allclose(response.velocity, -0.25 * np.sinh(2.0 * times), rtol=0, atol=1e-13)


def test_peaks_decay_as_housner_found():
    block = RockingBlock(2.0, 0.25, math.sqrt(0.7), linearised=True)
    impacts = simulate_linear_exact(block, rotation=0.125).impacts
    middles = (impacts[:10] + impacts[1:11]) / 2
    peaks = np.abs(simulate_linear_exact(block, rotation=0.125, samples=middles).rotation) / 0.25
    np.testing.assert_allclose(peaks[[0, 1, 4]], [0.310798, 0.204701, 0.065148], atol=1e-5)
    bounces = np.arange(1, 11)
    np.testing.assert_allclose(peaks, 1 - np.sqrt(1 - 0.7**bounces * 0.75), atol=1e-12)


@pytest.mark.parametrize("push", [1.2, 1.5, 3.0])  # in units of αg
def test_constant_push_overturns_after_housners_logarithm(push):
    critical = math.log(push / (push - 1))
    for factor, overturned in ((1 - 1e-9, False), (1 + 1e-9, True)):
        pulse = Pulse("constant", 0.2 * push, math.pi / (critical * factor))
        assert simulate_linear_exact(BLOCK, pulse).overturned is overturned


@pytest.mark.parametrize("ratio", [3.0, 5.0, 15.7 / 2.14])
def test_one_sine_overturns_without_impact_from_the_root_of_its_condition(ratio):
    def condition(psi):  # (ω/p) sin ψ − cos ψ = −exp(−(p/ω)(2π − ψ)), sin ψ = αg/a
        return ratio * math.sin(psi) - math.cos(psi) + math.exp((psi - 2 * math.pi) / ratio)

    critical = 1 / math.sin(brentq(condition, 1e-6, 1.0, xtol=1e-15))
    for factor, overturned in ((1 - 1e-9, False), (1 + 1e-9, True)):
        response = simulate_linear_exact(BLOCK, Pulse("one-sine", 0.2 * critical * factor, ratio))
        assert response.overturned is overturned
    assert response.number_of_impacts == 0


PUBLISHED = [
    # source, ω/p, safe and overturning amplitude (αg), impacts before overturning or None
    ("Zhang & Makris 2001, lowest", 5.0, 3.0156, 3.0217, None),
    ("Zhang & Makris 2001, with impact", 5.0, 6.3244, 6.3118, 1),
    ("Zhang & Makris 2001, without impact", 5.0, 7.16806, 7.16820, 0),
    ("Zhang & Makris 2001, 3.230 g at p = 2.14", 15.7 / 2.14, 3.2268 / 0.25, 3.2332 / 0.25, 0),
]


@pytest.mark.parametrize(
    ("ratio", "safe", "over", "impacts"), [r[1:] for r in PUBLISHED], ids=[r[0] for r in PUBLISHED]
)
def test_published_boundaries_are_bracketed(ratio, safe, over, impacts):
    assert not simulate_linear_exact(BLOCK, Pulse("one-sine", 0.2 * safe, ratio)).overturned
    response = simulate_linear_exact(BLOCK, Pulse("one-sine", 0.2 * over, ratio))
    assert response.overturned
    if impacts is not None:
        assert response.number_of_impacts == impacts


def test_first_lobe_is_that_of_the_sine_solution_by_hand():
    # From uplift at ωt = ψ: particular solution plus the exponentials that start it from rest.
    amplitude, omega, alpha = 0.5, 5.0, 0.2
    psi = math.asin(alpha / amplitude)
    tau = np.linspace(0.0, 0.6, 40)  # pt since uplift, p = 1
    gain = amplitude / (1 + omega**2)

    def particular(t):
        return gain * np.sin(omega * t + psi) - alpha

    slope = gain * omega * math.cos(psi)
    expected = particular(tau) - particular(0.0) * np.cosh(tau) - slope * np.sinh(tau)
    times = np.concatenate([[0.0], tau + psi / omega])
    response = simulate_linear_exact(BLOCK, Pulse("one-sine", amplitude, omega), samples=times)
    np.testing.assert_allclose(response.rotation[1:], expected, rtol=0, atol=1e-13)


# ---------------------------------------------------------------------------- simulate()


@dataclass(frozen=True)
class Case:
    block: RockingBlock
    pulse: Pulse
    rotation: float
    velocity: float
    duration: float | None


def random_cases(number: int) -> list[Case]:
    random = np.random.default_rng(1963)
    cases = []
    for index in range(number):
        p, alpha = random.uniform(0.5, 4.0), random.uniform(0.05, 0.4)
        block = RockingBlock(p, alpha, random.uniform(0.6, 0.98), linearised=True)
        shape = ELEMENTARY[index % len(ELEMENTARY)]
        strength = alpha * random.uniform(1.02, 4.0) * random.choice([-1, 1])
        pulse = Pulse(shape, strength, p * random.uniform(2.0, 8.0))
        moving = index % 3 == 0
        rotation = moving * alpha * random.uniform(-0.5, 0.5)
        velocity = moving * alpha * p * random.uniform(-0.3, 0.3)
        duration = random.uniform(1, 3) * 2 * math.pi / pulse.angular_frequency
        cases.append(
            Case(block, pulse, rotation, velocity, duration if shape == "harmonic" else None)
        )
    return cases


def comparable(impacts: np.ndarray, p: float) -> int:
    """The impacts before the first train of bounces, whose members count for nothing."""
    short = np.flatnonzero(np.diff(impacts) < 1e-2 / p)
    return int(short[0]) + 1 if len(short) else len(impacts)


def assert_same_motion(found, exact, block: RockingBlock, until: float) -> None:
    assert found.overturned == exact.overturned
    assert (found.outcome == "no uplift") == (exact.outcome == "no uplift")
    if exact.overturned:
        assert math.isnan(found.peak_rotation)
        assert math.isnan(exact.peak_rotation)
    else:
        assert found.peak_rotation == pytest.approx(
            exact.peak_rotation, rel=0, abs=1e-7 * block.slenderness
        )
    p = block.frequency_parameter
    number = min(comparable(found.impacts, p), comparable(exact.impacts, p))
    np.testing.assert_allclose(found.impacts[:number], exact.impacts[:number], atol=1e-6 / p)
    if exact.overturned and number == len(exact.impacts):
        assert found.number_of_impacts == exact.number_of_impacts


@pytest.mark.parametrize("case", random_cases(40), ids=lambda case: case.pulse.shape)
def test_solver_agrees_with_the_exact_solution_under_pulses(case):
    options = {"rotation": case.rotation, "velocity": case.velocity, "duration": case.duration}
    exact = simulate_linear_exact(case.block, case.pulse, **options)
    found = simulate(case.block, case.pulse, **options)
    assert exact.outcome != "no uplift"
    assert_same_motion(found, exact, case.block, case.pulse.duration)


@pytest.mark.parametrize("shape", ELEMENTARY)
def test_solver_follows_the_exact_history(shape):
    pulse = Pulse(shape, 0.45, 5.5)
    times = np.linspace(0.0, 2 * math.pi / 5.5, 120)
    options = {"duration": times[-1], "samples": times}
    exact = simulate_linear_exact(BLOCK, pulse, **options)
    found = simulate(BLOCK, pulse, **options)
    assert np.max(np.abs(exact.rotation)) > 0.02
    np.testing.assert_array_equal(exact.time, found.time)
    np.testing.assert_allclose(found.rotation, exact.rotation, rtol=0, atol=1e-8)
    np.testing.assert_allclose(found.velocity, exact.velocity, rtol=0, atol=1e-7)


@pytest.mark.parametrize(
    ("structure", "factor"),
    [(Column(0.3, 1.5), 1.0), (RockingFrame(Column(0.3, 1.5), 4.0), 1.0), (Column(0.3, 1.5), 4.0)],
    ids=["column", "frame", "column, shaken until it overturns"],
)
def test_solver_agrees_with_the_exact_solution_in_el_centro(structure, factor):
    block = structure.block().linear()
    record = read_at2(EL_CENTRO).scaled(factor)
    exact = simulate_linear_exact(block, record)
    found = simulate(block, record)
    assert exact.outcome != "no uplift"
    assert exact.overturned == (factor > 1)
    assert_same_motion(found, exact, block, record.duration)


def test_record_of_straight_lines_is_solved_by_straight_lines_and_exponentials():
    # A ramp a = st from t = 0: θ = −α + a + C cosh + D sinh from uplift, p = 1
    slope, alpha = 0.5, 0.2
    record = Record(1.0, [0.0, slope])
    lift = alpha / slope
    times = np.linspace(lift, 1.0, 30)
    response = simulate_linear_exact(BLOCK, record, samples=times)
    tau = times - lift
    expected = slope * tau - slope * np.sinh(tau)
    np.testing.assert_allclose(response.rotation, expected, rtol=0, atol=1e-14)


# ---------------------------------------------------------------------------- interface


def test_mirrored_ground_motion_mirrors_the_exact_solution():
    pulse = Pulse("one-sine", 0.5, 5.0)
    right, left = (simulate_linear_exact(BLOCK, pulse.scaled(side)) for side in (1.0, -1.0))
    np.testing.assert_allclose(left.rotation, -right.rotation, rtol=0, atol=1e-15)
    np.testing.assert_allclose(left.impacts, right.impacts, rtol=1e-14)


def test_nothing_lifts_up_to_the_threshold_exactly():
    response = simulate_linear_exact(BLOCK, Pulse("one-sine", 0.2, 5.0))
    assert response.outcome == "no uplift"
    assert not np.any(response.rotation)
    assert response.peak_rotation == 0


@pytest.mark.parametrize("shape", ["ricker-symmetric", "ricker-antisymmetric"])
def test_ricker_wavelets_are_refused_with_the_shapes_that_are_not(shape):
    with pytest.raises(ValueError, match=shape) as error:
        simulate_linear_exact(BLOCK, Pulse(shape, 0.5, 5.0))
    for supported in ELEMENTARY:
        assert error.match(supported)


def test_exact_block_is_refused():
    with pytest.raises(ValueError, match="linear"):
        simulate_linear_exact(RockingBlock(1.0, 0.2, 0.9), Pulse("one-sine", 0.5, 5.0))


def test_harmonic_needs_a_duration_here_too():
    with pytest.raises(ValueError, match="duration"):
        simulate_linear_exact(BLOCK, Pulse("harmonic", 0.5, 5.0))


@pytest.mark.parametrize("amplitude", [1e160, 1e200, -1e300])
@pytest.mark.parametrize("shape", PULSE_SHAPES)
def test_amplitude_that_would_overflow_is_refused(shape, amplitude):
    with pytest.raises(ValueError, match=r"amplitude is .*e\+.* g; expected at most"):
        Pulse(shape, amplitude, 5.0)


@pytest.mark.parametrize("shape", ["one-sine", "half-sine", "constant"])
def test_largest_amplitude_overturns(shape):
    assert simulate_linear_exact(BLOCK, Pulse(shape, LARGEST_ACCELERATION, 5.0)).overturned
