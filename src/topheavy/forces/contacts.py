"""Forces at the contacts of a rocking frame, a column and a fixed mass.

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

The impulses at an impact obey the same equations. A column, and columns and cap in one piece
(`fixed_mass`), have one contact, at the pivot; its force is that on the whole body. Rotations are
in rad, signed; the ground acceleration is in g. Arrays broadcast.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.fixed_mass import RigidBody
from topheavy.bodies.response import Response
from topheavy.bodies.structures import (
    STANDARD_GRAVITY,
    Column,
    RockingFrame,
    weights,
)
from topheavy.checks import short_repr
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.outcomes.simulate import simulate

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
Force = tuple[Array, Array]
"""Horizontal and vertical."""

Bearing = RockingFrame | Column | RigidBody
"""A structure whose contact forces are known."""


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


CONTACTS = ("base_left", "base_right", "top_left", "top_right")
"""Of the ground on both columns, and of their tops on the cap beam."""

BASE = ("base",)
"""Of the ground on a column, or on columns and cap in one piece: at the pivot."""

BESIDE_IMPACT = 1e-8
"""Time before and after an impact at which the forces are computed, times 1/p̂."""

SAME_MOTION = 1e-6
"""Largest difference of θ, normalised by α, between a response and its repetition."""

STEPS = 64, 20
"""In a period of a pulse, and in 1/p̂: steps between the times of the forces, at least."""

CLOSER, PASSES = 8, 2
"""Parts of a step beside an extreme, and how often it is divided: extremes are known to 1e-4."""

NEAR = 0.01
"""Share of an extreme within which others are refined, too."""


@dataclass(frozen=True, eq=False, repr=False)
class ContactForces:
    """The forces, or at an impact the impulses, of four contacts on the bodies above them.

    Attributes
    ----------
    horizontal : ndarray, shape (4, ...) or (1, ...)
        To the right, of the ground on the left and the right column, and of the top of the left and
        the right column on the cap beam; each of the shape of the motion. Of a column or a fixed
        mass: of the ground.
    vertical : ndarray, shape (4, ...) or (1, ...)
        Upward. If it is negative, the contact would have to pull; it opens instead.

    Examples
    --------
    >>> frame = th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0)
    >>> impulses = th.impact_impulses(frame, th.Cap(span=5.0, half_depth=0.4), 0.5)
    >>> impulses.vertical.round(3).tolist()
    [0.333, 0.479, 0.251, 0.398]
    """

    horizontal: Array
    vertical: Array
    __repr__ = checks.repr_of_fields

    @property
    def friction_demand(self) -> Array:
        """|horizontal|/vertical: the required coefficient of friction of each contact.

        Infinite where there is no compression, NaN where the contact carries nothing at all.
        """
        tangential = np.abs(self.horizontal)
        demand: Array = np.full(tangential.shape, np.inf)
        np.divide(tangential, self.vertical, out=demand, where=self.vertical > 0.0)
        unloaded = (tangential == 0.0) & (self.vertical == 0.0)
        return np.where(unloaded | np.isnan(self.vertical), np.nan, demand)


def forces_at(
    structure: Bearing,
    cap: Cap | None,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike,
) -> ContactForces:
    """Return the contact forces in states of a motion, normalised by the weight of the structure.

    The motion is that of Eq. (23). The forces are not limited where a contact cannot provide them:
    a tension or a very large required friction shows that the assumed motion is impossible.

    Parameters
    ----------
    structure : RockingFrame, Column, FixedMassColumn or MonolithicPortal
        γ of a frame may be 0 (no force under the cap beam) or infinite (columns without weight).
    cap : Cap, optional
        Of a frame, whose weight is (2 m_c + m_b) g; None of the others.
    rotation, velocity, ground_acceleration : array_like
        θ (rad, |θ| < π/2), θ̇ (rad/s) and ü_g (g).

    Returns
    -------
    ContactForces
        At θ = 0 the structure turns to the side of its velocity. Without one, it turns to the side
        that ü_g uplifts it to, for |ü_g| ≥ tan α. Below, at rest, the forces are NaN: base and
        top faces are in full contact, and nine equations do not determine the twelve resultants.

    Raises
    ------
    ValueError
        For a rotation of π/2 or more, a frame without a cap, another structure with one, a span
        that is not more than the columns' width 2b, and a frame of more than two columns.
    """
    check_contacts(structure, cap)
    motion = motion_state(structure, rotation, velocity, ground_acceleration)
    return forces_in(structure, cap, motion)


def forces_in(structure: Bearing, cap: Cap | None, motion: State) -> ContactForces:
    """Return the forces of `forces_at` in states of the motion."""
    frequency = structure.frequency_parameter
    if not isinstance(structure, RockingFrame) or cap is None:
        base = _inertia_force(motion, _distance(structure), frequency, 1.0)
        return ContactForces(*(np.asarray(component)[None] for component in base))
    size = structure.column.size
    column_weight, beam_weight = weights(structure.mass_ratio)
    column = _inertia_force(motion, size, frequency, column_weight)  # Eqs. (10), (11)
    beam = _inertia_force(motion, 2.0 * size, frequency, beam_weight)  # Eqs. (12), (13)
    return _distributed(structure, cap, motion.side, motion.lean, column, beam)


def _distance(structure: Bearing) -> float:
    """Return the distance of the centre of gravity from the pivot, m."""
    if isinstance(structure, RigidBody):
        return math.hypot(structure.half_base, structure.centre_height)
    return structure.column.size if isinstance(structure, RockingFrame) else structure.size


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
    >>> impulses.friction_demand.round(3).tolist()  # of both bases and both tops
    [0.159, 0.161, 0.159, 0.162]
    """
    checked_frame(frame, cap)
    column_weight, beam_weight = weights(frame.mass_ratio)
    size = frame.column.size
    column = _impulse(frame, size, velocity, column_weight)
    beam = _impulse(frame, 2.0 * size, velocity, beam_weight)
    side = np.sign(np.asarray(velocity, dtype=float))
    lean = np.full(side.shape, frame.slenderness)
    return _distributed(frame, cap, side, lean, column, beam)


