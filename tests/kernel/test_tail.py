"""Free rocking in closed form, against `topheavy.bodies.free_rocking` and where digits cancel."""

import math

import numpy as np
import pytest

from topheavy import RockingBlock
from topheavy.bodies import free_rocking
from topheavy.kernel import tail
from topheavy.kernel.taylor import oscillator

BLOCK = RockingBlock(1.0, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])


@BOTH
def test_ending_is_that_of_the_readable_route(block):
    random, kinds = np.random.default_rng(7), set()
    for _ in range(2000):
        restitution = float(random.uniform(0.0, 1.0))
        block = RockingBlock(
            1.0, float(random.uniform(0.01, 0.6)), restitution, linearised=block.linearised
        )
        rotation = block.slenderness * float(random.uniform(0.0, 1.6))
        velocity = block.slenderness * float(random.uniform(-2.0, 1.2))
        expected = free_rocking.ending(block, rotation, velocity)
        found = tail.free_rocking(oscillator(block), rotation, velocity)
        assert (found.overturned, found.impacts) == (expected.overturned, expected.impacts)
        if not found.overturned:
            peak = max(rotation, expected.peak)
            assert found.peak == pytest.approx(peak, rel=1e-7)
        kinds.add((found.overturned, found.impacts, rotation > block.slenderness, velocity > 0))
    # not the three that cannot be: impacts of survivors, survivors that move outward beyond α
    assert kinds == {
        (True, 0, True, True),
        (True, 0, True, False),
        (True, 0, False, True),
        (True, 1, True, False),
        (True, 1, False, False),
        (False, 0, True, False),
        (False, 0, False, True),
        (False, 0, False, False),
    }


@BOTH
def test_way_7_beyond_alpha_is_not_overturned(block):
    there = oscillator(block)
    barrier = math.sqrt(-2 * tail.surplus(there, 0.32, 0.0))
    back = tail.free_rocking(there, 0.32, -1.001 * barrier)
    assert not back.overturned
    assert back.peak == 0.32
    assert tail.free_rocking(there, 0.32, -0.999 * barrier).overturned
    assert tail.free_rocking(there, 0.32, 0.0).overturned
    assert tail.free_rocking(there, 0.32, 1e-3).overturned
