"""Motion of the cap beam: Eqs. (4)–(9).

The cap translates without turning. Upper signs of the paper hold for θ < 0, lower ones for θ > 0;
with the side s = sgn θ one formula serves both. We use Eq. (9) as it follows from Eq. (8), which
differs from the printed form for θ > 0.

Rotations are in rad, signed (θ > 0 leans to the right); arrays broadcast.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.structures import Column, RockingFrame, Structure
from topheavy.checks import short

Pair = tuple[NDArray[np.float64], NDArray[np.float64]]


def cap_displacement(
    column: Column, rotation: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the horizontal and vertical displacements u, v of the cap beam, m: Eqs. (4), (7).

    Parameters
    ----------
    column : Column
        Each of those under the cap beam.
    rotation : array_like
        θ, rad; u and v have its shape.

    Raises
    ------
    ValueError
        For rotations that are no numbers.

    Examples
    --------
    >>> u, v = th.cap_displacement(th.Column(0.5, 3.0), 0.05)
    >>> round(float(u), 4), round(float(v), 4)
    (0.3011, 0.0425)
    """
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
    theta = checks.numbers("rotation", rotation)
    return np.where(theta < 0.0, -1.0, 1.0), column.slenderness - np.abs(theta)


def turned_with_column(
    column: Column, rotation: float, corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the positions (m), shape (n, 2), of points fixed to a column that rocked by θ.

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


def outlines(
    structure: Structure, rotation: float, cap_width: float, cap_depth: float
) -> dict[str, NDArray[np.float64]]:
    """Return the corners of the bodies of a structure that has rocked by θ, by their names.

    Parameters
    ----------
    structure : Column, FixedMassColumn, RockingFrame or MonolithicPortal
    rotation : float
        θ, rad.
    cap_width, cap_depth : float
        As the cap is drawn, m: its mass does not follow from them. The outer faces of a frame's
        columns are under its ends; a portal has its own span.

    Returns
    -------
    dict of ndarray, shape (5, 2)
        m, closed. The origin is on the ground, in the middle of the structure at rest.

    Raises
    ------
    ValueError
        For another structure, which has no bodies.
    """
    if isinstance(structure, Column):
        return {"column": column_outline(structure, rotation)}
    if not isinstance(structure, FixedMassColumn | MonolithicPortal | RockingFrame):
        raise ValueError(
            f"structure is {short(structure)}; expected a Column, FixedMassColumn, RockingFrame or "
            "MonolithicPortal, which have bodies"
        )
    column, top = structure.column, 2.0 * structure.column.half_height
    beam = _rectangle(cap_width, top, cap_depth)
    if isinstance(structure, FixedMassColumn):
        return {
            "column": column_outline(column, rotation),
            "cap": turned_with_column(column, rotation, beam),
        }
    if isinstance(structure, MonolithicPortal):
        whole = Column(structure.half_base, 1.0)  # whose base is that of the portal
        upright, axis = column_outline(column, 0.0), np.array([structure.span / 2.0, 0.0])
        parts = {"left column": upright - axis, "right column": upright + axis, "cap": beam}
        return {name: turned_with_column(whole, rotation, part) for name, part in parts.items()}
    axis = np.array([cap_width / 2.0 - column.half_width, 0.0])
    outline = column_outline(column, rotation)
    return {
        "left column": outline - axis,
        "right column": outline + axis,
        "cap": beam + np.array(cap_displacement(column, rotation)),
    }


def _rectangle(width: float, low: float, depth: float) -> NDArray[np.float64]:
    """Return the corners of a rectangle over the origin, shape (5, 2), m, closed."""
    side, high = width / 2.0, low + depth
    return np.array([[-side, low], [side, low], [side, high], [-side, high], [-side, low]])
