"""The rocking frame as three rigid bodies with contact points, by Newton's and Euler's equations.

Two columns and the cap beam have nine coordinates. Each column turns about a corner of its base
and carries the cap beam on the corner diagonally across; nothing slides (p. 2). At every instant
the balance of the bodies and the four contacts, differentiated twice, give the nine accelerations
and the eight contact forces F; at an impact the same system gives the velocities behind it and the
impulses Λ:

    ⎡M  Jᵀ⎤ ⎡ q̈⎤   ⎡ loads ⎤        ⎡M  Jᵀ⎤ ⎡ q̇₂⎤   ⎡M q̇₁⎤
    ⎣J  0 ⎦ ⎣−F⎦ = ⎣−J̇ q̇  ⎦        ⎣J  0 ⎦ ⎣−Λ ⎦ = ⎣  0  ⎦

Nine coordinates with eight scalar constraints have one degree of freedom. The module does not use
Eq. (23), the uplift at tan α or Eq. (25): these are results.

Coordinates q (m, rad) are displacements (x to the right, z upward) and clockwise rotations of
column 1 (the left one), column 2 and the cap beam, from rest and relative to the ground. A column
weighs 1 kg. Contacts are ordered: ground under column 1, ground under column 2, column 1 under the
cap beam, column 2 under the cap beam.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from numpy.typing import NDArray

from topheavy.bodies.structures import STANDARD_GRAVITY, RockingFrame
from topheavy.forces.contacts import Cap, checked_frame

Vector = NDArray[np.float64]
Sides = tuple[int, int]
"""For each column, the side of the base corner in contact: −1 left, +1 right."""

COLUMNS = [2, 5]
"""Indices in q of the rotations of the two columns."""

# Six points of the bodies meet in four contacts: a base corner of each column with the ground, and
# under the cap beam a point of it (taken positive) with a top corner of each column (negative).
_BODY = np.array([0, 1, 2, 2, 0, 1])
_CONTACT = np.array([0, 1, 2, 3, 2, 3])
_COLUMN = np.array([0, 1, 0, 1, 0, 1])
_SIGN = np.array([1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
_ROWS, _TURNS = 9 + 2 * _CONTACT, 3 * _BODY + 2


@dataclass(frozen=True)
class ThreeBodies:
    """A rocking frame of finite γ, and its cap beam with dimensions.

    The cap beam is a homogeneous rectangle that ends flush with the columns.
    """

    frame: RockingFrame
    cap: Cap

    def __post_init__(self) -> None:
        checked_frame(self.frame, self.cap)
        if self.frame.mass_ratio == math.inf:
            raise ValueError("mass_ratio is ∞; expected a finite one, as a column weighs 1 kg here")

    @cached_property
    def mass(self) -> Vector:
        """Mass (kg), mass and central moment of inertia (kg m²) of each body, shape (9,)."""
        cap, inertia = 2.0 * self.frame.mass_ratio, self.frame.column.size**2 / 3.0
        length, depth = (
            self.cap.span + 2.0 * self.frame.column.half_width,
            2.0 * self.cap.half_depth,
        )
        cap_inertia = cap * (length**2 + depth**2) / 12.0
        return np.array([1.0, 1.0, inertia, 1.0, 1.0, inertia, cap, cap, cap_inertia])

    @cached_property
    def _unturned(self) -> Vector:
        """The system's matrix without the columns of J that belong to the rotations."""
        matrix = np.zeros((17, 17))
        matrix[range(9), range(9)] = self.mass
        for axis in (0, 1):
            matrix[_ROWS + axis, 3 * _BODY + axis] = _SIGN
            matrix[3 * _BODY + axis, _ROWS + axis] = _SIGN
        return matrix

    def arms(self, sides: Sides) -> tuple[Vector, Vector]:
        """Return x and z (m) of the six points from the centres of their upright bodies."""
        b, h = self.frame.column.half_width, self.frame.column.half_height
        x, z = self.cap.span / 2.0, self.cap.half_depth
        corner = np.array([b, b, -b, -b, -b, -b]) * np.array(sides)[_COLUMN]
        return np.array([0.0, 0.0, -x, x, 0.0, 0.0]) + corner, np.array([-h, -h, -z, -z, h, h])

    def turned_arms(self, sides: Sides, coordinates: Vector) -> tuple[Vector, Vector]:
        """Return x and z (m) of the six points from the centres of their bodies."""
        x, z = self.arms(sides)
        angle = coordinates[_TURNS]
        cos, sin = np.cos(angle), np.sin(angle)
        return x * cos + z * sin, z * cos - x * sin

    def matrix(self, turned: tuple[Vector, Vector]) -> Vector:
        """Return the matrix of the system for the arms of the six points, shape (17, 17)."""
        matrix = self._unturned.copy()
        for axis, column in enumerate((_SIGN * turned[1], -_SIGN * turned[0])):
            matrix[_ROWS + axis, _TURNS] = column
            matrix[_TURNS, _ROWS + axis] = column
        return matrix


def accelerations(
    bodies: ThreeBodies,
    sides: Sides,
    coordinates: Vector,
    velocity: Vector,
    ground: float,
) -> tuple[Vector, Vector]:
    """Return q̈, shape (9,), and the contact forces, shape (4, 2), of q and q̇ under ü_g (g).

    Forces (N) act on the upper body of each contact, to the right and upward.
    """
    turned = bodies.turned_arms(sides, coordinates)
    load = np.zeros(17)
    load[0:9:3] = -STANDARD_GRAVITY * ground * bodies.mass[0::3]
    load[1:9:3] = -STANDARD_GRAVITY * bodies.mass[1::3]
    square = _SIGN * velocity[_TURNS] ** 2
    for axis in (0, 1):
        pull = square * turned[axis]
        load[9 + axis :: 2] = pull[:4]
        load[13 + axis :: 2] += pull[4:]
    return _solve(bodies.matrix(turned), load)


def impact(bodies: ThreeBodies, sides: Sides, velocity: Vector) -> tuple[Vector, Vector]:
    """Return q̇ behind an impact of the upright frame, shape (9,), and the impulses, shape (4, 2).

    Impulses (N s, on the upper body) act at the new corners, `sides`; the old contacts open.
    """
    momentum = np.concatenate([bodies.mass * velocity, np.zeros(8)])
    return _solve(bodies.matrix(bodies.arms(sides)), momentum)


def _solve(matrix: Vector, right: Vector) -> tuple[Vector, Vector]:
    """Return the accelerations and forces, or the velocities and impulses."""
    solved = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    return solved[:9], -np.reshape(solved[9:], (4, 2))


def uplift_accelerations(bodies: ThreeBodies) -> dict[Sides, float]:
    """Return for each choice of corners the ground acceleration (g, signed) that lifts the others.

    Choices that no ground acceleration opens, as columns that lean against each other, are left
    out. The accelerations of the frame at rest are linear in ü_g, which two solutions determine.
    """
    levels: dict[Sides, float] = {}
    for sides in product((-1, 1), (-1, 1)):
        quiet, pushed = (opening(bodies, sides, ground) for ground in (0.0, 1.0))
        slope = pushed - quiet
        if np.all(slope > 0.0) or np.all(slope < 0.0):
            needed = -quiet / slope
            levels[sides] = float(needed[np.argmax(np.abs(needed))])
    return levels


def opening(bodies: ThreeBodies, sides: Sides, ground: float) -> Vector:
    """Return the angular accelerations (rad/s²) at which the other corners lift off at rest."""
    angular, _ = accelerations(bodies, sides, np.zeros(9), np.zeros(9), ground)
    return np.asarray(angular[COLUMNS] * np.array(sides))
