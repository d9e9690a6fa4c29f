"""Free rocking: energy against its own quadrature, periods against elliptic integrals."""

import dataclasses
import math

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.special import ellipk, ellipkinc

from topheavy import Column, RockingBlock, RockingFrame, simulate
from topheavy.bodies.free_rocking import (
    barrier,
    ending,
    energy,
    energy_drift,
    potential,
    quarter_period,
    turning_rotation,
)

P, ALPHA = 2.3, 0.25
EXACT = RockingBlock(P, ALPHA, 0.9)
BOTH = pytest.mark.parametrize("block", [EXACT, EXACT.linear()], ids=["exact", "linear"])
NODES, WEIGHTS = leggauss(12)
STONE, FRAME = Column(0.5, 2.0), RockingFrame(Column(0.5, 2.0), 3.0)


@BOTH
@pytest.mark.parametrize("fraction", [1e-9, 1e-3, 0.3, 0.99, 1.0, 1.7])
def test_potential_is_the_area_under_the_moment(block, fraction):
    """By Gauss-Legendre quadrature of the restoring moment."""
    rotation = fraction * ALPHA
    lean = ALPHA - rotation / 2 * (1 + NODES)
    work = rotation / 2 * float(WEIGHTS @ (lean if block.linearised else np.sin(lean)))
    assert potential(block, rotation) == pytest.approx(work, rel=1e-13)


@BOTH
def test_barrier_is_the_summit_of_the_potential_and_at_the_slenderness(block):
    heights = [potential(block, tilt) for tilt in ALPHA * np.linspace(0.0, 2.0, 401)]
    assert np.argmax(heights) == 200
    assert barrier(block) == pytest.approx(heights[200], rel=1e-14)
    assert (heights[0], heights[-1]) == (0.0, pytest.approx(0.0, abs=1e-16))


@BOTH
@pytest.mark.parametrize("rate", [0.0, 0.3, -0.3])
def test_energy_is_potential_and_the_square_of_the_rate(block, rate):
    expected = potential(block, 0.1) + rate**2 / (2 * P**2)
    assert energy(block, 0.1, rate) == pytest.approx(expected, rel=1e-15)
    # one inertia, one weight: e does not know of p at rest
    assert energy(FRAME.block(), 0.1, 0.0) == energy(STONE.block(), 0.1, 0.0)


@BOTH
@pytest.mark.parametrize("fraction", [0.0, 1e-6, 0.2, 0.7, 0.999, 1.0])
def test_block_turns_where_its_energy_is_all_potential(block, fraction):
    found = turning_rotation(block, potential(block, fraction * ALPHA))
    # near the summit the rotation changes with the root of the energy
    assert found == pytest.approx(fraction * ALPHA, abs=1e-8 * ALPHA)
    assert 0.0 <= found <= ALPHA


# ---------------------------------------------------------------------------- ending

LITTLE = 1e-9


def rate_for(block, level, rotation):
    return P * math.sqrt(2 * (level - potential(block, rotation)))


def beside(block, start, level, side):
    """The endings with a little less and a little more than a level of energy."""
    return (
        ending(block, start, side * rate_for(block, level * (1 + sign * LITTLE), start))
        for sign in (-1, 1)
    )


@BOTH
@pytest.mark.parametrize("fraction", [0.0, 0.4, 0.9])
def test_block_within_its_slenderness_needs_the_barrier_to_overturn(block, fraction):
    """One that moves in is judged again behind the impact."""
    below, above = beside(block, fraction * ALPHA, barrier(block), 1)
    assert (below.overturned, below.impacts) == (False, 0)
    assert (above.overturned, above.impacts, math.isnan(above.peak)) == (True, 0, True)
    assert below.peak == pytest.approx(ALPHA, rel=1e-4)
    below, above = beside(block, 0.3 * ALPHA, barrier(block) / block.restitution**2, -1)
    assert (below.overturned, below.impacts) == (False, 0)
    assert (above.overturned, above.impacts) == (True, 1)
    assert below.peak == pytest.approx(ALPHA, rel=1e-4)


@BOTH
def test_block_beyond_its_slenderness_is_lost_unless_it_comes_in_over_the_barrier(block):
    start = 1.3 * ALPHA
    short, saved = beside(block, start, barrier(block), -1)
    assert short.overturned
    assert all(ending(block, start, rate).overturned for rate in (0.0, 1e-12, 10.0))
    # the larger of where it is and of what follows
    assert (saved.overturned, saved.peak) == (False, start)
    lossless = block.with_restitution(1.0)  # poised, it survives
    assert ending(lossless, ALPHA, 0.0).overturned is False
    assert ending(lossless, math.nextafter(ALPHA, 1.0), 0.0).overturned


