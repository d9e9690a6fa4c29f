"""Pulses in lanes: outcomes and impacts of the scalar kernel, and its peaks but for rounding."""

import math

import numpy as np
import pytest

from topheavy import RockingBlock
from topheavy.kernel.forcing import ONE_SINE, SHAPES
from topheavy.kernel.grid import outcome_of, outcomes_of
from topheavy.kernel.taylor import oscillator

ENDING = sorted(set(SHAPES) - {"harmonic"})
#: Peaks differ by so much of α, as both kernels leave out terms below the tolerance.
CLOSE = 1e-8


def alone(block, shape, scales, amplitudes):
    """Peak, overturned and impacts of all cells, by the scalar kernel."""
    found = [[outcome_of(block, shape, s, a) for a in amplitudes] for s in scales]
    peak = [[one.peak for one in row] for row in found]
    overturned = [[one.overturned for one in row] for row in found]
    return np.array(peak), np.array(overturned), [[one.impacts for one in row] for row in found]


@pytest.mark.parametrize("degrees", [3.0, 9.5, 20.0, 40.0])
@pytest.mark.parametrize("linearised", [False, True], ids=["exact", "linearised"])
@pytest.mark.parametrize("shape", ENDING)
def test_outcomes_and_impacts_are_those_of_the_scalar_kernel(shape, linearised, degrees):
    alpha, rng = math.radians(degrees), np.random.default_rng(round(degrees))
    for restitution in (1.0 - 1.5 * math.sin(alpha) ** 2, 0.5):
        block = oscillator(RockingBlock(1.0, alpha, restitution, linearised))
        scales = rng.uniform(0.4, 10.0, 9)
        near = rng.uniform(0.99, 1.2, 8)
        amplitudes = block.level * np.concatenate([near, rng.uniform(1.0, 10.0, 12)])
        peak, overturned, impacts = outcomes_of(block, SHAPES[shape], scales, amplitudes)
        expected = alone(block, SHAPES[shape], scales, amplitudes)
        np.testing.assert_array_equal(overturned, expected[1])
        np.testing.assert_array_equal(impacts, expected[2])
        np.testing.assert_allclose(peak, expected[0], rtol=0, atol=CLOSE * alpha)
    assert (overturned != overturned[0, 0]).any()


def test_history_that_was_given_up_is_named_by_both_kernels():
    """Lifted by a trillionth of the uplift level and without loss, a block bounces on and on."""
    block = oscillator(RockingBlock(1.0, 0.2, 1.0))
    shape, scales, amplitude = SHAPES["half-sine"], np.array([0.5]), block.level * (1 + 1e-12)
    named = r"half-sine pulse of 0\.20271 g with ω/p = 0\.5"
    with pytest.raises(ArithmeticError, match=named):
        outcome_of(block, shape, 0.5, amplitude)
    with pytest.raises(ArithmeticError, match=named):
        outcomes_of(block, shape, scales, np.array([1.0, amplitude, 0.9]))


def test_no_cell_depends_on_the_others():
    """Whichever cells share the lanes, in whatever order: the same bits."""
    block = oscillator(RockingBlock(1.0, 0.2, 0.9))
    scales, amplitudes = np.linspace(0.5, 9.0, 13), block.level * np.linspace(1.001, 8.0, 17)
    whole = outcomes_of(block, ONE_SINE, scales, amplitudes)
    back = outcomes_of(block, ONE_SINE, scales[::-1].copy(), amplitudes[::-1].copy())
    for one, other in zip(whole, back, strict=True):
        np.testing.assert_array_equal(one, other[::-1, ::-1])
    for i, j in ((0, 0), (5, 11), (12, 16)):
        cell = outcomes_of(block, ONE_SINE, scales[i : i + 1], amplitudes[j : j + 1])
        for one, other in zip(whole, cell, strict=True):
            np.testing.assert_array_equal(one[i, j], other[0, 0])