def checked_frame(frame: object, cap: object) -> None:
    """Raise ValueError unless the contacts of a frame and a cap beam are known."""
    if not isinstance(frame, RockingFrame):
        raise ValueError(f"structure is {short_repr(frame)}; expected a RockingFrame")
    if not isinstance(cap, Cap):
        raise ValueError(
            f"cap is {short_repr(cap)}; expected its dimensions, for example "
            "Cap(span=5.0, half_depth=0.4) in m"
        )
    if frame.columns != 2:
        raise ValueError(
            f"frame has {frame.columns} columns; expected two: between more, equilibrium does "
            "not divide the load of a rigid cap beam. Assume a share for each. If they are equal, "
            "each column carries, but for the moment of the beam, what one of two does: "
            "RockingFrame(column, mass_ratio) with the same γ"
        )
    checks.wider_than_column(cap.span, 2.0 * frame.column.half_width)


def check_contacts(structure: object, cap: object) -> None:
    """Raise ValueError unless the contacts of a structure are known."""
    if isinstance(structure, RockingFrame):
        checked_frame(structure, cap)
    elif not isinstance(structure, Column | RigidBody):
        raise ValueError(
            f"structure is {short_repr(structure)}; expected a RockingFrame, a Column, or columns "
            "and cap in one piece (FixedMassColumn, MonolithicPortal)"
        )
    elif cap is not None:
        raise ValueError(
            f"cap is {short_repr(cap)}; expected None, since {type(structure).__name__} has no "
            "loose cap beam"
        )


def static_shares(structure: Bearing) -> Array:
    """Return the vertical force of each contact at rest, over the weight of the structure."""
    if not isinstance(structure, RockingFrame):
        return np.ones(1)
    beam = weights(structure.mass_ratio)[1]
    return np.array([1.0, 1.0, beam, beam]) / 2.0


