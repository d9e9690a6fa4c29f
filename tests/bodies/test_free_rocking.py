"""Bodies that rock freely: moment and rotation, energy, times, and how they move a cap beam."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import ellipk, ellipkinc

from tests.cases import fate
from topheavy import Column, RockingBlock, simulate
from topheavy.bodies.free_rocking import (
    barrier,
    energy,
    energy_drift,
    outcome_of_energy,
    potential,
    quarter_period,
    restoring_moment,
)
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement

COLUMN = Column(0.5, 2.0)
FRACTIONS = np.array([-0.99, -0.5, -0.02, 0.02, 0.3, 0.99, 1.4])


@pytest.mark.parametrize("column", [COLUMN, Column(1.0, 1.0)])
def test_moment_is_the_slope_of_the_potential(column):
    tilts, step = FRACTIONS[FRACTIONS > 0] * column.slenderness, 1e-6
    block = column.block(restitution=0.5)
    slopes = [(potential(block, x + step) - potential(block, x - step)) / (2 * step) for x in tilts]
    np.testing.assert_allclose(restoring_moment(column, tilts), slopes, atol=1e-9)


def test_moment_at_rest_is_the_limit_from_above():
    assert restoring_moment(COLUMN, 0.0) == pytest.approx(0.5 / COLUMN.size, rel=1e-15)


P, ALPHA = 2.3, 0.25
EXACT = RockingBlock(P, ALPHA, 0.9)
BOTH = pytest.mark.parametrize("block", [EXACT, EXACT.linear()], ids=["exact", "linear"])


# ---------------------------------------------------------------------------- outcome

LITTLE = 1e-9


def rate_for(block, level, rotation):
    return math.sqrt(2 * (level - potential(block, rotation)))


def beside(block, start, level, side):
    """The endings with a little less and a little more than a level of energy."""
    return (
        outcome_of_energy(block, start, side * rate_for(block, level * (1 + sign * LITTLE), start))
        for sign in (-1, 1)
    )


@BOTH
@pytest.mark.parametrize("fraction", [0.0, 0.4, 0.9])
def test_block_within_its_slenderness_needs_the_barrier_to_overturn(block, fraction):
    """One that moves in is judged again behind the impact."""
    below, above = beside(block, fraction * ALPHA, barrier(block), 1)
    assert fate(below) == (False, 0)
    assert (above.overturned, above.number_of_impacts, math.isnan(above.peak_rotation)) == (
        True,
        0,
        True,
    )
    assert below.peak_rotation == pytest.approx(ALPHA, rel=1e-4)
    below, above = beside(block, 0.3 * ALPHA, barrier(block) / block.restitution**2, -1)
    assert fate(below) == (False, 0)
    assert fate(above) == (True, 1)
    assert below.peak_rotation == pytest.approx(ALPHA, rel=1e-4)


@BOTH
def test_block_beyond_its_slenderness_is_lost_unless_it_comes_in_over_the_barrier(block):
    start = 1.3 * ALPHA
    short, saved = beside(block, start, barrier(block), -1)
    assert short.overturned
    assert all(outcome_of_energy(block, start, rate).overturned for rate in (0.0, 1e-12, 10.0))
    # the larger of where it is and of what follows
    assert (saved.overturned, saved.peak_rotation) == (False, start)
    lossless = block.with_restitution(1.0)  # poised, it survives
    assert outcome_of_energy(lossless, ALPHA, 0.0).overturned is False
    assert outcome_of_energy(lossless, math.nextafter(ALPHA, 1.0), 0.0).overturned


# ---------------------------------------------------------------------------- quarter period


@pytest.mark.parametrize("slenderness", [0.05, 0.25, 0.7, 1.5])
@pytest.mark.parametrize("fraction", [0.01, 0.3, 0.5, 0.9, 0.999])
def test_quarter_period_is_that_of_the_pendulum_on_its_head(slenderness, fraction):
    """By elliptic integrals: with u = α − φ it is an inverted pendulum, u'' = p² sin u.

    Released at π − u₀ from its lowest point, it is timed down to π − α.
    """
    time = quarter_period(RockingBlock(P, slenderness, 0.9), fraction * slenderness)
    modulus = math.cos(slenderness * (1 - fraction) / 2)
    reached = math.asin(math.cos(slenderness / 2) / modulus)
    expected = float(ellipk(modulus**2) - ellipkinc(reached, modulus**2)) / P
    assert time == pytest.approx(expected, rel=1e-8)


# ---------------------------------------------------------------------------- drift


def test_drift_is_the_whole_range_of_the_energy_over_its_mean():
    response = simulate(EXACT, rotation=0.2, duration=1.0, samples=11)
    velocity = response.velocity.copy()
    velocity[5] *= 2.0  # of one sample, before the first impact
    wrong = dataclasses.replace(response, velocity=velocity, impact_times=np.array([2.0]))
    pairs = zip(np.abs(response.rotation), velocity, strict=True)
    levels = [energy(EXACT, *pair) for pair in pairs]
    expected = (max(levels) - min(levels)) / np.mean(levels)
    assert energy_drift(EXACT, wrong, 1) == pytest.approx(expected, rel=1e-12)
    assert expected > 0.01


# ---------------------------------------------------------------------------- the cap beam

COLUMNS = [Column(0.11, 0.40), Column(0.5, 2.0), Column(1.0, 1.0)]
EVERY_COLUMN = pytest.mark.parametrize("column", COLUMNS, ids=["trilith", "slender", "square"])
TURNS = np.array([-1.9, -1.0, -0.5, -0.01, 0.01, 0.3, 1.0, 1.7])  # of α


def turned_corner(column: Column, rotation: float) -> tuple[float, float]:
    """Where the corner that carries the cap goes when the rectangle turns about its base contact.

    Positive rotations turn it clockwise about the right base contact; the cap rides on the upper
    left corner, the only one that keeps touching it from above.
    """
    side = math.copysign(1.0, rotation)
    pivot = complex(side * column.half_width, 0.0)
    corner = complex(-side * column.half_width, 2 * column.half_height)
    moved = pivot + (corner - pivot) * np.exp(-1j * rotation)
    return (moved - corner).real, (moved - corner).imag


@EVERY_COLUMN
def test_displacement_is_that_of_the_turned_rectangle(column):
    for rotation in TURNS * column.slenderness:
        u, v = cap_displacement(column, rotation)
        expected = turned_corner(column, rotation)
        assert (u, v) == pytest.approx(expected, rel=1e-12, abs=1e-13 * column.size)


@EVERY_COLUMN
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_acceleration_is_the_second_derivative_of_displacement(column, sign):
    def rotation(t):
        return sign * column.slenderness * (0.9 + 0.6 * np.sin(2.0 * t) - 0.2 * t)

    def rate(t):
        return sign * column.slenderness * (1.2 * np.cos(2.0 * t) - 0.2)

    def second(t):
        return sign * column.slenderness * (-2.4 * np.sin(2.0 * t))

    step = 1e-4
    for t in np.linspace(0.0, 2.0, 21):
        now, ahead, behind = (
            np.array(cap_displacement(column, rotation(s))) for s in (t, t + step, t - step)
        )
        acceleration = (ahead - 2 * now + behind) / step**2
        assert cap_acceleration(column, rotation(t), rate(t), second(t)) == pytest.approx(
            acceleration, abs=1e-5 * column.size
        )
