"""Columns, cap beam and ground as rigid bodies in MuJoCo, a general rigid-body engine.

The model is three boxes and a plane with unilateral contact and friction. It contains no
rocking-specific equations: no common rotation, no pivot corners, no level cap beam, no √r. Motion
is planar: each body has two slides and a hinge. The ground is fixed, and an inertial force
represents its motion: gravity becomes (−ü_g, 0, −g).

Contacts are compliant: a spring and a damper, with a time constant of a few time steps. If time
constant and time step decrease together, the limit is the rigid structure.

Angles are in rad, rotations signed (θ > 0 leans to the right), everything else in SI units.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from topheavy import STANDARD_GRAVITY, Cap, Pulse, RockingFrame

if TYPE_CHECKING:  # an optional package: only what runs the engine imports it
    import mujoco

Array = NDArray[np.float64]

COLUMN_MASS = 1.0  # kg; contacts are scaled by mass, so that only mass ratios matter
FALLEN = math.pi / 3  # rad, from where no pulse brings a column back; the cap is still aloft
CHUNK = 200  # time steps between looks at whether a run may end


@dataclass(frozen=True)
class Contact:
    """How bodies touch.

    Parameters
    ----------
    time_constant, damping_ratio : float
        Of the spring and damper of a contact (MuJoCo's `solref`), in s and of critical damping.
        The damping is 2 over the time constant whatever the ratio: a ratio below one is a stiffer
        spring.
    friction : float
        Coefficient μ of all contacts.
    impedance : float
        Share of the force of the ideal contact that is enforced (`solimp`), in (0, 1).
    friction_impedance : float
        How much harder friction is enforced than the normal force (`impratio`); against creep.
    """

    time_constant: float
    damping_ratio: float = 1.0
    friction: float = 1.0
    impedance: float = 0.95
    friction_impedance: float = 10.0


def point_restitution(damping_ratio: float) -> float:
    """Return the ratio of velocities after and before a point hits a spring and damper.

    They push only, and let go when their force vanishes (Schwager & Pöschel 2007), so that even
    critical damping gives back e⁻². Gravity is left out: it matters to slow hits on soft contacts.
    """
    root = math.sqrt(abs(1.0 - damping_ratio**2))
    if root == 0.0:
        return math.exp(-2.0)
    # Half the contact's length in phase, by the angle or its hyperbolic counterpart.
    angle = math.atan2 if damping_ratio < 1.0 else lambda s, c: math.atanh(s / c)
    return math.exp(-2.0 * damping_ratio / root * angle(root, damping_ratio))


@dataclass(frozen=True)
class Rig:
    """A solitary column (mass ratio 0, no cap) or a frame, ready to be put on the ground.

    Parameters
    ----------
    frame : RockingFrame
    cap : Cap or None
        None for mass ratio 0, and only then. It overhangs each column by one half width.
    contact : Contact
    time_step : float
        s; at most half the time constant of the contact, below which MuJoCo softens it unasked.

    Raises
    ------
    ValueError
        For a mass ratio and a cap that do not go together, a cap that is too short for its
        columns, or a time step that is too long.
    """

    frame: RockingFrame
    cap: Cap | None
    contact: Contact
    time_step: float

    def __post_init__(self) -> None:
        ratio, column = self.frame.mass_ratio, self.frame.column
        if (ratio > 0.0) != (self.cap is not None) or ratio == math.inf:
            raise ValueError(
                f"mass_ratio is {ratio:.6g} and cap is {self.cap}; expected a cap with a finite "
                "positive mass ratio, and none with zero"
            )
        if self.cap is not None and self.cap.span <= 2.0 * column.half_width:
            raise ValueError(
                f"cap.span is {self.cap.span:.6g} m; the columns are "
                f"{2 * column.half_width:.6g} m wide and would overlap"
            )
        if not 0.0 < self.time_step <= 0.5 * self.contact.time_constant:
            raise ValueError(
                f"time_step is {self.time_step:.6g} s; expected it in (0, "
                f"{0.5 * self.contact.time_constant:.6g}], half the contact's time constant"
            )

    @property
    def feet(self) -> Array:
        """Horizontal positions of the columns' axes at rest, m."""
        return np.zeros(1) if self.cap is None else 0.5 * self.cap.span * np.array([-1.0, 1.0])


@dataclass(frozen=True)
class Motion:
    """Poses after each step: `time` (n,), `pose` (n, bodies, 3) with x, z (m) and θ (rad).

    Columns come first, left to right, then the cap.
    """

    time: Array
    pose: Array

    @property
    def rotation(self) -> Array:
        """θ of the left column, shape (n,)."""
        return self.pose[:, 0, 2]


def build(rig: Rig) -> "mujoco.MjModel":
    """Return the MuJoCo model of a rig."""
    import mujoco

    column, contact = rig.frame.column, rig.contact
    b, h = column.half_width, column.half_height
    names = [f"column{i}" for i in range(len(rig.feet))]
    bodies = [_box(name, b, h, b, COLUMN_MASS) for name in names]
    pairs = [("ground", name) for name in names]
    if rig.cap is not None:
        length, mass = 0.5 * rig.cap.span + 2.0 * b, 2.0 * COLUMN_MASS * rig.frame.mass_ratio
        bodies.append(_box("cap", length, rig.cap.half_depth, b, mass))
        pairs += [(name, "cap") for name in names]
    touch = (
        f'condim="3" friction="{contact.friction} {contact.friction} 0 0 0"'
        f' solref="{contact.time_constant} {contact.damping_ratio}"'
        f' solimp="{contact.impedance} {contact.impedance} 0.001 0.5 1"'
    )
    touching = "".join(f'<pair geom1="{one}" geom2="{two}" {touch}/>' for one, two in pairs)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{rig.time_step}" gravity="0 0 {-STANDARD_GRAVITY}"'
        f' integrator="Euler" solver="Newton" tolerance="1e-12" cone="elliptic"'
        f' impratio="{contact.friction_impedance}"/>'
        '<worldbody><geom name="ground" type="plane" size="1 1 1" contype="0" conaffinity="0"/>'
        f"{''.join(bodies)}</worldbody><contact>{touching}</contact></mujoco>"
    )


