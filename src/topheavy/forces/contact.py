"""Forces and impulses at the base and column-top contacts of a rocking frame.

The paper assumes that nothing slides and that the cap beam stays on both columns (p. 3). This
module computes the forces that the assumption requires. There are nine unknowns: θ̈ and four forces
of two components each. Eqs. (10)–(18) balance the columns and the forces on the cap beam, which
leaves one unknown. The moment balance of the cap beam, which the paper omits, determines it:

- Both columns rotate equally, so both exert the same force on the cap beam across their diagonals.
- The other equations divide the force (F_x, F_z) on the cap beam between the columns. The left
  column-top contact carries F_z (1/2 − e/L), the right one F_z (1/2 + e/L), e = s b − d F_x/F_z.
  Here s = sgn θ, L is the span and d the half-depth. The line of thrust through the cap beam's
  centre of gravity meets the level of the contacts at e, to the right of the middle between them.
  A contact opens if that line leaves the span.

The impulses at an impact obey the same equations. Rotations are in rad, signed; the ground
acceleration is in g. Arrays broadcast.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import STANDARD_GRAVITY, Column, RockingFrame

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Cap:
    """Span and depth of the cap beam, on which the forces depend but not the motion.

    Parameters
    ----------
    span : float
        L, m, between the axes of the columns.
    half_depth : float
        d, m: the height of the cap beam's centre of gravity above the column-top contacts.

    Raises
    ------
    ValueError
        Unless both are positive and finite.

    Examples
    --------
    >>> th.Cap(span=5.0, half_depth=0.4)
    Cap(span=5.0, half_depth=0.4)
    """

    span: float
    half_depth: float

    def __post_init__(self) -> None:
        checks.positive("span", self.span, "m")
        checks.positive("half_depth", self.half_depth, "m")


@dataclass(frozen=True, eq=False)
class Reaction:
    """The force, or at an impact the impulse, of one contact on the body above it.

    Attributes
    ----------
    horizontal : ndarray
        To the right.
    vertical : ndarray
        Upward. If it is negative, the contact would have to pull; it opens instead.

    Examples
    --------
    >>> th.column_forces(th.Column(0.5, 3.0), 0.0, 0.0, 0.05).horizontal.item()
    0.05
    """

    horizontal: Array
    vertical: Array

    @property
    def friction_demand(self) -> Array:
        """|horizontal|/vertical: the required coefficient of friction.

        Infinite where there is no compression, NaN where the contact carries nothing at all.
        """
        tangential = np.abs(self.horizontal)
        demand: Array = np.full(tangential.shape, np.inf)
        np.divide(tangential, self.vertical, out=demand, where=self.vertical > 0.0)
        idle = (tangential == 0.0) & (self.vertical == 0.0)
        return np.where(idle | np.isnan(self.vertical), np.nan, demand)


@dataclass(frozen=True, eq=False)
class ContactForces:
    """The reactions at the four contacts of a rocking frame, each of the shape of the motion.

    Attributes
    ----------
    base_left, base_right : Reaction
        Of the ground on the left and the right column.
    seat_left, seat_right : Reaction
        Of the left and the right column on the cap.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> forces = th.contact_forces(frame, th.Cap(span=5.0, half_depth=0.4), 0.05, 0.0)
    >>> round(forces.seat_right.vertical.item(), 3)
    0.401
    """

    base_left: Reaction
    base_right: Reaction
    seat_left: Reaction
    seat_right: Reaction

    @property
    def contacts(self) -> tuple[Reaction, Reaction, Reaction, Reaction]:
        """The four, in the order above."""
        return self.base_left, self.base_right, self.seat_left, self.seat_right

    @property
    def friction_demand(self) -> Array:
        """The largest required coefficient of friction of the four contacts."""
        largest: Array = reduce(np.fmax, [contact.friction_demand for contact in self.contacts])
        return largest

    @property
    def least_vertical(self) -> Array:
        """The least vertical reaction of the four; none opens as long as it is positive."""
        least: Array = reduce(np.minimum, [contact.vertical for contact in self.contacts])
        return least


def contact_forces(
    frame: RockingFrame,
    cap: Cap,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike = 0.0,
) -> ContactForces:
    """Return the forces on a rocking frame, over its weight (2 m_c + m_b) g.

    The motion is that of Eq. (23). The forces are not limited where a contact cannot provide them:
    a tension or a very large required friction shows that the assumed motion is impossible.

    Parameters
    ----------
    frame, cap
        γ may be 0 (no force under the cap beam) or infinite (columns without weight).
    rotation, velocity, ground_acceleration : array_like
        θ (rad, |θ| < π/2), θ̇ (rad/s) and ü_g (g).

    Returns
    -------
    ContactForces
        At θ = 0 the frame turns to the side of its velocity. Without one, it turns to the side
        that ü_g uplifts it to, for |ü_g| ≥ tan α. Below, at rest, the forces are NaN: base and
        top faces are in full contact, and nine equations do not determine the twelve resultants.

    Raises
    ------
    ValueError
        For a rotation of π/2 or more, or a span that is not more than the columns' width 2b.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> forces = th.contact_forces(frame, th.Cap(span=5.0, half_depth=0.4), 0.05, 0.0)
    >>> round(forces.base_left.vertical.item(), 3)
    0.422
    """
    check_span(frame, cap)
    at = motion_state(frame.column, rotation, velocity, ground_acceleration)
    size, p_hat = frame.column.size, frame.frequency_parameter
    each, beam = weights(frame.mass_ratio)
    on_column = _load(at, size, p_hat)  # Eqs. (10), (11)
    on_cap = _load(at, 2.0 * size, p_hat)  # Eqs. (12), (13)
    return _shared(frame, cap, at.side, at.lean, on_column.times(each), on_cap.times(beam))


def column_forces(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike = 0.0
) -> Reaction:
    """Return the force of the ground on a solitary rocking column, over its weight m g.

    Parameters, and the side that it turns to from θ = 0, are as in `contact_forces`. At rest the
    force is determinate: the ground's acceleration times the mass, and the weight.

    Raises
    ------
    ValueError
        For a rotation of π/2 or more.

    Examples
    --------
    >>> th.column_forces(th.Column(0.5, 3.0), 0.0, 0.0, 0.05).vertical.item()
    1.0
    """
    at = motion_state(column, rotation, velocity, ground_acceleration)
    rocking = _load(at, column.size, column.frequency_parameter)
    rests = (at.rotation == 0.0) & (at.velocity == 0.0) & np.isnan(at.side)
    return Reaction(
        np.where(rests, at.ground, rocking.horizontal), np.where(rests, 1.0, rocking.vertical)
    )


def impact_impulses(frame: RockingFrame, cap: Cap, velocity: ArrayLike) -> ContactForces:
    """Return the impulses on a rocking frame at an impact, over its mass 2 m_c + m_b, in m/s.

    They act at the new pivots and the new column-top contacts, which leads to √r of Eq. (25). With
    another √r the old contacts would also act, and the impulses would not be determined.

    Parameters
    ----------
    frame, cap
        As in `contact_forces`.
    velocity : array_like
        θ̇ before the impact, rad/s; the frame changes over to the side of its sign.

    Raises
    ------
    ValueError
        When √r of Eq. (25) is negative, or the span is not more than the columns' width 2b.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> impulses = th.impact_impulses(frame, th.Cap(span=5.0, half_depth=0.4), 0.5)
    >>> round(impulses.base_left.vertical.item(), 3)
    0.333
    """
    check_span(frame, cap)
    column, restitution = frame.column, frame.block().restitution
    each, beam = weights(frame.mass_ratio)
    centre = _jump(column, restitution, column.size, velocity)
    ends = _jump(column, restitution, 2.0 * column.size, velocity)
    side = np.sign(np.asarray(velocity, dtype=float))
    lean = np.full(side.shape, column.slenderness)
    return _shared(frame, cap, side, lean, centre.times(each), ends.times(beam))


def column_impulse(column: Column, velocity: ArrayLike) -> Reaction:
    """Return the impulse of the ground on a solitary column at an impact, over its mass, in m/s.

    velocity is θ̇ before the impact, rad/s; √r is Housner's.

    Raises
    ------
    ValueError
        When Housner's √r is negative.

    Examples
    --------
    >>> round(th.column_impulse(th.Column(0.5, 3.0), 0.5).vertical.item(), 3)
    0.49
    """
    jump = _jump(column, column.block().restitution, column.size, velocity)
    return Reaction(jump.horizontal, jump.vertical)


class _Pair(NamedTuple):
    """A horizontal and a vertical component, to the right and upward."""

    horizontal: Array
    vertical: Array

    def times(self, factor: float) -> _Pair:
        return _Pair(factor * self.horizontal, factor * self.vertical)


class _State(NamedTuple):
    """θ, θ̇, ü_g (g), the side s (NaN at rest), the lean α − |θ|, its sine and cosine."""

    rotation: Array
    velocity: Array
    ground: Array
    side: Array
    lean: Array
    sine: Array
    cosine: Array


def checked_motion(
    rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike
) -> tuple[Array, Array, Array]:
    """Return θ, θ̇ and ü_g as arrays of one shape, or raise ValueError for θ of π/2 or more."""
    theta, rate, ground = np.broadcast_arrays(
        checks.numbers("rotation", rotation),
        checks.numbers("velocity", velocity),
        checks.numbers("ground_acceleration", ground_acceleration),
    )
    if np.any(np.abs(theta) >= math.pi / 2):
        worst = float(np.nanmax(np.abs(theta)))
        raise ValueError(f"rotation is up to {worst:.6g} rad; expected less than π/2, lying flat")
    return theta, rate, ground


def motion_state(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike
) -> _State:
    theta, rate, ground = checked_motion(rotation, velocity, ground_acceleration)
    uplifted = np.where(np.abs(ground) >= column.uplift_acceleration, -np.sign(ground), np.nan)
    moving = np.where(rate != 0.0, np.sign(rate), uplifted)
    side = np.where(theta != 0.0, np.sign(theta), moving)
    lean = column.slenderness - np.abs(theta)
    return _State(theta, rate, ground, side, lean, np.sin(lean), np.cos(lean))


def _load(at: _State, distance: float, frequency: float) -> _Pair:
    """Return the force, over its weight, on a body whose centre is this far (m) from the pivot.

    The body moves with the diagonal through the pivot, and rides on the accelerating ground: the
    column's centre at R, the cap at 2R. That its force is (ü_g + ẍ, g + z̈)/g is Newton's law.
    """
    s, sin, cos = at.side, at.sine, at.cosine
    acceleration = -(frequency**2) * (s * sin + at.ground * cos)  # Eq. (23)
    across = distance * acceleration / STANDARD_GRAVITY
    inward = distance * at.velocity**2 / STANDARD_GRAVITY
    return _Pair(
        at.ground + across * cos + inward * s * sin,  # Eq. (6)
        1.0 + across * s * sin - inward * cos,  # Eq. (9), as meant
    )


def _jump(column: Column, restitution: float, distance: float, velocity: ArrayLike) -> _Pair:
    """Return the jump of velocity (m/s) at this distance (m) along the diagonal, at an impact.

    The horizontal velocity drops from θ̇ to √r θ̇ times the height; the vertical one turns from
    falling to rising, as the pivot changes over.
    """
    rate, alpha = checks.numbers("velocity", velocity), column.slenderness
    return _Pair(
        -distance * math.cos(alpha) * (1.0 - restitution) * rate,
        distance * math.sin(alpha) * (1.0 + restitution) * np.abs(rate),
    )


def _shared(
    frame: RockingFrame, cap: Cap, side: Array, lean: Array, column: _Pair, beam: _Pair
) -> ContactForces:
    """Distribute the forces on both columns and the cap over the four contacts.

    The cap beam's moments determine how much vertical force shifts from the left column top to the
    right one. The corresponding horizontal force follows the diagonals.
    """
    b, d = frame.column.half_width, cap.half_depth
    shift = (side * b * beam.vertical - d * beam.horizontal) / cap.span
    aside = -side * np.tan(lean) * shift
    left, right = (
        Reaction(beam.horizontal / 2.0 + end * aside, beam.vertical / 2.0 + end * shift)
        for end in (-1.0, 1.0)
    )
    base_left, base_right = (
        Reaction(seat.horizontal + column.horizontal, seat.vertical + column.vertical)
        for seat in (left, right)
    )
    return ContactForces(base_left, base_right, left, right)


def weights(mass_ratio: float) -> tuple[float, float]:
    """Return the shares of one column and of the cap in the weight of the frame."""
    if mass_ratio == math.inf:
        return 0.0, 1.0
    return 0.5 / (1.0 + mass_ratio), mass_ratio / (1.0 + mass_ratio)


def check_span(frame: RockingFrame, cap: Cap) -> None:
    """Raise ValueError unless the columns are further apart than they are wide."""
    width = 2.0 * frame.column.half_width
    if not cap.span > width:
        raise ValueError(
            f"span is {cap.span:.6g} m between the axes of columns {width:.6g} m wide; "
            "expected more than their width, so that the columns do not touch"
        )