def contact_forces(
    structure: Bearing,
    cap: Cap | None,
    response: Response,
    motion: Pulse | Record | None = None,
    *,
    until_alpha: bool = False,
) -> xarray.Dataset:
    """Return the forces at the contacts of a structure in a response, normalised by its weight.

    The response is followed again, at its own times and at as many more as resolve its course, and
    just before and after each impact, where the forces jump. The extremes of each contact are met
    to 1e-4. The impulses of the impacts themselves are those of `impact_impulses`.

    Parameters
    ----------
    structure : RockingFrame, Column, FixedMassColumn or MonolithicPortal
        A frame of two columns; without a √r of its own.
    cap : Cap, optional
        Of a frame; None of the others.
    response : Response
        Of this structure to this motion, as `simulate` returns it, from t = 0.
    motion : Pulse or Record, optional
        None of free rocking.
    until_alpha : bool
        Whether the forces end where |θ| passes α for the last time: an overturned structure does
        not come back from there.

    Returns
    -------
    xarray.Dataset
        Over (contact, time): horizontal (to the right) and vertical (upward), the force on the
        body above the contact over the weight; required_friction, their ratio, infinite where
        the contact opens. NaN at rest, where whole faces are in contact, and after overturning.
        Over contact: at_rest, the vertical force of the resting structure. The contacts are those
        of `CONTACTS`, or base.

    Raises
    ------
    ValueError
        For another structure, a frame without a cap, and for a response that is not the one of
        this structure to this motion or does not begin at t = 0.

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
    >>> axes = th.plot.forces(forces)
    """
    import xarray

    check_contacts(structure, cap)
    if not isinstance(response, Response):
        raise ValueError(f"response is {short_repr(response)}; expected one that simulate returned")
    if motion is not None:
        checked_excitation(motion)
    until_alpha = checks.truth("until_alpha", until_alpha)
    if response.time[0] != 0.0:
        raise ValueError(f"response begins at {response.time[0]:.6g} s; expected t = 0")
    time = _times_of_forces(structure, response, motion)
    for number in range(PASSES + 1):
        again = simulate(
            structure,
            motion,
            rotation=response.rotation[0],
            velocity=response.velocity[0],
            duration=float(time[-1]) if motion and math.isinf(motion.duration) else None,
            samples=time,
        )
        if not number:
            _check_same(response, again, structure.slenderness)
        theta = again.rotation
        ended = ~(np.abs(theta) < math.pi / 2)  # or NaN: it lies flat
        if until_alpha:
            (inside,) = np.nonzero(np.abs(theta) <= structure.slenderness)
            ended[inside.max(initial=0) + 1 :] = True
        ground = np.zeros(time.size) if motion is None else motion.accelerations(time)
        forces = forces_at(structure, cap, np.where(ended, 0.0, theta), again.velocity, ground)
        components = forces.horizontal, forces.vertical, forces.friction_demand
        across, upward, friction = (np.where(ended, np.nan, values) for values in components)
        if number < PASSES:
            time = _closer(
                time, upward, friction, 3.0 * BESIDE_IMPACT / structure.frequency_parameter
            )
    names = {
        "horizontal": "horizontal force over weight",
        "vertical": "vertical force over weight",
        "required_friction": "required coefficient of friction",
    }
    contacts = CONTACTS if isinstance(structure, RockingFrame) else BASE
    variables = {
        name: (("contact", "time"), values, {"units": "1", "long_name": long_name})
        for (name, long_name), values in zip(names.items(), (across, upward, friction), strict=True)
    }
    shares = {"units": "1", "long_name": "vertical force at rest over weight"}
    return xarray.Dataset(
        variables | {"at_rest": ("contact", static_shares(structure), shares)},
        {"contact": [*contacts], "time": ("time", time, {"units": "s"})},
        {"over": f"weight {'(2 m_c + m_b)' if contacts is CONTACTS else 'm'} g"},
    )


def _check_same(response: Response, again: Response, slenderness: float) -> None:
    """Raise ValueError unless a response is met again, at its times among those of another one.

    A structure that has overturned lies flat: at its last sample, or NaN behind it.
    """
    repeated = again.rotation[np.searchsorted(again.time, response.time)]
    known = response.rotation[~np.isnan(response.rotation)]
    flat = math.copysign(math.pi / 2, known[-1])
    both = (np.where(np.isnan(theta), flat, theta) for theta in (repeated, response.rotation))
    apart = np.abs(np.subtract(*both)).max() / slenderness
    if apart > SAME_MOTION:
        raise ValueError(
            f"response differs by up to {apart:.3g} α from that of this structure to "
            "this motion; expected the structure and the motion that it was simulated with, "
            "without a vertical component"
        )


def _times_of_forces(
    structure: Bearing, response: Response, motion: Pulse | Record | None
) -> Array:
    """Return the times of a response, of a record's samples, beside the impacts, and between, s."""
    frequency, end = structure.frequency_parameter, response.time[-1]
    beside, step = BESIDE_IMPACT / frequency, 1.0 / (STEPS[1] * frequency)
    times = [response.time, response.impact_times - beside, response.impact_times + beside]
    if isinstance(motion, Record):
        times.append(motion.time)
    elif motion is not None:
        step = min(step, 2.0 * math.pi / (STEPS[0] * motion.angular_frequency))
    together = np.unique(np.concatenate([*times, step * np.arange(math.ceil(end / step))]))
    inside: Array = together[(together >= 0.0) & (together <= end)]
    return inside


