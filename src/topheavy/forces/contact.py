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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.response import Response
from topheavy.bodies.structures import (
    STANDARD_GRAVITY,
    Column,
    RockingFrame,
    checked_two_columns,
)
from topheavy.checks import short_repr
from topheavy.ground.excitation import Excitation, checked_excitation
from topheavy.ground.records import Record
from topheavy.outcomes.simulate import simulate

if TYPE_CHECKING:
    import xarray

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
        checks.set_fields(
            self,
            span=checks.positive("span", self.span, "m"),
            half_depth=checks.positive("half_depth", self.half_depth, "m"),
        )


@dataclass(frozen=True, eq=False, repr=False)
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
    >>> from topheavy.forces.contact import column_forces
    >>> column_forces(th.Column(0.5, 3.0), 0.0, 0.0, 0.05).horizontal.item()
    0.05
    """

    horizontal: Array
    vertical: Array
    __repr__ = checks.repr_of_fields

    @property
    def friction_demand(self) -> Array:
        """|horizontal|/vertical: the required coefficient of friction.

        Infinite where there is no compression, NaN where the contact carries nothing at all.
        """
        tangential = np.abs(self.horizontal)
        demand: Array = np.full(tangential.shape, np.inf)
        np.divide(tangential, self.vertical, out=demand, where=self.vertical > 0.0)
        unloaded = (tangential == 0.0) & (self.vertical == 0.0)
        return np.where(unloaded | np.isnan(self.vertical), np.nan, demand)


@dataclass(frozen=True, eq=False, repr=False)
class ContactForces:
    """The reactions at the four contacts of a rocking frame, each of the shape of the motion.

    Attributes
    ----------
    base_left, base_right : Reaction
        Of the ground on the left and the right column.
    top_left, top_right : Reaction
        Of the top of the left and the right column on the cap beam.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> forces = th.impact_impulses(frame, th.Cap(span=5.0, half_depth=0.4), 0.5)
    >>> round(forces.top_right.vertical.item(), 3)
    0.398
    """

    base_left: Reaction
    base_right: Reaction
    top_left: Reaction
    top_right: Reaction
    __repr__ = checks.repr_of_fields

    @property
    def contacts(self) -> tuple[Reaction, Reaction, Reaction, Reaction]:
        """The four, in the order above."""
        return self.base_left, self.base_right, self.top_left, self.top_right

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


def forces_at(
    frame: RockingFrame,
    cap: Cap,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike,
) -> ContactForces:
    """Return the forces on a frame in states of its motion, normalised by (2 m_c + m_b) g.

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
        For a rotation of π/2 or more, a span that is not more than the columns' width 2b, and a
        frame of more than two columns.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> forces = forces_at(frame, th.Cap(span=5.0, half_depth=0.4), 0.05, 0.0, 0.0)
    >>> round(forces.base_left.vertical.item(), 3)
    0.422
    """
    _check_contacts(frame, cap)
    motion = motion_state(frame.column, rotation, velocity, ground_acceleration)
    size, p_hat = frame.column.size, frame.frequency_parameter
    column_weight, beam_weight = weights(frame.mass_ratio)
    column = _inertia_force(motion, size, p_hat, column_weight)  # Eqs. (10), (11)
    beam = _inertia_force(motion, 2.0 * size, p_hat, beam_weight)  # Eqs. (12), (13)
    return _distributed(frame, cap, motion.side, motion.lean, column, beam)


def column_forces(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike
) -> Reaction:
    """Return the force of the ground on a solitary rocking column, normalised by its weight m g.

    Parameters, and the side that it turns to from θ = 0, are as in `forces_at`. At rest the
    force is determinate: the ground's acceleration times the mass, and the weight.

    Raises
    ------
    ValueError
        For a rotation of π/2 or more.

    Examples
    --------
    >>> column_forces(th.Column(0.5, 3.0), 0.0, 0.0, 0.05).vertical.item()
    1.0
    """
    motion = motion_state(column, rotation, velocity, ground_acceleration)
    rocking = _inertia_force(motion, column.size, column.frequency_parameter, 1.0)
    rests = (motion.rotation == 0.0) & (motion.velocity == 0.0) & np.isnan(motion.side)
    return Reaction(
        np.where(rests, motion.ground, rocking.horizontal), np.where(rests, 1.0, rocking.vertical)
    )


def impact_impulses(frame: RockingFrame, cap: Cap, velocity: ArrayLike) -> ContactForces:
    """Return the impulses on a rocking frame at an impact, divided by its mass 2 m_c + m_b, in m/s.

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
        When √r of Eq. (25) is negative, the span is not more than the columns' width 2b, or the
        frame has more than two columns.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> impulses = th.impact_impulses(frame, th.Cap(span=5.0, half_depth=0.4), 0.5)
    >>> round(impulses.base_left.vertical.item(), 3)
    0.333
    """
    _check_contacts(frame, cap)
    column_weight, beam_weight = weights(frame.mass_ratio)
    size = frame.column.size
    column = _impulse(frame, size, velocity, column_weight)
    beam = _impulse(frame, 2.0 * size, velocity, beam_weight)
    side = np.sign(np.asarray(velocity, dtype=float))
    lean = np.full(side.shape, frame.slenderness)
    return _distributed(frame, cap, side, lean, column, beam)


def _check_contacts(frame: object, cap: object) -> None:
    """Raise ValueError unless the contacts of a frame and a cap beam are known."""
    if not isinstance(frame, RockingFrame):
        raise ValueError(f"structure is {short_repr(frame)}; expected a RockingFrame")
    if not isinstance(cap, Cap):
        raise ValueError(
            f"cap is {short_repr(cap)}; expected its dimensions, for example "
            "Cap(span=5.0, half_depth=0.4) in m"
        )
    checked_two_columns(frame)
    checks.wider_than_column(cap.span, 2.0 * frame.column.half_width)


CONTACTS = ("base_left", "base_right", "top_left", "top_right")
"""The names of the contacts, those of the fields of `ContactForces`."""

BESIDE_IMPACT = 1e-8
"""Time before and after an impact at which the forces are computed, times 1/p̂."""

SAME_MOTION = 1e-6
"""Largest difference of θ, normalised by α, between a response and its repetition."""


def contact_forces(
    structure: RockingFrame, cap: Cap, response: Response, motion: Excitation | None = None
) -> xarray.Dataset:
    """Return the forces at the four contacts of a frame in a response, normalised by its weight.

    The response is followed again, at its own times, at the samples of a record, and just before
    and after each impact, where the forces jump. The impulses of the impacts themselves are those
    of `impact_impulses`.

    Parameters
    ----------
    structure : RockingFrame
        Of two columns, without a √r of its own.
    cap : Cap
    response : Response
        Of this structure to this motion, as `simulate` returns it, from t = 0.
    motion : Pulse or Record, optional
        None of free rocking.

    Returns
    -------
    xarray.Dataset
        Over (contact, time): horizontal (to the right) and vertical (upward), the force on the
        body above the contact over (2 m_c + m_b) g; required_friction, their ratio, infinite where
        the contact opens. NaN at rest, where whole faces are in contact, and after overturning.

    Raises
    ------
    ValueError
        For another structure, and for a response that is not the one of this structure to this
        motion or does not begin at t = 0.

    Examples
    --------
    >>> column = th.Column.of_dimensions(width=1.6, height=9.6)  # m
    >>> frame, cap = th.RockingFrame(column, mass_ratio=2.0), th.Cap(span=8.0, half_depth=0.6)
    >>> record = th.read_record("data/records/el_centro_1940_NS.AT2").scaled(2.0)
    >>> response = th.simulate(frame, record)
    >>> forces = th.contact_forces(frame, cap, response, record)
    >>> forces.required_friction.max("time").to_series().round(3).to_dict()
    {'base_left': 0.204, 'base_right': 0.212, 'top_left': 0.232, 'top_right': 0.242}
    >>> forces.vertical.min("time").to_series().round(3).to_dict()
    {'base_left': 0.385, 'base_right': 0.378, 'top_left': 0.227, 'top_right': 0.223}
    >>> lines = forces.required_friction.plot(hue="contact")
    """
    import xarray

    _check_contacts(structure, cap)
    if not isinstance(response, Response):
        raise ValueError(f"response is {short_repr(response)}; expected one that simulate returned")
    if motion is not None:
        checked_excitation(motion)
    if response.time[0] != 0.0:
        raise ValueError(f"response begins at {response.time[0]:.6g} s; expected t = 0")
    time = _times_of_forces(structure, response, motion)
    again = simulate(
        structure,
        motion,
        rotation=response.rotation[0],
        velocity=response.velocity[0],
        duration=float(time[-1]) if motion is not None and math.isinf(motion.duration) else None,
        samples=time,
    )
    repeated = again.rotation[np.searchsorted(time, response.time)]
    apart = np.abs(repeated - response.rotation) / structure.slenderness
    if not (np.isnan(repeated) == np.isnan(response.rotation)).all() or (apart > SAME_MOTION).any():
        raise ValueError(
            f"response differs by up to {np.nanmax(apart):.3g} α from that of this structure to "
            "this motion; expected the structure and the motion that it was simulated with, "
            "without a vertical component"
        )
    ground = np.zeros(time.size) if motion is None else motion.accelerations(time)
    ended = ~(np.abs(again.rotation) < math.pi / 2)  # or NaN: it lies flat
    forces = forces_at(structure, cap, np.where(ended, 0.0, again.rotation), again.velocity, ground)
    columns = {
        "horizontal": ([one.horizontal for one in forces.contacts], "horizontal force over weight"),
        "vertical": ([one.vertical for one in forces.contacts], "vertical force over weight"),
        "required_friction": (
            [one.friction_demand for one in forces.contacts],
            "required coefficient of friction",
        ),
    }
    at = ("contact", "time")
    return xarray.Dataset(
        {
            name: (at, np.where(ended, np.nan, values), {"units": "1", "long_name": long_name})
            for name, (values, long_name) in columns.items()
        },
        {"contact": [*CONTACTS], "time": ("time", time, {"units": "s"})},
        {"over": "weight (2 m_c + m_b) g"},
    )


def _times_of_forces(
    structure: RockingFrame, response: Response, motion: Excitation | None
) -> Array:
    """Return the times of a response, of a record's samples, and beside the impacts, s."""
    beside = BESIDE_IMPACT / structure.frequency_parameter
    times = [response.time, response.impact_times - beside, response.impact_times + beside]
    if isinstance(motion, Record):
        times.append(motion.time)
    together = np.unique(np.concatenate(times))
    inside: Array = together[(together >= 0.0) & (together <= response.time[-1])]
    return inside


