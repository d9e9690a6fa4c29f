"""Motion of the cap beam: Eqs. (4)–(9).

The cap translates without turning. Upper signs of the paper hold for θ < 0, lower ones for θ > 0;
with the side s = sgn θ both read alike. Eq. (9) is taken as it follows from Eq. (8), which is not
as it is printed for θ > 0.

Rotations are in rad, signed (θ > 0 leans to the right); arrays broadcast.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.structures import Column

Pair = tuple[NDArray[np.float64], NDArray[np.float64]]


def cap_displacement(column: Column, rotation: ArrayLike) -> Pair:
    """Return the horizontal displacement u and the lift v of the cap beam, m: Eqs. (4), (7)."""
    side, lean = _side_and_lean(column, rotation)
    alpha, diagonal = column.slenderness, 2.0 * column.size
    u = side * diagonal * (np.sin(alpha) - np.sin(lean))  # Eq. (4)
    v = diagonal * (np.cos(lean) - np.cos(alpha))  # Eq. (7)
    return u, v


def cap_velocity(column: Column, rotation: ArrayLike, velocity: ArrayLike) -> Pair:
    """Return u̇ and v̇ of the cap beam, m/s, from θ and θ̇ (rad/s): Eqs. (5), (8)."""
    side, lean = _side_and_lean(column, rotation)
    rate = 2.0 * column.size * np.asarray(velocity, dtype=float)
    return np.cos(lean) * rate, side * np.sin(lean) * rate  # Eq. (5), Eq. (8)


def cap_acceleration(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike
) -> Pair:
    """Return ü and v̈ of the cap beam, m/s², from θ, θ̇ (rad/s) and θ̈ (rad/s²): Eqs. (6), (9)."""
    side, lean = _side_and_lean(column, rotation)
    diagonal = 2.0 * column.size
    square = np.asarray(velocity, dtype=float) ** 2
    angular = np.asarray(acceleration, dtype=float)
    u = diagonal * (side * np.sin(lean) * square + np.cos(lean) * angular)  # Eq. (6)
    v = diagonal * (side * np.sin(lean) * angular - np.cos(lean) * square)  # Eq. (9), as meant
    return u, v


def _side_and_lean(column: Column, rotation: ArrayLike) -> Pair:
    """Return s (+1 at θ = 0, where the formulas of both sides agree in u and v) and α − |θ|."""
    theta = np.asarray(rotation, dtype=float)
    return np.where(theta < 0.0, -1.0, 1.0), column.slenderness - np.abs(theta)


def turned_with_column(
    column: Column, rotation: float, corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return where points fixed to a column, shape (n, 2), m, have gone when it has rocked by θ.

    The origin is the middle of the base at rest. For θ < 0 the column turns about its left corner,
    for θ > 0 about its right one.
    """
    pivot = np.array([np.copysign(column.half_width, rotation), 0.0])
    cos, sin = np.cos(rotation), np.sin(rotation)
    turn = np.array([[cos, -sin], [sin, cos]])  # clockwise for θ > 0, on row vectors
    turned: NDArray[np.float64] = (corners - pivot) @ turn + pivot
    return turned


def column_outline(column: Column, rotation: float) -> NDArray[np.float64]:
    """Return the corners of a column that has rocked by θ (rad), shape (5, 2), m, closed.

    The origin is the middle of the base at rest; the first corner is the lower left one.
    """
    b, h = column.half_width, column.half_height
    corners = np.array([[-b, 0.0], [b, 0.0], [b, 2 * h], [-b, 2 * h], [-b, 0.0]])
    return turned_with_column(column, rotation, corners)
