"""A whole history with its samples: the same events as `outcome`, and the free rocking after."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from topheavy import Pulse, Record, RockingBlock, judge, simulate
from topheavy.kernel import forcing, tail
from topheavy.kernel.taylor import oscillator
from topheavy.kernel.trace import LAST_IMPACT, LONGEST_FLIGHT

few = settings(max_examples=40, deadline=None, derandomize=True, database=None)
BLOCK = RockingBlock(1.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
shapes = st.sampled_from(sorted(set(forcing.SHAPES) - {"harmonic"}))


@few
@given(shapes, st.floats(0.5, 8.0), st.floats(1.05, 6.0), st.booleans())
def test_history_ends_as_it_is_judged(shape, omega, strength, linearised):
    block = RockingBlock(1.0, 0.25, 0.9, linearised)
    pulse = Pulse(shape, strength * block.uplift_acceleration, omega)
    whole, end = simulate(block, pulse, samples=50), judge(block, pulse)
    assert (whole.overturned, whole.number_of_impacts) == (end.overturned, end.impacts)
    np.testing.assert_allclose(whole.peak_rotation, end.peak, rtol=0, atol=1e-10)


def test_certain_overturning_comes():
    """`judge` ends early where it is sure: the whole history has the same end and impacts."""
    random = np.random.default_rng(3)
    for number in range(200):
        block = RockingBlock(1.0, random.uniform(0.05, 0.5), 0.9, linearised=bool(number % 2))
        amplitude = random.uniform(1, 8) * math.tan(block.slenderness)
        pulse = Pulse("one-sine", amplitude, random.uniform(0.5, 6))
        end, whole = judge(block, pulse), simulate(block, pulse, samples=2)
        assert (whole.overturned, whole.number_of_impacts) == (end.overturned, end.impacts)


@BOTH
def test_energy_is_conserved_between_impacts_to_1e_8(block):
    free = simulate(block, rotation=0.2, samples=4000)
    energy = np.array(
        [
            tail.landing_energy(oscillator(block), abs(rotation), velocity)
            for rotation, velocity in zip(free.rotation, free.velocity, strict=True)
        ]
    )
    flight = np.searchsorted(free.impacts, free.time)
    levels = [energy[flight == n] for n in range(8)]
    for n, level in enumerate(levels):
        assert np.ptp(level) < 1e-8 * level.max()
        assert level.mean() == pytest.approx(levels[0].mean() * 0.81**n, rel=1e-8)


def test_way_5_a_block_that_came_to_rest_lifts_again():
    """Two lobes of a record: the block bounces to rest between them, and rocks again."""
    block = RockingBlock(2.0, 0.2, 0.8)
    lobe = 0.4 * np.sin(np.linspace(0, math.pi, 21))
    both = simulate(block, Record(0.01, np.concatenate([lobe, np.zeros(3000), lobe, np.zeros(10)])))
    alone = simulate(block, Record(0.01, np.concatenate([lobe, np.zeros(10)])))
    assert both.number_of_impacts > 10
    assert both.peak_rotation == pytest.approx(alone.peak_rotation, rel=1e-12)
    between = (both.time > 5.0) & (both.time < 30.0)
    assert np.count_nonzero(between) > 100
    assert not both.rotation[between].any()
    np.testing.assert_allclose(
        both.impacts[both.impacts > 30.0] - 30.21, alone.impacts, atol=1e-9
    )  # fmt: skip


def test_way_6_the_side_survives_a_restart_on_the_ground():
    free = simulate(BLOCK, rotation=0.1, samples=20_001)
    flight = np.searchsorted(free.impacts, free.time)
    for n in range(6):
        assert (np.sign(free.rotation[flight == n][1:-1]) == (-1.0) ** n).all()


@BOTH
def test_history_of_a_block_poised_at_alpha_ends(block):
    # By rounding the exact block may leave its unstable equilibrium, but not soon.
    poised = simulate(block, rotation=-0.25, samples=5)
    assert poised.time[-1] <= LONGEST_FLIGHT
    short = simulate(block, rotation=-0.25, duration=3.0, samples=5)
    assert short.time[-1] == 3.0
    np.testing.assert_allclose(short.rotation, -0.25, atol=1e-12)


def test_lossless_block_is_followed_for_a_thousand_impacts():
    lossless = BLOCK.with_restitution(1.0)
    shaken = simulate(lossless, Pulse("one-sine", 0.35, 4.0), rotation=0.02, samples=2)
    assert shaken.number_of_impacts > 0
    assert len(shaken.impacts) == LAST_IMPACT + shaken.number_of_impacts
    assert shaken.outcome == "rocking"
    longer = simulate(lossless, rotation=0.1, duration=5000.0, samples=2)
    assert len(longer.impacts) > LAST_IMPACT  # an end of one's own goes beyond


def test_linearised_block_that_runs_away_ends():
    gone = simulate(
        BLOCK.linear(), Pulse("one-sine", 0.5, 1e-3), duration=2000.0, samples=11
    )  # fmt: skip
    assert gone.outcome == "overturned"
    assert gone.time[-1] == 2000.0


@pytest.mark.parametrize("shape", ["one-sine", "ricker-antisymmetric", "constant"])
@BOTH
def test_samples_are_the_motion_however_they_are_asked_for(block, shape):
    pulse = Pulse(shape, -1.3 * block.uplift_acceleration, 4.0)
    times = np.linspace(0.0, 6.0, 1201)
    all_of_them = simulate(block, pulse, samples=times)
    assert np.abs(all_of_them.rotation).max() > 1e-3
    for some in (times[::7], times[1:2], times[-1:], np.append(times, 9.0)):
        found = simulate(block, pulse, samples=some)
        kept = some <= 6.0
        # a later end changes only where the steps behind the forcing are cut
        np.testing.assert_allclose(
            found.rotation[kept], np.interp(some[kept], times, all_of_them.rotation), atol=1e-9
        )
    uniform = simulate(block, pulse, duration=6.0, samples=1201)
    np.testing.assert_allclose(uniform.rotation, all_of_them.rotation, atol=1e-9)


def test_record_may_be_cut_anywhere():
    """Its forcing ends there, in the middle of a piece or at a sample, as if nothing followed."""
    samples = 0.32 * np.sin(np.linspace(0, 9, 60))
    for last in (20, 37):
        cut = simulate(BLOCK, Record(0.04, samples), duration=last * 0.04, samples=31)
        short = simulate(BLOCK, Record(0.04, samples[: last + 1]), samples=cut.time)
        assert cut.peak_rotation == pytest.approx(short.peak_rotation, rel=1e-12)
        assert cut.number_of_impacts == short.number_of_impacts
        np.testing.assert_allclose(cut.rotation, short.rotation, atol=1e-12)
    middle = simulate(BLOCK, Record(0.04, samples), duration=0.82, samples=31)
    half = np.append(samples[:21], 0.5 * (samples[20] + samples[21]))
    resampled = np.interp(np.arange(42) * 0.02, np.append(np.arange(21) * 0.04, 0.82), half)
    again = simulate(BLOCK, Record(0.02, resampled), samples=middle.time)
    assert middle.peak_rotation == pytest.approx(again.peak_rotation, rel=1e-9)


def test_record_that_is_cut_before_it_lifts_the_block_does_not_move_it():
    record = Record(0.1, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]))
    cut = simulate(BLOCK, record, duration=0.3)
    assert cut.outcome == "no uplift"
    assert not cut.rotation.any()
