"""Forces of a rocking frame at an instant, and the largest of a history, over its weight.

They are defined in `topheavy.frame_forces`, and those at the contacts in `topheavy.contact_forces`.
Units are m and s; the ground acceleration is in g.
"""

import math
from typing import NamedTuple

import numpy as np

from topheavy.kernel.compiled import compiled


class Frame(NamedTuple):
    """What the forces depend on, in m and s: `squared` is p̂², `level` tan α.

    `column_share` and `beam_share` are the shares of one column and of the cap beam in the weight.
    """

    size: float
    half_width: float
    half_height: float
    level: float
    squared: float
    column_share: float
    beam_share: float
    span: float
    half_depth: float
    centre: float
    gravity: float


@compiled
def forces_at(frame, theta, rate, ground, heights, bending):
    """Return base shear and overturning moment; write the bending moments at heights over 2h.

    `bending` has the shape (2, sections). At rest, those are NaN.
    """
    if theta == 0.0 and rate == 0.0 and abs(ground) < frame.level:
        bending[:] = math.nan
        return ground, ground * frame.centre
    side = math.copysign(1.0, theta if theta != 0.0 else rate if rate != 0.0 else -ground)
    sin, cos, b = math.sin(theta), math.cos(theta), side * frame.half_width
    across = (frame.half_width * cos - side * frame.half_height * sin) / frame.size  # sin(α − |θ|)
    along = (frame.half_height * cos + side * frame.half_width * sin) / frame.size
    angular = -frame.squared * (side * across + ground * along)  # Eq. (23)
    inward, turning = frame.size * rate**2 / frame.gravity, frame.size * angular / frame.gravity
    x = turning * along + inward * side * across  # of a column's centre, in g: Eq. (6)
    z = turning * side * across - inward * along  # Eq. (9), as meant
    top_x, top_z = frame.beam_share * (ground + 2.0 * x), frame.beam_share * (1.0 + 2.0 * z)
    shift = (b * top_z - frame.half_depth * top_x) / frame.span
    aside = -side * across / along * shift
    load = frame.column_share / (2.0 * frame.half_height)
    rotary = load * angular * frame.half_width**2 / (3.0 * frame.gravity)
    steady = load * (ground * cos - sin + b * rate**2 / frame.gravity)
    shear, moment = 0.0, 0.0
    for column in range(2):
        end = 2.0 * column - 1.0
        horizontal = top_x / 2.0 + end * aside + frame.column_share * (ground + x)
        vertical = top_z / 2.0 + end * shift + frame.column_share * (1.0 + z)
        shear += horizontal
        moment -= (b + end * frame.span / 2.0) * vertical
        base = b * (horizontal * sin + vertical * cos)
        slope = horizontal * cos - vertical * sin + rotary
        for k in range(heights.size):
            y = 2.0 * frame.half_height * heights[k]
            bend = steady / 2.0 + y * load * angular / (6.0 * frame.gravity)
            bending[column, k] = base + y * (slope - y * bend)
    return shear, moment


@compiled
def forces_along(frame, theta, rate, ground, heights, shear, moment, bending):
    """Write the forces at each instant of a motion, shape (n,); `bending` is (n, 2, sections)."""
    for i in range(theta.size):
        shear[i], moment[i] = forces_at(frame, theta[i], rate[i], ground[i], heights, bending[i])


@compiled(_nrt=True)
def largest_along(frame, theta, rate, ground, heights):
    """Return the largest moduli of the three forces in arcs, shape (arcs, samples), that move.

    Where none does, all count. The first row is of all samples, the second of every other one.
    """
    largest, bending = np.zeros((2, 3)), np.empty((2, heights.size))
    rests = not theta.any()
    for arc in range(len(theta)):
        if not (rests or theta[arc].any()):
            continue
        for i in range(theta.shape[1]):
            at = theta[arc, i], rate[arc, i], ground[arc, i]
            shear, moment = forces_at(frame, *at, heights, bending)
            bend = 0.0
            for column in range(2):
                for k in range(heights.size):
                    bend = max(bend, abs(bending[column, k]))
            for force, value in enumerate((abs(shear), abs(moment), bend)):
                for row in range(2 - i % 2):
                    largest[row, force] = max(largest[row, force], value)
    return largest