def _closer(time: Array, vertical: Array, friction: Array, gap: float) -> Array:
    """Return times with more of them beside the extremes, and where the forces end.

    Steps no longer than the gap (s), between the sides of an impact, are not divided.
    """
    places = set(np.flatnonzero(np.diff(np.isnan(vertical[0]))))
    for values in (vertical, np.where(np.isfinite(friction), -friction, np.inf)):
        values = np.pad(np.where(np.isnan(values), np.inf, values), ((0, 0), (1, 1)), mode="edge")
        lowest = values.min(axis=1, keepdims=True)
        near = np.isfinite(values) & (values <= lowest + NEAR * np.abs(lowest))
        turns = (values[:, 1:-1] <= values[:, :-2]) & (values[:, 1:-1] <= values[:, 2:])
        places |= set(np.flatnonzero((turns & near[:, 1:-1]).any(axis=0)))
    at = np.array(sorted(places), dtype=int)
    sides = {*(at[at > 0] - 1), *at[at < time.size - 1]}
    steps = np.array([place for place in sides if time[place + 1] - time[place] > gap], dtype=int)
    inner = np.linspace(time[steps], time[steps + 1], CLOSER + 1)
    return np.unique(np.append(time, inner))


class State(NamedTuple):
    """θ, θ̇, ü_g (g), the side s (NaN at rest), the lean α − |θ|, its sine and cosine."""

    rotation: Array
    velocity: Array
    ground: Array
    side: Array
    lean: Array
    sine: Array
    cosine: Array


def motion_state(
    structure: Bearing, rotation: ArrayLike, velocity: ArrayLike, ground_acceleration: ArrayLike
) -> State:
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
    uplifted = np.where(np.abs(ground) >= structure.uplift_acceleration, -np.sign(ground), np.nan)
    moving = np.where(rate != 0.0, np.sign(rate), uplifted)
    side = np.where(theta != 0.0, np.sign(theta), moving)
    lean = structure.slenderness - np.abs(theta)
    return State(theta, rate, ground, side, lean, np.sin(lean), np.cos(lean))


def _inertia_force(motion: State, distance: float, frequency: float, weight: float) -> Force:
    """Return the force on a body, for its share of the weight.

    Its centre is this distance (m) from the pivot: the column's at R, the cap beam's at 2R. It
    moves with the diagonal through the pivot and with the ground. By Newton's law the force over
    the body's own weight is (ü_g + ẍ, g + z̈)/g.
    """
    s, sin, cos = motion.side, motion.sine, motion.cosine
    acceleration = -(frequency**2) * (s * sin + motion.ground * cos)  # Eq. (23)
    across = distance * acceleration / STANDARD_GRAVITY
    inward = distance * motion.velocity**2 / STANDARD_GRAVITY
    return (
        weight * (motion.ground + across * cos + inward * s * sin),  # Eq. (6)
        weight * (1.0 + across * s * sin - inward * cos),  # Eq. (9), as meant
    )


def _impulse(frame: RockingFrame, distance: float, velocity: ArrayLike, mass: float) -> Force:
    """Return the impulse (m/s) on a body at an impact, for its share of the mass.

    Its centre is this distance (m) along the diagonal. Its horizontal velocity drops by the factor
    √r. Its vertical velocity turns from downward to upward, since the pivot changes.
    """
    rate, alpha = checks.numbers("velocity", velocity), frame.slenderness
    checks.within_reason("velocity", np.abs(rate).max(initial=0.0), "rad/s")
    restitution = frame.block().restitution
    return (
        mass * (-distance * math.cos(alpha) * (1.0 - restitution) * rate),
        mass * (distance * math.sin(alpha) * (1.0 + restitution) * np.abs(rate)),
    )


def _distributed(
    frame: RockingFrame,
    cap: Cap,
    side: Array,
    lean: Array,
    column: Force,
    beam: Force,
) -> ContactForces:
    """Distribute the forces on one column and on the cap beam over the four contacts.

    The cap beam's moments determine how much vertical force shifts from the left column top to the
    right one. The corresponding horizontal force follows the diagonals.
    """
    b, d = frame.column.half_width, cap.half_depth
    shift = (side * b * beam[1] - d * beam[0]) / cap.span
    aside = -side * np.tan(lean) * shift
    components = []
    for of_column, of_beam, moved in zip(column, beam, (aside, shift), strict=True):
        tops = [of_beam / 2.0 + end * moved for end in (-1.0, 1.0)]
        components.append(np.array([*(top + of_column for top in tops), *tops]))
    return ContactForces(*components)
