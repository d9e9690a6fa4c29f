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
from topheavy.checks import short_repr

Array = NDArray[np.float64]


def cap_displacement(column: Column, rotation: ArrayLike) -> tuple[Array, Array]:
    """Return the displacements u (right) and v (up) of the cap beam, m: Eqs. (4), (7)."""
    side, lean = _side_and_lean(column, rotation)
    alpha, diagonal = column.slenderness, 2.0 * column.size
    u = side * diagonal * (np.sin(alpha) - np.sin(lean))  # Eq. (4)
    v = diagonal * (np.cos(lean) - np.cos(alpha))  # Eq. (7)
    return u, v


def cap_acceleration(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike
) -> tuple[Array, Array]:
    """Return ü and v̈ of the cap beam, m/s², from θ, θ̇ (rad/s) and θ̈ (rad/s²): Eqs. (6), (9)."""
    side, lean = _side_and_lean(column, rotation)
    diagonal = 2.0 * column.size
    square = np.asarray(velocity, dtype=float) ** 2
    angular = np.asarray(acceleration, dtype=float)
    u = diagonal * (side * np.sin(lean) * square + np.cos(lean) * angular)  # Eq. (6)
    v = diagonal * (side * np.sin(lean) * angular - np.cos(lean) * square)  # Eq. (9), as meant
    return u, v


def _side_and_lean(column: Column, rotation: ArrayLike) -> tuple[Array, Array]:
    """Return s (+1 at θ = 0, where the formulas of both sides agree in u and v) and α − |θ|."""
    theta = checks.numbers("rotation", rotation)
    return np.where(theta < 0.0, -1.0, 1.0), column.slenderness - np.abs(theta)


def column_outline(column: Column, rotation: float) -> Array:
    """Return the corners of a column that has rocked by θ (rad), shape (5, 2), m, closed.

    The origin is the middle of the base at rest; the first corner is the lower left one.
    """
    corners = _rectangle(2.0 * column.half_width, 0.0, 2.0 * column.half_height)
    return _turned(column.half_width, rotation, corners)


def outlines(
    structure: Structure, rotation: float, cap_width: float, cap_depth: float
) -> dict[str, Array]:
    """Return the corners of the bodies of a structure that has rocked by θ (rad), by their names.

    Parameters
    ----------
    structure : Column, FixedMassColumn, RockingFrame or MonolithicPortal
    cap_width, cap_depth : float
        Of the cap as it is drawn, m: its mass does not follow from them. The outer faces of a
        frame's columns are under its ends, other columns in equal steps between; a portal has its
        own span.

    Returns
    -------
    dict of ndarray, shape (5, 2)
        m, closed. The origin is on the ground, in the middle of the structure at rest.
    """
    if isinstance(structure, Column):
        return {"column": column_outline(structure, rotation)}
    if not isinstance(structure, FixedMassColumn | MonolithicPortal | RockingFrame):
        raise ValueError(
            f"structure is {short_repr(structure)}; expected a Column, FixedMassColumn, "
            "RockingFrame or MonolithicPortal, which have dimensions"
        )
    column, top = structure.column, 2.0 * structure.column.half_height
    beam = _rectangle(cap_width, top, cap_depth)
    if isinstance(structure, FixedMassColumn):
        return {
            "column": column_outline(column, rotation),
            "cap": _turned(column.half_width, rotation, beam),
        }
    if isinstance(structure, MonolithicPortal):
        upright, axis = column_outline(column, 0.0), np.array([structure.span / 2.0, 0.0])
        parts = {"left column": upright - axis, "right column": upright + axis, "cap": beam}
        return {name: _turned(structure.half_base, rotation, part) for name, part in parts.items()}
    end, outline = cap_width / 2.0 - column.half_width, column_outline(column, rotation)
    inner = [f"column {number}" for number in range(2, structure.columns)]
    names = ["left column", *inner, "right column"]
    axes = np.linspace(-end, end, structure.columns)
    columns = {name: outline + [axis, 0.0] for name, axis in zip(names, axes, strict=True)}
    return columns | {"cap": beam + np.array(cap_displacement(column, rotation))}


def _turned(half_base: float, rotation: float, corners: Array) -> Array:
    """Return the positions (m) of points fixed to a body that rocked by θ about its base's edge."""
    pivot = np.array([np.copysign(half_base, rotation), 0.0])
    cos, sin = np.cos(rotation), np.sin(rotation)
    turn = np.array([[cos, -sin], [sin, cos]])  # clockwise for θ > 0, on row vectors
    turned: Array = (corners - pivot) @ turn + pivot
    return turned


def _rectangle(width: float, low: float, depth: float) -> Array:
    """Return the corners of a rectangle centred above the origin, shape (5, 2), m, closed."""
    side, high = width / 2.0, low + depth
    return np.array([[-side, low], [side, low], [side, high], [-side, high], [-side, low]])
