"""Moments and shears at the joints and bases of the columns of a monolithic portal.

While it rocks about one corner, it is statically determinate. The column whose base is in the air
hangs from its joint. The other one bears the whole portal at its outer edge, half its width b
beside its axis. By d'Alembert, with t and n for the transverse and axial parts of the acceleration,
gravity included, and w_c for the weight of a column, its own loads between base and joint are

    w_c t and w_c n at mid-height,    moment about the joint w_c (h t₀ + (2h² − b²)/3 θ̈/g),

where t₀ is t at its base. The balance of the cap beam is not used, so that it checks the rest.

While it rests on both bases, it is hyperstatic. The assumptions are a rigid cap beam, two equal
elastic columns that do not change their length, and forces that follow the ground (no vibration).
Such a cap beam does not turn and guides both columns. Their bases are limits, each an assumption:
"fixed", they do not turn, or "pinned" at the axes, they turn freely. The base of a free-standing
portal is neither; it resists at most b times its axial force.

Forces are over the weight of the portal. The impulses of impacts are no forces.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.fixed_mass import MonolithicPortal
from topheavy.bodies.structures import STANDARD_GRAVITY

Array = NDArray[np.float64]

Bases: TypeAlias = Literal["fixed", "pinned"]


class Section(NamedTuple):
    """Forces of the part below on that above, left and right column: shape (..., 2).

    The shear is transverse, positive to the right, and the axial force along the column, positive
    in compression. The moment (m) is about the axis, positive anticlockwise.
    """

    shear: Array
    axial: Array
    moment: Array


class ColumnEnds(NamedTuple):
    """Forces at the bases and at the joints of both columns, over the weight of the portal.

    >>> portal = th.MonolithicPortal(th.Column(0.5, 3.0), mass_ratio=1.0, span=5.0)
    >>> th.rocking_portal_forces(portal, 0.02, 0.0)._fields
    ('base', 'joint')
    """

    base: Section
    joint: Section


def rocking_portal_forces(
    portal: MonolithicPortal,
    rotation: ArrayLike,
    velocity: ArrayLike,
    ground_acceleration: ArrayLike = 0.0,
) -> ColumnEnds:
    """Return the forces at the ends of the columns while the portal rocks about a corner.

    Rotation (rad, signed), velocity (rad/s) and ground acceleration (g) broadcast; the angular
    acceleration is that of Eq. (23) with p' and α'. NaN at rest below the uplift acceleration.

    >>> portal = th.MonolithicPortal(th.Column(0.5, 3.0), mass_ratio=1.0, span=5.0)
    >>> th.rocking_portal_forces(portal, 0.02, 0.0).joint.moment.round(4)
    array([ 0.1293, -1.6922])
    """
    theta, rate, ground = (
        one[..., None]
        for one in np.broadcast_arrays(
            checks.numbers("rotation", rotation),
            checks.numbers("velocity", velocity),
            checks.numbers("ground_acceleration", ground_acceleration),
        )
    )
    b, h = portal.column.half_width, portal.column.half_height
    uplifted = np.where(np.abs(ground) >= portal.uplift_acceleration, -np.sign(ground), np.nan)
    side = np.sign(np.where(theta != 0.0, theta, np.where(rate != 0.0, rate, uplifted)))
    lean, cos, sin = portal.slenderness - np.abs(theta), np.cos(theta), np.sin(theta)
    angular = -(portal.frequency_parameter**2) * (side * np.sin(lean) + ground * np.cos(lean))
    turn, spin = angular / STANDARD_GRAVITY, rate**2 / STANDARD_GRAVITY

    def pull(across: float | Array, height: float) -> tuple[Array, Array]:
        """Return t and n in g at a place of the portal, from the middle of its base."""
        arm = across - side * portal.half_base
        transverse = ground * cos - sin + turn * height - spin * arm
        return transverse, ground * sin + cos - turn * arm - spin * height

    axes = np.array([-0.5, 0.5]) * portal.span
    bears = side * axes > 0.0
    whole = pull(0.0, portal.centre_height)
    shear, axial = (bears * force for force in whole)
    base = Section(shear, axial, side * b * axial)
    (at_base, _), (transverse, along) = pull(axes, 0.0), pull(axes, h)
    load = h * at_base + turn * (2.0 * h**2 - b**2) / 3.0
    weight = _column_weight(portal)
    moment = base.moment + 2.0 * h * shear - weight * load
    return ColumnEnds(base, Section(shear - weight * transverse, axial - weight * along, moment))


def resting_portal_forces(
    portal: MonolithicPortal, bases: Bases, ground_acceleration: ArrayLike
) -> ColumnEnds:
    """Return the forces at the ends of the columns while the portal rests on both bases.

    A column of length 2h under half the cap beam's inertia P at its top and its own w over its
    length, guided at its top, has the moment Ph + (4/3)wh² at a fixed base and Ph + (2/3)wh² at the
    joint; with a pinned base, 2Ph + 2wh² at the joint.

    Raises
    ------
    ValueError
        For other bases.

    Examples
    --------
    >>> portal = th.MonolithicPortal(th.Column(0.5, 3.0), mass_ratio=1.0, span=5.0)
    >>> th.resting_portal_forces(portal, "fixed", 0.05).joint.moment.round(4)
    array([0.05, 0.05])
    """
    if not isinstance(bases, str) or bases not in get_args(Bases):
        raise ValueError(
            f"bases is {bases!r}; expected 'fixed', they do not turn, or 'pinned', they turn freely"
        )
    ground = checks.numbers("ground_acceleration", ground_acceleration)[..., None] * np.ones(2)
    h, column = portal.column.half_height, _column_weight(portal)
    beam = 1.0 - 2.0 * column
    held = 0.0 if bases == "pinned" else -h * (beam / 2.0 + 2.0 * column / 3.0)
    couple = (portal.centre_height + 2.0 * held) * ground  # of the axial forces
    axial = 0.5 + np.array([1.0, -1.0]) * couple / portal.span
    base = Section(ground / 2.0, axial, held * ground)
    moment = (held + h * (1.0 - column)) * ground
    return ColumnEnds(base, Section(beam / 2.0 * ground, axial - column, moment))


def _column_weight(portal: MonolithicPortal) -> float:
    """Return the share of one column in the weight."""
    return 0.0 if portal.mass_ratio == math.inf else 0.5 / (1.0 + portal.mass_ratio)
