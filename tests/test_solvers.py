"""What every solver of the rocking block has to do: printed numbers, closed forms, uplift, rest."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import topheavy as th
from steps import verification
from steps.shared import plain
from tests.cases import BLOCK, CONFIG, SIDES
from tests.solvers import BY_TWO, CLOSE, CLOSED_PULSES, EVERY, NAMES, ON_LINEAR
from topheavy.bodies.free_rocking import (
    barrier,
    energy,
    potential,
    quarter_period,
    turning_rotation,
)

LINEAR = th.RockingBlock(1.0, 0.2, 0.9, linearised=True)


def speed(block, level, tilt=0.0):
    """The rate at a tilt of a block that has this energy."""
    return block.frequency_parameter * math.sqrt(2 * (level - potential(block, tilt)))


# ---------------------------------------------------------------------------- printed numbers

ROWS = {row["quantity"]: row for row in CONFIG["verification"]["published"]}
IMPACTS = {verification.END: 1, "one_sine_without_impact": 0, "one_sine_dimensional": 0}  # before


@pytest.mark.parametrize("quantity", verification.PRINTED)
def test_overturning_begins_where_it_was_printed(quantity):
    """By every solver; and the kernel's own boundary is the plain solver's to 1e-7."""
    value, tolerance = (ROWS[quantity][name] for name in ("expected", "tolerance"))
    block, unit = verification.PRINTED[quantity]
    above, impacts = quantity != verification.END, IMPACTS.get(quantity)
    for solve in NAMES if block.linearised else (th.simulate, plain.simulate):
        safe, over = (
            solve(block, unit.scaled(value * (1 + off)), samples=2)
            for off in ((-tolerance, tolerance) if above else (tolerance, -tolerance))
        )
        assert (safe.overturned, over.overturned) == (False, True), solve
        assert impacts in (None, over.number_of_impacts)
    wide = (value * (1 - 2 * tolerance), value * (1 + 2 * tolerance))
    intervals = th.overturning_intervals(block, unit, wide, resolution=tolerance)
    edge = intervals[0].lower if above else intervals[-1].upper
    assert edge[0] == pytest.approx(value, rel=tolerance * 1.01)
    ends = [
        plain.judge(block, unit.scaled(factor))
        for factor in (edge[0] * (1 - 1e-7), edge[1] * (1 + 1e-7))
    ]
    assert [end.overturned for end in ends] == [not above, above]
    assert impacts in (None, ends[int(above)].number_of_impacts)


@ON_LINEAR
@pytest.mark.parametrize("ratio", [3.0, 5.0, 15.7 / 2.14])
def test_overturning_without_impact_begins_at_the_root_of_its_condition(solve, ratio):
    def condition(psi):  # (ω/p) sin ψ − cos ψ = −exp(−(p/ω)(2π − ψ)), sin ψ = αg/a
        return ratio * math.sin(psi) - math.cos(psi) + math.exp((psi - 2 * math.pi) / ratio)

    critical = 1 / math.sin(brentq(condition, 1e-6, 1.0, xtol=1e-15))
    margin = max(1e-9, 10 * CLOSE[solve])
    for factor, overturned in ((1 - margin, False), (1 + margin, True)):
        history = solve(
            LINEAR,
            th.Pulse("one-sine", 0.2 * critical * factor, angular_frequency=ratio),
            samples=2,
        )
        assert history.overturned is overturned
    assert history.number_of_impacts == 0


# ---------------------------------------------------------------------------- closed forms


@EVERY
def test_bounces_die_in_a_time_that_is_a_sum_of_quarter_periods(solve, block):
    block, start = block.with_restitution(0.5), 0.6 * block.slenderness
    levels = potential(block, start) * 0.25 ** np.arange(6)
    quarters = [quarter_period(block, turning_rotation(block, level)) for level in levels]
    history = solve(block, rotation=start, samples=2)
    expected = 2 * np.cumsum(quarters) - quarters[0]
    np.testing.assert_allclose(history.impact_times[:6], expected, atol=1e-6)
    assert (history.outcome, history.peak_rotation) == ("rests", pytest.approx(start, rel=1e-12))
    assert len(history.impact_times) < 40


@EVERY
@pytest.mark.parametrize("restitution", [0.5, 0.9, 1.0])
def test_energy_is_kept_between_impacts_and_cut_at_each(solve, block, restitution):
    block, times = block.with_restitution(restitution), np.linspace(0.0, 6.0, 401)
    history = solve(block, rotation=0.2, velocity=-0.05, duration=6.0, samples=times)
    level = [
        energy(block, abs(x), v) for x, v in zip(history.rotation, history.velocity, strict=True)
    ]
    passed = np.searchsorted(history.impact_times, times)
    live = (passed < 8) & (np.min(np.abs(times[:, None] - history.impact_times), axis=1) > 1e-7)
    expected = energy(block, 0.2, -0.05) * restitution ** (2 * passed)
    np.testing.assert_allclose(np.array(level)[live], expected[live], rtol=1e-6, atol=1e-12)
    assert passed[live].max() >= 2


@EVERY
@SIDES
def test_barrier_decides_from_every_start(solve, block, side):
    """Also beyond α, on the way back, and through an impact to the other side."""
    summit, far = barrier(block), 1.2 * block.slenderness
    left = summit / block.restitution**2  # is the barrier behind one impact
    for tilt, rate, impacts in (  # before overturning; None if it survives
        (0.0, speed(block, summit) * (1 - 1e-5), None),
        (0.0, speed(block, summit) * (1 + 1e-5), 0),
        (far, -speed(block, summit, far) * 1.0001, None),
        (far, -speed(block, summit, far) * 0.9999, 0),
        (far, 0.0, 0),
        (far, 0.1, 0),
        (0.1, -speed(block, 0.999 * left, 0.1), None),
        (0.1, -speed(block, 1.001 * left, 0.1), 1),
        (0.0, speed(block, 0.5 * summit), None),
    ):
        history = solve(block, rotation=side * tilt, velocity=side * rate, samples=5)
        assert history.outcome == ("rests" if impacts is None else "overturned"), (tilt, rate)
        assert [history.rotation[0], history.velocity[0]] == pytest.approx(
            [side * tilt, side * rate]
        )
        if impacts is not None:
            assert (history.number_of_impacts, math.isnan(history.peak_rotation)) == (impacts, True)
            last = history.rotation[np.isfinite(history.rotation)][-1]
            assert side * (-1) ** impacts * last > tilt or solve is not th.simulate
        elif rate >= 0.0:
            level = energy(block, tilt, rate)
            turned = pytest.approx(turning_rotation(block, level), rel=1e-7)
            assert history.peak_rotation == turned
        else:
            assert history.peak_rotation == pytest.approx(
                max(tilt, history.peak_rotation), rel=1e-9
            )


def test_exact_block_lies_flat_at_a_right_angle_and_nothing_is_known_beyond():
    for solve in (th.simulate, plain.simulate):
        history = solve(BLOCK, rotation=0.26, velocity=0.2, samples=np.linspace(0.0, 20.0, 2001))
        known = np.isfinite(history.rotation)
        last = np.count_nonzero(known)
        assert known[:last].all()
        assert 1.4 < history.rotation[last - 1] <= math.pi / 2
        assert np.all(np.diff(history.rotation[known]) > 0)
        assert (len(history.time), history.outcome) == (2001, "overturned")
    assert th.simulate(BLOCK.linear(), rotation=1.6).outcome == "overturned"


# ---------------------------------------------------------------------------- uplift


@EVERY
@SIDES
@pytest.mark.parametrize("shape", CLOSED_PULSES)
def test_block_lifts_beyond_its_threshold_alone(solve, block, shape, side):
    """To the side opposite to that of the ground's acceleration, and only then."""
    level = side * block.uplift_acceleration
    for strength in (0.5, 0.999, 1.0, 1.01, 1.5):
        pulse = th.Pulse(shape, strength * level, angular_frequency=10.0)
        history = solve(block, pulse, samples=np.linspace(0.0, 0.12, 21))
        assert (history.outcome == "no uplift") == (strength <= 1.0)
        assert (history.peak_rotation != 0) == (strength > 1.0)
        assert strength > 1.0 or not (history.rotation.any() or history.impact_times.size)
        assert strength < 1.5 or np.all(side * history.rotation[:-1] <= 0)
        assert strength < 1.5 or side * history.rotation[-1] < 0
    still = solve(block, duration=3.0, samples=4)
    assert (still.outcome, still.peak_rotation, still.time[-1]) == ("no uplift", 0, 3.0)


