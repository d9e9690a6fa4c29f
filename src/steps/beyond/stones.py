"""Columns under one beam, or under one stone per bay, in pymunk, a rigid-body engine in the plane.

The engine knows bodies, contact without rebound, and friction. Its contacts are its defaults: they
have no stiffness and no damping. It has no rocking-specific equations: no common rotation, no
pivots, no p̂, no √r. The ground is fixed; gravity becomes (−ü_g, −g).
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pymunk

from steps.beyond.inclinations import WAIT, overturn
from topheavy import STANDARD_GRAVITY, Cap, Column, Pulse

ITERATIONS = 50  # iterations of contact forces in a time step; pymunk's default is 10
LOOK = 50  # time steps between looks
GROUND = 1e3  # half the length of the ground, m
BEAM, OPEN, HINGED = "one beam", "open joints", "hinged joints"
VERSION = f"pymunk {pymunk.version}"


@dataclass(frozen=True)
class Stones:
    """One column alone, or equal columns under a free beam or under free stones.

    Parameters
    ----------
    column : Column
    mass_ratio : float
        γ, the mass of the beam or of all stones over that of all columns; 0 is one column alone.
    cap : Cap
        A beam, or the outer stones, end at the outer faces of the columns.
    time_step : float
        s.
    columns : int
        N, a span apart.
    joints : str
        `BEAM`, or one stone per bay that ends on the axes of the inner columns: with `OPEN` joints,
        or with a hinge there (`HINGED`), which takes shear.
    gap : float
        Width of an open or hinged joint, m.
    friction : float
        Coefficient μ of all contacts.
    """

    column: Column
    mass_ratio: float
    cap: Cap
    time_step: float
    columns: int = 2
    joints: str = BEAM
    gap: float = 0.0
    friction: float = 5.0

    def space(self, rotation: float = 0.0) -> tuple[pymunk.Space, list[pymunk.Body]]:
        """Return the engine's space and its columns; with one beam they may be rotated by θ."""
        b, h, d = self.column.half_width, self.column.half_height, self.cap.half_depth
        space, count = pymunk.Space(), self.columns if self.mass_ratio else 1
        space.iterations = ITERATIONS
        ground = pymunk.Segment(space.static_body, (-GROUND, 0.0), (GROUND, 0.0), 0.0)
        ground.friction = self.friction
        space.add(ground)

        def box(x: float, z: float, sides: tuple[float, float], mass: float) -> pymunk.Body:
            body = pymunk.Body(mass, pymunk.moment_for_box(mass, sides))
            shape = pymunk.Poly.create_box(body, sides)
            shape.friction, body.position = self.friction, (x, z)
            space.add(body, shape)
            return body

        sine, cosine = math.sin(abs(rotation)), math.cos(rotation)
        shift, rise = math.copysign(h * sine + b * (1.0 - cosine), rotation), h * cosine + b * sine
        axes = self.cap.span * np.arange(count)
        columns = [box(axis + shift, rise, (2.0 * b, 2.0 * h), 1.0) for axis in axes.tolist()]
        for body in columns:
            body.angle = -rotation
        if self.mass_ratio == 0.0:
            return space, columns
        inner = axes[1:-1].tolist() if self.joints != BEAM else []
        starts = [axes[0] - b, *(axis + 0.5 * self.gap for axis in inner)]
        ends = [*(axis - 0.5 * self.gap for axis in inner), axes[-1] + b]
        mass, level = self.mass_ratio * count / len(ends), 2.0 * rise + d
        stones = [
            box(0.5 * (start + end) + 2.0 * shift, level, (end - start, 2.0 * d), mass)
            for start, end in zip(starts, ends, strict=True)
        ]
        if self.joints == HINGED:
            for (left, right), axis in zip(pairwise(stones), inner, strict=True):
                space.add(pymunk.PivotJoint(left, right, (axis, 2.0 * h)))
        return space, columns


def motion(
    stones: Stones, ground: Callable, duration: float, rotation: float = 0.0, look: int = LOOK
) -> Iterator[tuple[float, np.ndarray]]:
    """Yield times (s) and the columns' rotations θ (rad) while the ground accelerates.

    The ground's acceleration (g) is a function of times (s). Bodies start from rest, columns under
    one beam rotated by θ. Rotations are those after every `look`-th time step.
    """
    space, columns = stones.space(rotation)
    times = (np.arange(math.ceil(duration / stones.time_step)) + 0.5) * stones.time_step
    pushes = (-STANDARD_GRAVITY * ground(times)).tolist()
    for count, push in enumerate(pushes, 1):
        space.gravity = push, -STANDARD_GRAVITY
        space.step(stones.time_step)
        if count % look == 0:
            yield count * stones.time_step, -np.array([body.angle for body in columns])


def overturns(stones: Stones, pulse: Pulse) -> bool:
    """Return whether a pulse overturns a column."""
    duration = pulse.duration + WAIT / stones.column.frequency_parameter
    inclined = ((t, float(abs(x).max())) for t, x in motion(stones, pulse.excitation, duration))
    return overturn(inclined, stones.column, pulse)


def released(stones: Stones, rotation: float, duration: float) -> np.ndarray:
    """Return θ (rad) of the left column in each time step after a release from rest at θ."""
    looks = motion(stones, np.zeros_like, duration, rotation, look=1)
    return np.array([rotation, *(rotations[0] for _, rotations in looks)])
