"""The restoring moment against the energy that it stores."""

import math

import numpy as np
import pytest

from topheavy import Column, RockingFrame
from topheavy.bodies.free_rocking import potential
from topheavy.bodies.moment_rotation import restoring_moment

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


def test_columns_without_mass_are_refused():
    with pytest.raises(ValueError, match="expected a finite γ"):
        restoring_moment(RockingFrame(COLUMN, math.inf), 0.1)
