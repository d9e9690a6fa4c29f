"""Base shear, overturning moment and bending moments of a rocking frame.

They follow from the contact forces of `topheavy.contact_forces`. A column is loaded by the forces
at its two contacts, half its width beside its axis, and by its own weight and inertia. With t and n
for the transverse and axial force of the ground on the column, and c = b sgn θ for the place of the
contact, the bending moment at the height z along the axis is

    M(z) = c n + t z − ∫₀ᶻ q(y) (z − y) dy + (m_c/2h) (b²/3) θ̈ z,   q = (m_c/2h) a_t,

where a_t is the transverse acceleration on the axis, gravity included, and the last term is the
rotary inertia. Signs are such that all three are positive for a frame at rest under ü_g > 0.
The impulses of an impact are no forces and are not among these; see `impact_impulses`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.contact_forces import Cap, Reaction, contact_forces
from topheavy.structures import STANDARD_GRAVITY, RockingFrame

Array = NDArray[np.float64]

SECTIONS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Heights over 2h at which the bending moments are computed."""


@dataclass(frozen=True, eq=False)
class FrameForces:
    """Forces of a rocking frame over its weight, each of the shape of the motion.

    Attributes
    ----------
    base_shear : ndarray
        Horizontal force of the ground on both columns, over the weight.
    overturning_moment : ndarray
        Of the ground's reactions about the point of the ground midway between the resting columns,
        over the weight, m.
    bending_moment : ndarray, shape (..., 2, sections)
        In the left and the right column at the heights SECTIONS, over the weight, m.
    """

    base_shear: Array
    overturning_moment: Array
    bending_moment: Array


def frame_forces(
    frame: RockingFrame,
    cap: Cap,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike = 0.0,
) -> FrameForces:
    """Return the forces of a frame whose motion is that of Eq. (23).

    Parameters are those of `contact_forces`. At rest, base shear and overturning moment are those
    of the ground's acceleration; the bending moments are NaN, since whole faces are in contact.
    """
    forces = contact_forces(frame, cap, rotation, velocity, ground_acceleration)
    theta, rate, ground = np.broadcast_arrays(
        *(np.asarray(given, dtype=float) for given in (rotation, velocity, ground_acceleration))
    )
    left, right = forces.base_left, forces.base_right
    rests = (theta == 0.0) & (rate == 0.0) & np.isnan(left.vertical)
    side = _side(theta, rate, ground)
    pivot = side * frame.column.half_width
    moment = -sum(
        (pivot + end * cap.span / 2.0) * foot.vertical for end, foot in ((-1, left), (1, right))
    )
    return FrameForces(
        np.where(rests, ground, left.horizontal + right.horizontal),
        np.where(rests, ground * centre_height(frame, cap), moment),
        _bending(frame, side, theta, rate, ground, (left, right)),
    )


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
    columns = 0.0 if frame.mass_ratio == math.inf else 1.0 / (1.0 + frame.mass_ratio)
    h = frame.column.half_height
    return columns * h + (1.0 - columns) * (2.0 * h + cap.half_depth)


def _side(theta: Array, rate: Array, ground: Array) -> Array:
    """Return sgn θ, or at θ = 0 the side that the frame turns to."""
    return np.sign(np.where(theta != 0.0, theta, np.where(rate != 0.0, rate, -ground)))


def _bending(
    frame: RockingFrame,
    side: Array,
    theta: Array,
    rate: Array,
    ground: Array,
    feet: tuple[Reaction, ...],
) -> Array:
    """Return the bending moments of the columns at the SECTIONS over the weight of the frame, m."""
    column, lean = frame.column, frame.slenderness - np.abs(theta)
    weight = 0.0 if frame.mass_ratio == math.inf else 0.5 / (1.0 + frame.mass_ratio)
    squared = frame.frequency_parameter**2
    angular = -squared * (side * np.sin(lean) + ground * np.cos(lean))  # Eq. (23)
    sin, cos, b = np.sin(theta), np.cos(theta), column.half_width
    spread = weight / (2.0 * column.half_height * STANDARD_GRAVITY)
    steady = STANDARD_GRAVITY * (ground * cos - sin) + side * b * rate**2
    # A polynomial of the third degree in the height z above the base, for each column.
    terms = np.empty((4, len(feet), *theta.shape))
    for of_column, foot in zip(np.moveaxis(terms, 1, 0), feet, strict=True):
        of_column[0] = side * b * (foot.horizontal * sin + foot.vertical * cos)
        of_column[1] = foot.horizontal * cos - foot.vertical * sin + spread * angular * b**2 / 3.0
    terms[2], terms[3] = -spread * steady / 2.0, -spread * angular / 6.0
    powers = np.vander(2.0 * column.half_height * np.array(SECTIONS), 4, increasing=True)
    found: Array = np.moveaxis(np.tensordot(powers, terms, 1), [1, 0], [-2, -1])
    return found
