"""Base shear, overturning and bending moments of a rocking frame, and of one that is clamped.

The loads of a column are the forces at its two contacts, half its width beside its axis, and its
own weight and inertia. With the transverse and axial force t and n of the ground on the column, and
the position c = b sgn θ of the contact, the bending moment at the height z along the axis is

    M(z) = c n + t z − ∫₀ᶻ q(y) (z − y) dy + (m_c/2h) (b²/3) θ̈ z,   q = (m_c/2h) a_t,

where a_t is the transverse acceleration on the axis, gravity included, and the last term is the
rotary inertia. Base shear and moments are positive for a frame at rest under ü_g > 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.bodies.structures import STANDARD_GRAVITY, RockingFrame, weights
from topheavy.forces.contacts import Array, Cap, checked_frame, forces_in, motion_state
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import SHAPES, WAVES

SECTIONS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Heights, normalised by 2h, at which the bending moments are computed."""


class FrameForces(NamedTuple):
    """Forces of a rocking frame normalised by its weight (moments in m), over its motion.

    The base shear is that of the ground on both columns; the overturning moment is about the point
    midway between the resting columns; the bending moment, of shape (2, ..., sections), is in the
    left and the right column at the heights SECTIONS.
    """

    base_shear: Array
    overturning_moment: Array
    bending_moment: Array


def frame_forces(
    frame: RockingFrame,
    cap: Cap,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike,
) -> FrameForces:
    """Return the forces of a frame whose motion is that of Eq. (23).

    The parameters are those of `forces_at`. At rest, base shear and overturning moment follow
    from the ground's acceleration; the bending moments are NaN, since whole faces are in contact.
    """
    checked_frame(frame, cap)
    motion = motion_state(frame, rotation, velocity, ground_acceleration)
    contacts = forces_in(frame, cap, motion)
    rests, half_height = np.isnan(motion.side), frame.column.half_height
    corner = motion.side * frame.column.half_width
    horizontal, vertical = contacts.horizontal[:2], contacts.vertical[:2]
    shear = np.where(rests, motion.ground, horizontal.sum(axis=0))
    left, right = (corner + end * cap.span for end in (-0.5, 0.5))
    moment = -(left * vertical[0] + right * vertical[1])
    moment = np.where(rests, motion.ground * centre_height(frame, cap), moment)

    sin, cos = np.sin(motion.rotation), np.cos(motion.rotation)
    push = motion.side * motion.sine + motion.ground * motion.cosine
    turn = -(frame.frequency_parameter**2) * push / STANDARD_GRAVITY  # Eq. (23)
    load = weights(frame.mass_ratio)[0] / (2.0 * half_height)
    steady = motion.ground * cos - sin + corner * motion.velocity**2 / STANDARD_GRAVITY
    y = 2.0 * half_height * np.array(SECTIONS)
    rotary = turn * frame.column.half_width**2 / 3.0
    span_loads = y * (rotary[..., None] - y * (steady[..., None] / 2.0 + y * turn[..., None] / 6.0))
    base = corner * (horizontal * sin + vertical * cos)
    slope = horizontal * cos - vertical * sin
    bending = base[..., None] + slope[..., None] * y + load * span_loads
    return FrameForces(shear, moment, bending)


def largest_forces(
    frame: RockingFrame, cap: Cap, rotation: Array, velocity: Array, ground_acceleration: Array
) -> NDArray[np.float64]:
    """Return the largest absolute forces of `frame_forces` over all arcs of motion.

    The motion has the shape (arcs, samples). Arcs at rest are left out, since the forces of a
    resting frame are largest at uplift, where the next arc begins; if no arc moves, all count.

    Returns
    -------
    ndarray, shape (2, 3)
        Of all samples, and of every other one: base shear, overturning moment, bending moment.
    """
    moves = rotation.any(axis=1)
    moves = moves if moves.any() else ~moves
    arcs = (x[moves] for x in (rotation, velocity, ground_acceleration))
    forces = frame_forces(frame, cap, *arcs)
    bending = np.abs(forces.bending_moment).max(axis=(0, -1))
    sizes = np.stack([np.abs(forces.base_shear), np.abs(forces.overturning_moment), bending])
    sizes = np.nan_to_num(sizes)
    return np.stack([sizes.max(axis=(1, 2)), sizes[:, :, ::2].max(axis=(1, 2))])


def clamped_forces(frame: RockingFrame, cap: Cap, excitation: Pulse | Record) -> Array:
    """Return the largest forces of the same rigid frame if it is clamped against uplift.

    Its columns are fixed to the ground and pinned to the cap beam: each is a cantilever under its
    own inertia and half that of the cap beam at its top. Everything moves with the ground.

    Returns
    -------
    ndarray, shape (3,)
        Base shear, overturning moment and bending moment, normalised as in `FrameForces`.
    """
    checked_excitation(excitation, ends=True)
    peak = excitation.peak_acceleration
    if isinstance(excitation, Pulse):  # where its wave turns or begins
        phases = np.array([0.0, *WAVES[SHAPES[excitation.shape].wave].turns])
        waves = excitation.accelerations(phases / excitation.angular_frequency)
        peak = float(np.abs(waves).max())
    column, beam = weights(frame.mass_ratio)
    bending = (beam + column) * frame.column.half_height
    return np.array([1.0, centre_height(frame, cap), bending]) * peak


def base_shear_slope(frame: RockingFrame) -> float:
    """Return d(V/W)/d(ü_g/g), the growth of the base shear over the weight just after uplift.

    1 − (3/4) cos²α (1 + 2γ)²/((1 + γ)(1 + 3γ)); sin²α for γ → ∞. It is 1 before uplift.
    """
    gamma = frame.mass_ratio
    ratio = 4.0 / 3.0
    if gamma != math.inf:
        ratio = (1.0 + 2.0 * gamma) ** 2 / ((1.0 + gamma) * (1.0 + 3.0 * gamma))
    return 1.0 - 0.75 * math.cos(frame.slenderness) ** 2 * ratio


def centre_height(frame: RockingFrame, cap: Cap) -> float:
    """Return the height of the centre of gravity of the resting frame, m."""
    column, beam = weights(frame.mass_ratio)
    h = frame.column.half_height
    return 2.0 * column * h + beam * (2.0 * h + cap.half_depth)
