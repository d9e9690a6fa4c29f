"""Outlines of column, fixed mass and frame as they rock, to scale."""

import math

import numpy as np

from topheavy import Column, FixedMassColumn, RockingFrame
from topheavy.bodies.kinematics import outlines
from topheavy.bodies.structures import Structure

IN_THE_GROUND = 1e-9  # largest depth of a body below the ground, m


def structures(column: Column, gamma: float, cap: dict[str, float]) -> dict[str, Structure]:
    """Return a column, the same with a mass fixed to its top, and a frame of the same γ."""
    fixed = FixedMassColumn(column, gamma, cap["width"], cap["depth"])
    return {"column": column, "fixed mass": fixed, "frame": RockingFrame(column, gamma)}


def bodies(structure: Structure, rotation: float, cap: dict[str, float]) -> dict[str, np.ndarray]:
    """Return the outlines (m) of the bodies of a structure that has rocked by θ.

    The cap beam of a frame is twice as wide as a mass that is fixed to one column.
    """
    width = cap["width"] * (2.0 if isinstance(structure, RockingFrame) else 1.0)
    shapes = outlines(structure, rotation, width, cap["depth"])
    for name, outline in shapes.items():
        if outline[:, 1].min() < -IN_THE_GROUND:
            raise ArithmeticError(
                f"the {name} of {structure} is in the ground at θ = {rotation:.6g}"
            )
    return shapes


def lying(structure: Column | FixedMassColumn, cap: dict[str, float]) -> float:
    """Return the rotation (rad) at which a corner of an overturning body meets the ground."""
    corners = np.concatenate([*bodies(structure, 0.0, cap).values()])
    raised = corners[corners[:, 1] > 0.0]
    column = structure if isinstance(structure, Column) else structure.column
    reached = np.arctan2(raised[:, 0] - column.half_width, raised[:, 1])
    return float(np.min(math.pi / 2.0 - reached))