@BY_TWO
@pytest.mark.parametrize("place", [5, 40, 63, 64, 150])
def test_one_sample_above_the_threshold_lifts_the_block(solve, place):
    """It is among two hundred that are weaker, and the gravity changes a little."""
    up = th.Record(0.02, 1e-4 * np.sin(np.arange(200.0)))
    for excess, outcome in ((-0.002, True), (0.002, False)):
        push = np.where(np.arange(200) == place, (1.0 + excess) * BLOCK.uplift_acceleration, 0.0)
        response = solve(BLOCK, th.Record(0.02, push), vertical=up, samples=2)
        assert (response.outcome == "no uplift") is outcome


def twin(peak, second=1.0):
    """Two triangles of 0.4 s, 10 s apart; the second is `second` times the first."""
    triangle = np.array([0.0, 0.5, 1.0, 0.5, 0.0])
    return th.Record(0.1, peak * np.concatenate([triangle, np.zeros(99), second * triangle]))


@EVERY
@pytest.mark.parametrize("restitution", [0.0, 0.3])
def test_block_lifts_again_after_it_has_come_to_rest(solve, block, restitution):
    block, times = block.with_restitution(restitution), np.linspace(0, 3, 101)
    peak, close = 2.0 * block.uplift_acceleration, 1e-7 * block.slenderness
    for second in (1.0, -1.0):
        twice = solve(block, twin(peak, second), samples=np.append(times, times + 10.4))
        once, again = twice.rotation[:101], twice.rotation[101:]
        np.testing.assert_allclose(again, second * once, atol=close)
        assert np.abs(once).max() > 1e-3
        assert not np.any(np.abs(once[-5:]) > 10 * close)
    if restitution == 0.0:
        free = solve(block, rotation=0.1, samples=np.linspace(0.0, 9.0, 50))
        assert (len(twice.impact_times), len(free.impact_times), twice.outcome) == (2, 1, "rests")
        assert not free.rotation[free.time > free.impact_times[0] + 0.01].any()
    weak = solve(block, twin(0.6 * peak, 1.4), samples=2).peak_rotation
    single = solve(block, twin(0.84 * peak, 0.0), samples=2).peak_rotation
    assert weak == pytest.approx(single, rel=1e-6)


