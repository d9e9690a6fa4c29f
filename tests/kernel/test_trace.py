"""A whole history with its samples: the same events as `outcome`, and the free rocking after."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from topheavy import Pulse, Record, RockingBlock, judge, simulate
from topheavy.kernel import forcing, tail
from topheavy.kernel.taylor import oscillator

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