@BOTH
def test_block_peaks_where_it_turns_on_either_side_or_where_it_is(block):
    start, level = 0.3 * ALPHA, 0.8 * barrier(block)
    out = ending(block, start, rate_for(block, level, start)).peak
    back = ending(block, start, -rate_for(block, level, start)).peak
    for peak, left in ((out, 1.0), (back, block.restitution**2)):
        assert potential(block, peak) == pytest.approx(left * level, rel=1e-12)
        assert start < peak < ALPHA
    assert ending(block, start, 0.0).peak == ending(block, start, -1e-3).peak == start


@BOTH
@pytest.mark.parametrize("case", [(0.3, 0.5), (0.3, -0.7), (1.1, -0.4), (0.8, -0.05)])
def test_ending_is_what_integration_finds(block, case):
    tilt, rate = case[0] * ALPHA, case[1] * ALPHA * P
    end = ending(block, tilt, rate)
    history = simulate(block, rotation=tilt, velocity=rate, samples=np.linspace(0, 6, 3001))
    assert not end.overturned
    assert np.max(np.abs(history.rotation)) == pytest.approx(end.peak, rel=1e-5)


# ---------------------------------------------------------------------------- quarter period


@pytest.mark.parametrize("slenderness", [0.05, 0.25, 0.7, 1.5])
@pytest.mark.parametrize("fraction", [0.01, 0.3, 0.5, 0.9, 0.999])
def test_quarter_period_is_that_of_the_pendulum_on_its_head(slenderness, fraction):
    """By elliptic integrals: with u = α − φ it is an inverted pendulum, u'' = p² sin u.

    Released at π − u₀ from its lowest point, it is timed down to π − α.
    """
    found, error = quarter_period(RockingBlock(P, slenderness, 0.9), fraction * slenderness)
    modulus = math.cos(slenderness * (1 - fraction) / 2)
    reached = math.asin(math.cos(slenderness / 2) / modulus)
    expected = float(ellipk(modulus**2) - ellipkinc(reached, modulus**2)) / P
    assert found == pytest.approx(expected, rel=1e-8)
    assert 0.0 <= error < 1e-9 * found


@pytest.mark.parametrize("slenderness", [0.05, 0.25, 1.0])
def test_small_rotations_fall_as_under_a_constant_moment(slenderness):
    block = RockingBlock(P, slenderness, 0.9)
    for fraction in (1e-3, 1e-6, 1e-12):
        start = fraction * slenderness
        # acosh(1 + ε) loses digits as ε does
        close = fraction + (1e-4 if fraction == 1e-12 else 1e-9)
        for each, moment in ((block, math.sin(slenderness)), (block.linear(), slenderness)):
            expected = math.sqrt(2 * start / moment) / P
            assert quarter_period(each, start)[0] == pytest.approx(expected, rel=close)


@BOTH
def test_longer_falls_take_longer_without_bound_and_those_without_an_end_are_refused(block):
    fractions = [0.01, 0.1, 0.5, 0.9, 0.99, 1 - 1e-6, 1 - 1e-9]
    times = [quarter_period(block, fraction * ALPHA)[0] for fraction in fractions]
    assert np.all(np.diff(times) > 0.0)
    assert P * times[-1] > 20.0
    for fraction in (0.0, -0.5, 1.0, 1.2):
        with pytest.raises(ValueError, match=r"rotation is .* between 0 and α = 0\.25 rad"):
            quarter_period(block, fraction * ALPHA)
    with pytest.raises(ValueError, match="rotation is nan; expected a finite number"):
        quarter_period(block, math.nan)


def test_structure_falls_as_its_block_and_the_linear_one_as_housner_printed():
    for structure in (STONE, FRAME):
        assert quarter_period(structure, 0.1) == quarter_period(structure.block(), 0.1)
    for fraction, printed in ((0.5, 1.316958), (0.9, 2.993223)):
        found, error = quarter_period(EXACT.linear(), fraction * ALPHA)
        assert (P * found, error) == (pytest.approx(printed, abs=1e-6), 0.0)


# ---------------------------------------------------------------------------- drift


@pytest.mark.parametrize("linearised", [False, True])
def test_energy_drift_sees_a_motion_that_loses_energy_between_impacts(linearised):
    block = RockingBlock(2.0, ALPHA, 0.9, linearised)
    response = simulate(block, rotation=0.15, samples=2000)
    assert energy_drift(block, response, 4) < 1e-8
    damped = dataclasses.replace(response, velocity=response.velocity * 0.99**response.time)
    assert energy_drift(block, damped, 4) > 1e-3


def test_drift_is_the_whole_range_of_the_energy_over_its_mean():
    response = simulate(EXACT, rotation=0.2, duration=1.0, samples=11)
    velocity = response.velocity.copy()
    velocity[5] *= 2.0  # of one sample, before the first impact
    wrong = dataclasses.replace(response, velocity=velocity, impacts=np.array([2.0]))
    pairs = zip(np.abs(response.rotation), velocity, strict=True)
    levels = [energy(EXACT, *pair) for pair in pairs]
    expected = (max(levels) - min(levels)) / np.mean(levels)
    assert energy_drift(EXACT, wrong, 1) == pytest.approx(expected, rel=1e-12)
    assert expected > 0.01
