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
def test_energies_are_those_of_the_readable_route(block):
    there = oscillator(block)
    assert tail.barrier(there) == pytest.approx(free_rocking.barrier(block), rel=1e-14)
    for rotation, velocity in ((0.1, -0.2), (0.25, 0.0), (0.4, 0.3)):
        level = free_rocking.energy(block, rotation, velocity)
        assert tail.landing_energy(there, rotation, velocity) == pytest.approx(level, rel=1e-14)
        over = level - free_rocking.barrier(block)
        assert tail.surplus(there, rotation, velocity) == pytest.approx(over, abs=1e-16)


@BOTH
@pytest.mark.parametrize("rotation", [1e-14, 1e-9, 1e-4, 0.1, 0.2499])
def test_block_that_is_let_go_turns_where_it_was(block, rotation):
    """Down to rotations of which cos(α − φ) − cos α would have lost every digit."""
    there = oscillator(block)
    energy = tail.landing_energy(there, rotation, 0.0)
    assert tail.turning_rotation(there, energy) == pytest.approx(rotation, rel=1e-12)
    assert tail.free_rocking(there, rotation, 0.0).peak == pytest.approx(rotation, rel=1e-12)


@BOTH
@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9, 1e-12])
def test_verdict_near_the_top_is_right_to_the_last_digits(block, distance):
    """φ = α (1 − d): it goes over if φ' exceeds α d, of which the energies would keep nothing."""
    there, rotation = oscillator(block), 0.25 * (1 - distance)
    for factor in (1 - 1e-3, 1 + 1e-3):
        # (2 sin(x/2) and x are the same here)
        velocity = (0.25 - rotation) * factor
        assert tail.free_rocking(there, rotation, velocity).overturned == (factor > 1)


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


@BOTH
def test_block_poised_at_alpha_has_not_overturned_by_less_than_nothing(block):
    assert tail.free_rocking(oscillator(block), 0.25, 1e-9).overturned
    assert not tail.free_rocking(oscillator(block), 0.25, 0.0).overturned  # it moves nowhere
    below = tail.free_rocking(oscillator(block), 0.25, -1e-9)
    assert not below.overturned
    assert below.peak == 0.25


@BOTH
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_impact_multiplies_the_energy_by_r(block, restitution):
    there = oscillator(block.with_restitution(restitution))
    level = 0.8 * tail.barrier(there)
    velocity = -math.sqrt(2 * level)
    bounced = tail.free_rocking(there, 0.0, velocity)
    expected = tail.turning_rotation(there, restitution**2 * level)
    assert bounced.peak == pytest.approx(expected, abs=1e-15)
