"""Free rocking: energy against its own quadrature, periods against elliptic integrals."""

import dataclasses
import math

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import ellipk, ellipkinc

from topheavy import Column, RockingBlock, RockingFrame, simulate
from topheavy.free_rocking import (
    barrier,
    ending,
    energy,
    energy_drift,
    potential,
    quarter_period,
    turning_rotation,
)

EXACT = RockingBlock(2.3, 0.25, 0.9)
BOTH = pytest.mark.parametrize("block", [EXACT, EXACT.linear()], ids=["exact", "linear"])
NODES, WEIGHTS = leggauss(12)


def work_to(block: RockingBlock, rotation: float) -> float:
    """The work of the restoring moment up to a rotation, by Gauss-Legendre quadrature."""
    lean = block.slenderness - rotation / 2 * (1 + NODES)
    return rotation / 2 * float(WEIGHTS @ (lean if block.linearised else np.sin(lean)))


@BOTH
@pytest.mark.parametrize("fraction", [1e-9, 1e-3, 0.3, 0.99, 1.0, 1.7])
def test_potential_is_the_area_under_the_moment(block, fraction):
    rotation = fraction * block.slenderness
    assert potential(block, rotation) == pytest.approx(work_to(block, rotation), rel=1e-13)


@BOTH
def test_barrier_is_the_summit_of_the_potential_and_at_the_slenderness(block):
    tilts = block.slenderness * np.linspace(0.0, 2.0, 401)
    heights = [potential(block, tilt) for tilt in tilts]
    assert np.argmax(heights) == 200
    assert barrier(block) == pytest.approx(heights[200], rel=1e-14)
    assert heights[0] == 0.0
    assert heights[-1] == pytest.approx(0.0, abs=1e-16)


@BOTH
@pytest.mark.parametrize("rate", [0.0, 0.3, -0.3])
def test_energy_is_potential_and_the_square_of_the_rate(block, rate):
    p = block.frequency_parameter
    expected = potential(block, 0.1) + rate**2 / (2 * p**2)
    assert energy(block, 0.1, rate) == pytest.approx(expected, rel=1e-15)
    stone, ratio = Column(0.5, 2.0), 3.0  # one inertia, one weight: e does not know of p at rest
    frame = RockingFrame(stone, ratio)
    assert energy(frame.block(), 0.1, 0.0) == energy(stone.block(), 0.1, 0.0)


@BOTH
@pytest.mark.parametrize("fraction", [0.0, 1e-6, 0.2, 0.7, 0.999, 1.0])
def test_block_turns_where_its_energy_is_all_potential(block, fraction):
    rotation = fraction * block.slenderness
    level = potential(block, rotation)
    # near the summit the rotation changes with the root of the energy
    assert turning_rotation(block, level) == pytest.approx(rotation, abs=1e-8 * block.slenderness)
    assert 0.0 <= turning_rotation(block, level) <= block.slenderness


# ---------------------------------------------------------------------------- ending

LITTLE = 1e-9


def rate_for(block: RockingBlock, level: float, rotation: float) -> float:
    return block.frequency_parameter * math.sqrt(2 * (level - potential(block, rotation)))


@BOTH
@pytest.mark.parametrize("fraction", [0.0, 0.4, 0.9])
def test_block_within_its_slenderness_that_moves_out_needs_the_barrier(block, fraction):
    start, summit = fraction * block.slenderness, barrier(block)
    below = ending(block, start, rate_for(block, summit * (1 - LITTLE), start))
    above = ending(block, start, rate_for(block, summit * (1 + LITTLE), start))
    assert (below.overturned, above.overturned) == (False, True)
    assert below.peak == pytest.approx(block.slenderness, rel=1e-4)
    assert below.impacts == above.impacts == 0
    assert math.isnan(above.peak)


@BOTH
def test_block_beyond_its_slenderness_is_lost_unless_it_comes_in_over_the_barrier(block):
    start, summit = 1.3 * block.slenderness, barrier(block)
    short = -rate_for(block, summit * (1 - LITTLE), start)
    enough = -rate_for(block, summit * (1 + LITTLE), start)
    assert ending(block, start, short).overturned
    assert ending(block, start, 0.0).overturned
    assert ending(block, start, 1e-12).overturned
    assert ending(block, start, 10.0).overturned
    saved = ending(block, start, enough)
    assert not saved.overturned
    assert saved.peak == start  # the larger of where it is and of what follows


@BOTH
def test_block_that_moves_in_is_judged_again_behind_the_impact(block):
    start, kept = 0.3 * block.slenderness, barrier(block) / block.restitution**2
    below = ending(block, start, -rate_for(block, kept * (1 - LITTLE), start))
    above = ending(block, start, -rate_for(block, kept * (1 + LITTLE), start))
    assert (below.overturned, below.impacts) == (False, 0)
    assert (above.overturned, above.impacts) == (True, 1)
    assert below.peak == pytest.approx(block.slenderness, rel=1e-4)


@BOTH
def test_block_that_moves_in_may_peak_on_the_other_side_or_where_it_is(block):
    start = 0.3 * block.slenderness
    fast = ending(block, start, -rate_for(block, 0.9 * barrier(block), start))
    expected = block.restitution**2 * 0.9 * barrier(block)
    assert fast.peak > start
    assert potential(block, fast.peak) == pytest.approx(expected, rel=1e-12)
    assert ending(block, start, 0.0).peak == start
    assert ending(block, start, -1e-3).peak == start