class _State(NamedTuple):
    """θ, θ̇, ü_g (g), the side s (NaN at rest), the lean α − |θ|, its sine and cosine."""

    rotation: Array
    velocity: Array
    ground: Array
    side: Array
    lean: Array
    sine: Array
    cosine: Array


def motion_state(
    column: Column, rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike
) -> _State:
    """Return a motion as arrays of one shape, or raise ValueError for θ of π/2 or more."""
    theta, rate, ground = np.broadcast_arrays(
        checks.numbers("rotation", rotation),
        checks.numbers("velocity", velocity),
        checks.numbers("ground_acceleration", ground_acceleration),
    )
    if np.any(np.abs(theta) >= math.pi / 2):
        largest = float(np.nanmax(np.abs(theta)))
        raise ValueError(
            f"rotation is up to {largest:.6g} rad; expected less than π/2, where the column lies "
            "flat"
        )
    uplifted = np.where(np.abs(ground) >= column.uplift_acceleration, -np.sign(ground), np.nan)
    moving = np.where(rate != 0.0, np.sign(rate), uplifted)
    side = np.where(theta != 0.0, np.sign(theta), moving)
    lean = column.slenderness - np.abs(theta)
    return _State(theta, rate, ground, side, lean, np.sin(lean), np.cos(lean))


