"""The cap beam's motion against a rectangle that is turned about its corner, point by point."""

import math

import numpy as np
import pytest

from topheavy import Column
from topheavy.bodies.kinematics import cap_acceleration, cap_displacement

COLUMNS = [Column(0.11, 0.40), Column(0.5, 2.0), Column(1.0, 1.0)]
FRACTIONS = np.array([-1.9, -1.0, -0.5, -0.01, 0.01, 0.3, 1.0, 1.7])  # of α

pytestmark = pytest.mark.parametrize("column", COLUMNS, ids=["trilith", "slender", "square"])


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


def test_displacement_is_that_of_the_turned_rectangle(column):
    for rotation in FRACTIONS * column.slenderness:
        u, v = cap_displacement(column, rotation)
        expected = turned_corner(column, rotation)
        assert (u, v) == pytest.approx(expected, rel=1e-12, abs=1e-13 * column.size)


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
        here, ahead, behind = (
            np.array(cap_displacement(column, rotation(s))) for s in (t, t + step, t - step)
        )
        acceleration = (ahead - 2 * here + behind) / step**2
        assert cap_acceleration(column, rotation(t), rate(t), second(t)) == pytest.approx(
            acceleration, abs=1e-5 * column.size
        )