@BOTH
def test_block_moving_out_peaks_where_it_turns(block):
    start, level = 0.3 * block.slenderness, 0.8 * barrier(block)
    peak = ending(block, start, rate_for(block, level, start)).peak
    assert potential(block, peak) == pytest.approx(level, rel=1e-12)
    assert start < peak < block.slenderness


@BOTH
@pytest.mark.parametrize("case", [(0.3, 0.5), (0.3, -0.7), (1.1, -0.4), (0.8, -0.05)])
def test_ending_is_what_integration_finds(block, case):
    tilt, rate = case[0] * block.slenderness, case[1] * block.slenderness * 2.3
    end = ending(block, tilt, rate)
    history = simulate(block, rotation=tilt, velocity=rate, samples=np.linspace(0, 6, 3001))
    assert not end.overturned
    assert np.max(np.abs(history.rotation)) == pytest.approx(end.peak, rel=1e-5)


# ---------------------------------------------------------------------------- quarter period


def pendulum_time(slenderness: float, rotation: float) -> float:
    """p times the quarter period by elliptic integrals.

    With u = α − φ it is an inverted pendulum, u'' = p² sin u: released at π − u₀
    from its lowest point, it is timed down to π − α.
    """
    modulus = math.cos((slenderness - rotation) / 2)
    reached = math.asin(math.cos(slenderness / 2) / modulus)
    return float(ellipk(modulus**2) - ellipkinc(reached, modulus**2))


@pytest.mark.parametrize("slenderness", [0.05, 0.25, 0.7, 1.5])
@pytest.mark.parametrize("fraction", [0.01, 0.3, 0.5, 0.9, 0.999])
def test_quarter_period_is_that_of_the_pendulum_on_its_head(slenderness, fraction):
    block = RockingBlock(2.3, slenderness, 0.9)
    found, error = quarter_period(block, fraction * slenderness)
    expected = pendulum_time(slenderness, fraction * slenderness) / 2.3
    assert found == pytest.approx(expected, rel=1e-8)
    assert 0.0 <= error < 1e-9 * found


@pytest.mark.parametrize(("fraction", "printed"), [(0.5, 1.316958), (0.9, 2.993223)])
def test_linear_quarter_period_is_housners(fraction, printed):
    found, error = quarter_period(EXACT.linear(), fraction * 0.25)
    assert 2.3 * found == pytest.approx(printed, abs=1e-6)
    assert error == 0.0


@pytest.mark.parametrize("slenderness", [0.05, 0.25, 1.0])
def test_small_rotations_fall_as_under_a_constant_moment(slenderness):
    block = RockingBlock(2.3, slenderness, 0.9)
    for fraction in (1e-3, 1e-6, 1e-12):
        start = fraction * slenderness
        for each, moment in ((block, math.sin(slenderness)), (block.linear(), slenderness)):
            expected = math.sqrt(2 * start / moment) / 2.3
            # acosh(1 + ε) loses digits as ε does
            rounding = 1e-4 if fraction == 1e-12 else 1e-9
            assert quarter_period(each, start)[0] == pytest.approx(
                expected, rel=fraction + rounding
            )


@BOTH
def test_longer_falls_take_longer_without_bound(block):
    fractions = [0.01, 0.1, 0.5, 0.9, 0.99, 1 - 1e-6, 1 - 1e-9]
    times = [quarter_period(block, fraction * block.slenderness)[0] for fraction in fractions]
    assert np.all(np.diff(times) > 0.0)
    assert 2.3 * times[-1] > 20.0


def test_structure_falls_as_its_block():
    column = Column(0.5, 2.0)
    for structure in (column, RockingFrame(column, 2.0)):
        assert quarter_period(structure, 0.1) == quarter_period(structure.block(), 0.1)


@BOTH
@pytest.mark.parametrize("fraction", [0.0, -0.5, 1.0, 1.2])
def test_rotation_that_does_not_fall_back_is_refused(block, fraction):
    with pytest.raises(ValueError, match=r"rotation is .* expected between 0 and α = 0\.25 rad"):
        quarter_period(block, fraction * 0.25)


def test_rotation_that_is_not_finite_is_refused():
    with pytest.raises(ValueError, match="rotation is nan; expected a finite number"):
        quarter_period(EXACT, math.nan)


@pytest.mark.parametrize("linearised", [False, True])
def test_energy_drift_sees_a_motion_that_loses_energy_between_impacts(linearised):
    block = RockingBlock(2.0, 0.25, 0.9, linearised)
    response = simulate(block, rotation=0.15, samples=2000)
    assert energy_drift(block, response, 4) < 1e-8
    damped = dataclasses.replace(response, velocity=response.velocity * 0.99**response.time)
    assert energy_drift(block, damped, 4) > 1e-3


@BOTH
def test_lossless_block_poised_at_its_slenderness_survives(block):
    lossless = block.with_restitution(1.0)
    assert ending(lossless, block.slenderness, 0.0).overturned is False
    assert ending(lossless, math.nextafter(block.slenderness, 1.0), 0.0).overturned


def test_drift_is_the_whole_range_of_the_energy_over_its_mean():
    response = simulate(EXACT, rotation=0.2, duration=1.0, samples=11)
    velocity = response.velocity.copy()
    velocity[5] *= 2.0  # of one sample, before the first impact
    wrong = dataclasses.replace(response, velocity=velocity, impacts=np.array([2.0]))
    pairs = zip(response.rotation, velocity, strict=True)
    levels = [energy(EXACT, abs(phi), rate) for phi, rate in pairs]
    expected = (max(levels) - min(levels)) / np.mean(levels)
    assert energy_drift(EXACT, wrong, 1) == pytest.approx(expected, rel=1e-12)
    assert expected > 0.01