@EVERY
def test_block_without_restitution_lifts_at_once_when_it_lands_on_strong_ground(solve, block):
    block = block.with_restitution(0.0)
    pulse = th.Pulse("constant", 3.0 * block.uplift_acceleration, angular_frequency=math.pi / 0.6)
    history = solve(block, pulse, rotation=0.02, duration=0.6, samples=301)
    assert history.number_of_impacts == 1
    after = history.time > history.impact_times[0] + 1e-3
    fresh = solve(block, pulse, samples=history.time[after] - history.impact_times[0])
    np.testing.assert_allclose(history.rotation[after], fresh.rotation, atol=1e-8)
    assert np.all(history.rotation[after] < 0)


@EVERY
@SIDES
@pytest.mark.parametrize("margin", [1e-3, 1e-5])  # 1e-6 dips by less than 1e-6 α: no impact
def test_grazing_impacts_are_neither_missed_nor_invented(solve, block, margin, side):
    """Thrown at the ground under an outward push: it turns, or dips and returns."""
    push, start = 2.0 * block.uplift_acceleration, 0.2 * block.slenderness
    lean = block.slenderness - start
    work = push * (start if block.linearised else math.sin(block.slenderness) - math.sin(lean))
    critical = block.frequency_parameter * math.sqrt(2 * (work - potential(block, start)))
    pulse = th.Pulse("constant", -side * push, angular_frequency=math.pi / 0.35)
    for factor, impacts in ((1 - margin, 0), (1 + margin, 2)):
        thrown = {"rotation": side * start, "velocity": -side * critical * factor}
        history = solve(block, pulse, **thrown, duration=0.35, samples=2)
        assert np.count_nonzero(history.impact_times <= 0.35) == impacts
        assert side * history.rotation[-1] > 0
