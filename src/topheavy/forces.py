"""Forces of a rocking frame: at its contacts, in its columns, and clamped against uplift.

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

The loads of a column are the forces at its two contacts, half its width beside its axis, and its
own weight and inertia. With the transverse and axial force t and n of the ground on the column, and
the position c = b sgn θ of the contact, the bending moment at the height z along the axis is

    M(z) = c n + t z − ∫₀ᶻ q(y) (z − y) dy + (m_c/2h) (b²/3) θ̈ z,   q = (m_c/2h) a_t,

where a_t is the transverse acceleration on the axis, gravity included, and the last term is the
rotary inertia. Base shear and moments are positive for a frame at rest under ü_g > 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
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
    weights,
)
from topheavy.checks import short_repr
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import SHAPES, WAVES
from topheavy.outcomes.simulate import simulate

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
Force = tuple[Array, Array]
"""Horizontal and vertical."""


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

SECTIONS = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Heights, normalised by 2h, at which the bending moments are computed."""

BESIDE_IMPACT = 1e-8
"""Time before and after an impact at which the forces are computed, times 1/p̂."""

SAME_MOTION = 1e-6
"""Largest difference of θ, normalised by α, between a response and its repetition."""


@dataclass(frozen=True, eq=False, repr=False)
class ContactForces:
    """The forces, or at an impact the impulses, of four contacts on the bodies above them.

    Attributes
    ----------
    horizontal : ndarray, shape (4, ...)
        To the right, of the ground on the left and the right column, and of the top of the left and
        the right column on the cap beam; each of the shape of the motion.
    vertical : ndarray, shape (4, ...)
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
    """
    _check_contacts(frame, cap)
    motion = motion_state(frame.column, rotation, velocity, ground_acceleration)
    return _forces_in(frame, cap, motion)


def _forces_in(frame: RockingFrame, cap: Cap, motion: _State) -> ContactForces:
    """Return the forces of `forces_at` in states of the motion."""
    size, p_hat = frame.column.size, frame.frequency_parameter
    column_weight, beam_weight = weights(frame.mass_ratio)
    column = _inertia_force(motion, size, p_hat, column_weight)  # Eqs. (10), (11)
    beam = _inertia_force(motion, 2.0 * size, p_hat, beam_weight)  # Eqs. (12), (13)
    return _distributed(frame, cap, motion.side, motion.lean, column, beam)


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


def contact_forces(
    structure: RockingFrame, cap: Cap, response: Response, motion: Pulse | Record | None = None
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
    >>> axes = th.plot.forces(forces)
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
        "horizontal": (forces.horizontal, "horizontal force over weight"),
        "vertical": (forces.vertical, "vertical force over weight"),
        "required_friction": (forces.friction_demand, "required coefficient of friction"),
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
    structure: RockingFrame, response: Response, motion: Pulse | Record | None
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


def _inertia_force(motion: _State, distance: float, frequency: float, weight: float) -> Force:
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
    _check_contacts(frame, cap)
    motion = motion_state(frame.column, rotation, velocity, ground_acceleration)
    contacts = _forces_in(frame, cap, motion)
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
