"""Many histories at once: each in its place, whoever computed it."""

import math

import numpy as np
import pytest

from benchmarks import kernel as timed
from topheavy import RockingBlock
from topheavy.kernel import forcing
from topheavy.kernel.forcing import prepare_record
from topheavy.kernel.grid import (
    FEWEST_FACTORS,
    FEWEST_PULSES,
    mixed_outcomes_of,
    outcome_of,
    outcomes_of,
)
from topheavy.kernel.outcome import TOLERANCE
from topheavy.kernel.taylor import oscillator

BLOCK = oscillator(RockingBlock(1.0, math.radians(14.0), 0.87))
SCALES, AMPLITUDES = np.linspace(0.5, 10, 61), np.linspace(0.25, 2.5, 31)


def same(first, second) -> None:
    for one, other in zip(first, second, strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("threads", [2, 3, 7])
@pytest.mark.parametrize("shape", [forcing.ONE_SINE, forcing.RICKER_SYMMETRIC])
def test_results_do_not_depend_on_the_number_of_threads(shape, threads):
    assert SCALES.size * AMPLITUDES.size > 3 * FEWEST_PULSES
    alone = outcomes_of(BLOCK, shape, SCALES, AMPLITUDES, threads=1)
    same(outcomes_of(BLOCK, shape, SCALES, AMPLITUDES, threads=threads), alone)
    same(outcomes_of(BLOCK, shape, SCALES, AMPLITUDES), alone)


def test_each_cell_is_the_history_of_its_scale_and_amplitude():
    peak, overturned, impacts = outcomes_of(BLOCK, forcing.ONE_SINE, SCALES, AMPLITUDES)
    assert peak.shape == overturned.shape == impacts.shape == (SCALES.size, AMPLITUDES.size)
    for i in range(0, SCALES.size, 8):
        for j in range(0, AMPLITUDES.size, 3):
            alone = outcome_of(BLOCK, forcing.ONE_SINE, SCALES[i], AMPLITUDES[j])
            assert (overturned[i, j], impacts[i, j]) == (alone.overturned, alone.impacts)
            np.testing.assert_allclose(peak[i, j], alone.peak, rtol=0, atol=1e-9)


@pytest.mark.parametrize("threads", [2, 5])
def test_factors_on_a_record_do_not_depend_on_the_number_of_threads(threads):
    record = prepare_record(0.4 * np.sin(np.linspace(0, 30, 700)))
    steps, factors = np.array([0.02, 0.03]), np.linspace(-2.0, 3.0, 3 * FEWEST_FACTORS + 1)
    alone = outcomes_of(BLOCK, forcing.RECORD, steps, factors, record, threads=1)
    same(outcomes_of(BLOCK, forcing.RECORD, steps, factors, record, threads=threads), alone)


def test_history_that_was_given_up_is_named_in_the_message():
    """A nudge and then a long quiet: without loss, the bounces of 1e-4 each never die."""
    lossless = oscillator(RockingBlock(1.0, 0.2, 1.0))
    record = prepare_record(lossless.level * np.array([0.0, 1.0, *np.zeros(300)]))
    case = r"1\.0001 times the record with p Δt = 1: .*0\.2 rad, restitution 1, exact equation"
    with pytest.raises(
        ArithmeticError, match=rf"^200000 steps.*{case}.*bounces too often.*smaller"
    ):
        outcomes_of(lossless, forcing.RECORD, np.ones(1), np.array([0.5, 1.0001]), record)
    damped = lossless._replace(restitution=0.9)
    overturned = outcomes_of(damped, forcing.RECORD, np.ones(1), np.array([1.0001]), record)[1]
    assert not overturned.any()


def mixture(shape, seed):
    """Histories of unlike blocks in an arbitrary order, of both equations."""
    rng = np.random.default_rng(seed)
    blocks = [
        oscillator(RockingBlock(1.0, math.radians(alpha), restitution, linearised))
        for alpha, restitution in ((5.0, 0.95), (14.0, 0.9), (31.0, 0.3))
        for linearised in (False, True)
    ]
    which = rng.permutation(np.repeat(np.arange(len(blocks)), 23))
    scales = rng.choice([0.011, 0.02, 0.043] if shape == forcing.RECORD else [0.7, 3.0, 6.1], 138)
    levels = np.array([block.level for block in blocks])[which]
    return blocks, which, scales, levels * rng.uniform(0.9, 6.0, which.size)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("shape", [forcing.ONE_SINE, forcing.RICKER_ANTISYMMETRIC, forcing.RECORD])
def test_histories_of_mixed_blocks_have_the_bits_of_each_alone(shape, threads):
    record = forcing.NO_RECORD
    if shape == forcing.RECORD:
        time = np.linspace(0, 20, 500)
        record = prepare_record(np.sin(3 * time) + 0.7 * np.sin(1 + 7.7 * time))
    blocks, which, scales, amplitudes = mixture(shape, 3)
    found = mixed_outcomes_of(blocks, shape, which, scales, amplitudes, record, threads=threads)
    assert 0.1 < found[1].mean() < 0.9
    for k in range(which.size):
        alone = outcomes_of(
            blocks[which[k]], shape, scales[k : k + 1], amplitudes[k : k + 1], record
        )
        for one, other in zip(found, alone, strict=True):
            np.testing.assert_array_equal(one[k], other[0, 0])


def test_history_of_a_mixture_that_was_given_up_is_named_with_its_block():
    lossless = oscillator(RockingBlock(1.0, 0.2, 1.0))
    record = prepare_record(lossless.level * np.array([0.0, 1.0, *np.zeros(300)]))
    with pytest.raises(ArithmeticError, match=r"1\.0001 times .*p Δt = 1: .*0\.2 rad, restit.* 1,"):
        mixed_outcomes_of(
            [BLOCK, lossless],
            forcing.RECORD,
            np.array([0, 1, 0]),
            np.array([0.5, 1.0, 0.5]),
            np.array([1.2, 1.0001, 1.3]),
            record,
        )


def test_both_kernels_that_the_benchmark_times_find_the_same():
    block = RockingBlock(1.0, math.radians(14.0), 0.87)
    motions = np.linspace(0.25, 2.5, 40), np.linspace(0.5, 10.0, 40)
    together, alone = (
        run(block, "one-sine", *motions) for run in (timed.histories, timed.scalar_histories)
    )
    assert 0 < together[0].sum() < 40
    np.testing.assert_allclose(alone, together, rtol=1e-6)
    shaken = block, 0.4 * np.sin(np.arange(80) / 8.0), 0.05, TOLERANCE
    one, other = (run(*shaken)() for run in (timed.KernelRecord, timed.ScalarRecord))
    assert one == pytest.approx(other, rel=1e-6)
    assert other.impacts > 0
