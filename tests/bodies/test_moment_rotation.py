"""The restoring moment against the energy that it stores."""

import math

import numpy as np
import pytest

from topheavy import Column, RockingFrame
from topheavy.bodies.free_rocking import potential
from topheavy.bodies.kinematics import cap_displacement
from topheavy.bodies.moment_rotation import restoring_moment

COLUMN = Column(0.5, 2.0)
FRACTIONS = np.array([-0.99, -0.5, -0.02, 0.02, 0.3, 0.99, 1.4])
MASS_RATIOS = [0.0, 0.434, 1.0, 7.0]


@pytest.mark.parametrize("column", [COLUMN, Column(1.0, 1.0)])
def test_moment_is_the_slope_of_the_potential(column):
    tilts, step = FRACTIONS[FRACTIONS > 0] * column.slenderness, 1e-6
    block = column.block(restitution=0.5)
    slopes = [(potential(block, x + step) - potential(block, x - step)) / (2 * step) for x in tilts]
    np.testing.assert_allclose(restoring_moment(column, tilts), slopes, atol=1e-9)


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_moment_of_the_frame_is_the_slope_of_the_weight_that_it_lifts(mass_ratio):
    # Of one column, over m_c g R: its own centre, and half of the cap beam, γ m_c.
    frame = RockingFrame(COLUMN, mass_ratio)
    size, alpha, step = COLUMN.size, COLUMN.slenderness, 1e-6

    def stored(theta):
        centre = size * np.cos(alpha - np.abs(theta))
        return (centre + mass_ratio * cap_displacement(COLUMN, theta)[1]) / size

    theta = FRACTIONS * alpha
    slopes = (stored(theta + step) - stored(theta - step)) / (2 * step)
    np.testing.assert_allclose(restoring_moment(frame, theta), slopes, atol=1e-8)


@pytest.mark.parametrize("mass_ratio", MASS_RATIOS)
def test_cap_beam_multiplies_the_moment_alone(mass_ratio):
    theta = FRACTIONS * COLUMN.slenderness
    ratio = restoring_moment(RockingFrame(COLUMN, mass_ratio), theta) / restoring_moment(
        COLUMN, theta
    )
    np.testing.assert_allclose(ratio, 1 + 2 * mass_ratio, rtol=1e-14)


def test_moment_opposes_the_rotation_up_to_the_slenderness():
    theta = np.array([1e-12, 0.1, COLUMN.slenderness, 0.5])
    moment = restoring_moment(COLUMN, theta)
    np.testing.assert_array_equal(restoring_moment(COLUMN, -theta), -moment)
    assert moment[0] == pytest.approx(math.sin(COLUMN.slenderness), rel=1e-10)
    assert moment[0] > moment[1] > moment[2] == 0.0 > moment[3]


def test_moment_at_rest_is_the_limit_from_above():
    assert restoring_moment(COLUMN, 0.0) == pytest.approx(0.5 / COLUMN.size, rel=1e-15)


def test_columns_without_mass_are_refused():
    with pytest.raises(ValueError, match="expected a finite γ"):
        restoring_moment(RockingFrame(COLUMN, math.inf), 0.1)