def _box(name: str, length: float, height: float, width: float, mass: float) -> str:
    """Return a box of these half sides that moves in the plane; it touches only named pairs."""
    return (
        f'<body name="{name}"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
        '<joint type="hinge" axis="0 1 0"/>'
        f'<geom name="{name}" type="box" size="{length} {width} {height}" mass="{mass}"'
        ' contype="0" conaffinity="0"/></body>'
    )


def leaning(rig: Rig, rotation: float) -> Array:
    """Return the pose, shape (bodies, 3), with all columns leaning by θ and the cap level on top.

    Every corner that ought to touch does so without overlap.
    """
    b, h = rig.frame.column.half_width, rig.frame.column.half_height
    corners = np.array([[-b, -h], [b, -h], [-b, h], [b, h]]) @ _turn(rotation)
    lowest, highest = (1, 2) if rotation >= 0.0 else (0, 3)
    centre = np.array([math.copysign(b, rotation), 0.0]) - corners[lowest]
    pose = [[foot + centre[0], centre[1], rotation] for foot in rig.feet]
    if rig.cap is not None:
        seat = centre + corners[highest]
        shift = seat[0] + math.copysign(b, rotation)
        pose.append([shift, seat[1] + rig.cap.half_depth, 0.0])
    return np.array(pose)