def _inertia_force(motion: _State, distance: float, frequency: float, weight: float) -> Reaction:
    """Return the force on a body, for its share of the weight.

    Its centre is this distance (m) from the pivot: the column's at R, the cap beam's at 2R. It
    moves with the diagonal through the pivot and with the ground. By Newton's law the force over
    the body's own weight is (ü_g + ẍ, g + z̈)/g.
    """
    s, sin, cos = motion.side, motion.sine, motion.cosine
    acceleration = -(frequency**2) * (s * sin + motion.ground * cos)  # Eq. (23)
    across = distance * acceleration / STANDARD_GRAVITY
    inward = distance * motion.velocity**2 / STANDARD_GRAVITY
    return Reaction(
        weight * (motion.ground + across * cos + inward * s * sin),  # Eq. (6)
        weight * (1.0 + across * s * sin - inward * cos),  # Eq. (9), as meant
    )


def _impulse(frame: RockingFrame, distance: float, velocity: ArrayLike, mass: float) -> Reaction:
    """Return the impulse (m/s) on a body at an impact, for its share of the mass.

    Its centre is this distance (m) along the diagonal. Its horizontal velocity drops by the factor
    √r. Its vertical velocity turns from downward to upward, since the pivot changes.
    """
    rate, alpha = checks.numbers("velocity", velocity), frame.slenderness
    checks.within_reason("velocity", np.abs(rate).max(initial=0.0), "rad/s")
    restitution = frame.block().restitution
    return Reaction(
        mass * (-distance * math.cos(alpha) * (1.0 - restitution) * rate),
        mass * (distance * math.sin(alpha) * (1.0 + restitution) * np.abs(rate)),
    )


def _distributed(
    frame: RockingFrame, cap: Cap, side: Array, lean: Array, column: Reaction, beam: Reaction
) -> ContactForces:
    """Distribute the forces on one column and on the cap beam over the four contacts.

    The cap beam's moments determine how much vertical force shifts from the left column top to the
    right one. The corresponding horizontal force follows the diagonals.
    """
    b, d = frame.column.half_width, cap.half_depth
    shift = (side * b * beam.vertical - d * beam.horizontal) / cap.span
    aside = -side * np.tan(lean) * shift
    top_left, top_right = (
        Reaction(beam.horizontal / 2.0 + end * aside, beam.vertical / 2.0 + end * shift)
        for end in (-1.0, 1.0)
    )
    base_left, base_right = (
        Reaction(top.horizontal + column.horizontal, top.vertical + column.vertical)
        for top in (top_left, top_right)
    )
    return ContactForces(base_left, base_right, top_left, top_right)


def weights(mass_ratio: float) -> tuple[float, float]:
    """Return the shares of one column and of the cap beam in the weight of the frame."""
    if mass_ratio == math.inf:
        return 0.0, 1.0
    return 0.5 / (1.0 + mass_ratio), mass_ratio / (1.0 + mass_ratio)