def run(
    rig: Rig,
    pulse: Pulse | None = None,
    *,
    rotation: float = 0.0,
    duration: float,
    ends: Callable[[Array, int], bool] | None = None,
) -> Motion:
    """Release a rig from rest, leaning by θ, shake it, and return its motion.

    Parameters
    ----------
    rig : Rig
    pulse : Pulse, optional
    rotation : float
        θ at t = 0, rad.
    duration : float
        The longest run, s.
    ends : callable, optional
        Takes θ of the left column after all steps so far and the number of steps of the pulse, and
        says whether the run may end before its duration.

    Raises
    ------
    ArithmeticError
        When the engine warns of a solution that is not sound.
    """
    import mujoco

    model = build(rig)
    data = mujoco.MjData(model)
    data.qpos[:] = leaning(rig, rotation).ravel()
    steps = math.ceil(duration / rig.time_step)
    middles = (np.arange(steps) + 0.5) * rig.time_step
    shaking = np.zeros(steps) if pulse is None else np.asarray(pulse.excitation(middles))
    pulse_steps = 0 if pulse is None else math.ceil(min(pulse.duration, duration) / rig.time_step)
    push, gravity, found = (
        -STANDARD_GRAVITY * shaking,
        model.opt.gravity,
        np.empty((steps, model.nq)),
    )
    done = steps
    for step in range(steps):
        gravity[0] = push[step]
        mujoco.mj_step(model, data)
        found[step] = data.qpos
        if (
            ends is not None
            and step % CHUNK == CHUNK - 1
            and ends(found[: step + 1, 2], pulse_steps)
        ):
            done = step + 1
            break
    if any(warning.number for warning in data.warning):
        raise ArithmeticError(f"{rig}: MuJoCo warns after {done} steps of {rig.time_step:.6g} s")
    time = (np.arange(done) + 1.0) * rig.time_step
    return Motion(time, found[:done].reshape(done, -1, 3))


def ground_forces(rig: Rig, motion: Motion) -> Array:
    """Return the normal forces of the ground on each column at the end of a motion at rest, N."""
    import mujoco

    model = build(rig)
    data = mujoco.MjData(model)
    data.qpos[:] = motion.pose[-1].ravel()
    data.qvel[:] = (motion.pose[-1] - motion.pose[-2]).ravel() / rig.time_step
    mujoco.mj_forward(model, data)
    ground = model.geom("ground").id
    total, force = np.zeros(len(rig.feet)), np.zeros(6)
    for i, contact in enumerate(data.contact):
        if ground in contact.geom:
            mujoco.mj_contactForce(model, data, i, force)
            total[model.geom_bodyid[contact.geom].max() - 1] += force[0]
    return total


def raised_energy(rig: Rig, pose: Array) -> float:
    """Return the potential energy above that of rest, J, of a pose (bodies, 3)."""
    rest = leaning(rig, 0.0)
    mass = np.full(len(rest), COLUMN_MASS)
    mass[len(rig.feet) :] *= 2.0 * rig.frame.mass_ratio
    return float(STANDARD_GRAVITY * (pose[:, 1] - rest[:, 1]) @ mass)


def slips(rig: Rig, motion: Motion, *, gap: float) -> tuple[float, float]:
    """Return the longest way that a touching corner slides along ground and cap underside, m.

    A corner touches while it is nearer than `gap` (m) at the beginning and the end of a step. The
    gap has room for hops: the engine's convex contacts throw a fast sliding body up by millimetres.
    The way along the cap is zero for a solitary column.
    """
    base = seat = 0.0
    b, h = rig.frame.column.half_width, rig.frame.column.half_height
    for i in range(len(rig.feet)):
        pose = motion.pose[:, i]
        for corner in ([-b, -h], [b, -h]):
            base = max(base, _way(_carried(pose, corner), gap))
        if rig.cap is not None:
            for corner in ([-b, h], [b, h]):
                cap = motion.pose[:, -1]
                apart = _carried(pose, corner) - cap[:, :2]
                cos, sin = np.cos(cap[:, 2]), np.sin(cap[:, 2])
                along = cos * apart[:, 0] - sin * apart[:, 1]
                below = -sin * apart[:, 0] - cos * apart[:, 1] - rig.cap.half_depth
                seat = max(seat, _way(np.stack([along, below], axis=1), gap))
    return base, seat


def _carried(pose: Array, corner: list[float]) -> Array:
    """Return where a point of a body is, (n, 2), for poses (n, 3)."""
    cos, sin = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    x, z = corner
    return pose[:, :2] + np.stack([cos * x + sin * z, cos * z - sin * x], axis=1)


def _way(point: Array, gap: float) -> float:
    """Return how far a point (n, 2) goes along a surface while its height over it is small."""
    near = point[:, 1] < gap
    steps = np.abs(np.diff(point[:, 0]))
    return float(steps[near[1:] & near[:-1]].sum())


def _turn(rotation: float) -> Array:
    """Return the matrix that turns row vectors clockwise by θ."""
    cos, sin = math.cos(rotation), math.sin(rotation)
    return np.array([[cos, -sin], [sin, cos]])
