"""Columns and a cap beam as boxes in MuJoCo, a general rigid-body engine, in a plane.

The engine knows boxes, a plane, contact and friction. It has no rocking-specific equations: no
common rotation, no pivots, no level cap beam, no √r. The ground is fixed, and an inertial force
represents its motion: gravity becomes (−ü_g, 0, −g).

Contacts are compliant: a spring and a damper, with a time constant of a few time steps. If time
constant and time step decrease together, the limit is the rigid structure.
"""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from topheavy import STANDARD_GRAVITY, Cap, Pulse, RockingFrame

COLUMN_MASS = 1.0  # kg; contacts are scaled by mass, so that only mass ratios matter
OVERTURNED = math.pi / 3  # rad, from where no pulse brings a column back; the cap is still aloft
WAIT = 20.0  # over p̂: how long after a pulse the outcome may take
INTERVAL = 200  # time steps between looks at the outcome
IMPEDANCE = 0.95  # share of the force of the ideal contact (MuJoCo's `solimp`)
FRICTION_IMPEDANCE = 10.0  # friction is so much harder than the normal force, against creep


@dataclass(frozen=True)
class Boxes:
    """A solitary column (mass ratio 0) or a frame of boxes as deep as the column is wide.

    Parameters
    ----------
    frame : RockingFrame
    cap : Cap
        It overhangs each column by one half width. Mass ratio 0 has none.
    time_step : float
        s; at most half the time constant, above which MuJoCo softens the contact.
    time_constant, damping_ratio : float
        Of the spring and damper of a contact (MuJoCo's `solref`), in s and of critical damping.
    friction : float
        Coefficient μ of all contacts.

    Raises
    ------
    ValueError
        For a time step that is too long.
    """

    frame: RockingFrame
    cap: Cap
    time_step: float
    time_constant: float
    damping_ratio: float = 1.0
    friction: float = 1.0

    def __post_init__(self) -> None:
        if not 0.0 < self.time_step <= 0.5 * self.time_constant:
            raise ValueError(
                f"time_step is {self.time_step:.6g} s; expected it in (0, "
                f"{0.5 * self.time_constant:.6g}], half the contact's time constant"
            )

    @property
    def axes(self) -> list[float]:
        """Horizontal positions of the columns' axes at rest, m."""
        return [-0.5 * self.cap.span, 0.5 * self.cap.span] if self.frame.mass_ratio else [0.0]

    def model(self) -> mujoco.MjModel:
        """Return the model of the engine: columns from left to right, then the cap beam."""
        b, h = self.frame.column.half_width, self.frame.column.half_height
        columns = [f"column{i}" for i in range(len(self.axes))]
        bodies = [self._box(name, b, h, COLUMN_MASS) for name in columns]
        pairs = [("ground", name) for name in columns]
        if self.frame.mass_ratio:
            mass = 2.0 * COLUMN_MASS * self.frame.mass_ratio
            bodies.append(
                self._box("cap", 0.5 * self.cap.span + 2.0 * b, self.cap.half_depth, mass)
            )
            pairs += [(name, "cap") for name in columns]
        contact = (self.friction, self.time_constant, self.damping_ratio)
        return compiled(bodies, pairs, self.time_step, *contact)

    def _box(self, name: str, length: float, height: float, mass: float) -> str:
        """Return a body by its half sides; it touches only the bodies that a pair names."""
        slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 0 1"))
        joint = f'{slides}<joint type="hinge" axis="0 1 0"/>'
        size = f"{length} {self.frame.column.half_width} {height}"
        return (
            f'<body name="{name}">{joint}<geom name="{name}" type="box" size="{size}"'
            f' mass="{mass}" contype="0" conaffinity="0"/></body>'
        )

    def pose(self, rotation: float = 0.0) -> np.ndarray:
        """Return coordinates of the engine with all columns rotated by θ and the cap beam level."""
        b, h = self.frame.column.half_width, self.frame.column.half_height
        sine, cosine = math.sin(abs(rotation)), math.cos(rotation)
        across, up = math.copysign(h * sine + b * (1.0 - cosine), rotation), h * cosine + b * sine
        places = [(axis + across, up, rotation) for axis in self.axes]
        if self.frame.mass_ratio:
            places.append((2.0 * across, 2.0 * up + self.cap.half_depth, 0.0))
        return np.ravel(places)


def compiled(bodies, pairs, time_step, friction, time_constant, damping_ratio) -> mujoco.MjModel:
    """Return a model of bodies above the ground, of which the pairs named touch each other."""
    contact = (
        f'condim="3" friction="{friction} {friction} 0 0 0" solimp="{IMPEDANCE} {IMPEDANCE} 0.001'
        f' 0.5 1" solref="{time_constant} {damping_ratio}"'
    )
    contacts = "".join(f'<pair geom1="{one}" geom2="{two}" {contact}/>' for one, two in pairs)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="{time_step}" gravity="0 0 {-STANDARD_GRAVITY}"'
        f' integrator="Euler" solver="Newton" tolerance="1e-12" cone="elliptic"'
        f' impratio="{FRICTION_IMPEDANCE}"/><worldbody>'
        '<geom name="ground" type="plane" size="1 1 1" contype="0" conaffinity="0"/>'
        f"{''.join(bodies)}</worldbody><contact>{contacts}</contact></mujoco>"
    )


def shake(boxes, pulse=None, *, rotation=0.0, duration, ends=None) -> np.ndarray:
    """Release boxes from rest, rotated by θ, shake them, and return θ (rad) after each step.

    θ is that of the left column. `ends` takes the rotation up to now and says whether the run may
    end before its duration.

    Raises
    ------
    ArithmeticError
        When the engine warns of an unreliable solution.
    """
    model = boxes.model()
    data = mujoco.MjData(model)
    data.qpos[:] = boxes.pose(rotation)
    steps = math.ceil(duration / boxes.time_step)
    middles = (np.arange(steps) + 0.5) * boxes.time_step
    push = np.zeros(steps) if pulse is None else -STANDARD_GRAVITY * pulse.excitation(middles)
    gravity, angles = model.opt.gravity, np.empty(steps)
    for step in range(steps):
        gravity[0] = push[step]
        mujoco.mj_step(model, data)
        angles[step] = data.qpos[2]
        if ends and step % INTERVAL == INTERVAL - 1 and ends(angles[: step + 1]):
            angles = angles[: step + 1]
            break
    if data.warning.number.any():
        raise ArithmeticError(f"{boxes}: MuJoCo warns after {len(angles)} steps")
    return angles


def overturns(boxes: Boxes, pulse: Pulse) -> bool:
    """Return whether a pulse overturns boxes: a column inclined by π/3.

    They survive if they come to rest after the pulse, and after two impacts without the pulse, as
    each takes energy.

    Raises
    ------
    ArithmeticError
        When neither happens within 20/p̂ after the pulse.
    """
    alpha, scale = boxes.frame.slenderness, 1.0 / boxes.frame.frequency_parameter
    forced = math.ceil(pulse.duration / boxes.time_step)
    steps = round(0.1 * scale / boxes.time_step)

    def survives(angles: np.ndarray) -> bool:
        free = angles[forced:]
        if free.size < 2:
            return False
        last = free[-min(free.size, steps) :]
        still = np.abs(last).max() < 0.005 * alpha and np.ptp(last) < 1e-4 * alpha
        swings = free[np.abs(free) > 0.01 * alpha]
        return bool(still or (np.diff(np.sign(swings)) != 0).sum() >= 2)

    def ends(angles: np.ndarray) -> bool:
        return abs(angles[-1]) > OVERTURNED or survives(angles)

    angles = shake(boxes, pulse, duration=pulse.duration + WAIT * scale, ends=ends)
    if abs(angles[-1]) > OVERTURNED:
        return True
    if not survives(angles):
        raise ArithmeticError(f"{pulse}: no outcome {WAIT * scale:.6g} s after its end")
    return False


def rebound(boxes: Boxes, rotation: float, duration: float) -> float:
    """Return the ratio of velocities across the first impact after a release from rest at θ > 0.

    Energy is kept between impacts, so that it is the root of the ratio of the rise of the centres
    of gravity at the peak after the impact to that at the release.

    Raises
    ------
    ArithmeticError
        When there is no impact within the duration (s).
    """
    angles = shake(boxes, rotation=rotation, duration=duration)
    after = int(np.argmax(angles <= 0.0))
    if after == 0:
        raise ArithmeticError(f"no impact within {duration:.6g} s; expected one")
    peak = np.abs(angles[after:]).max()
    b, h = boxes.frame.column.half_width, boxes.frame.column.half_height
    rise = [b * math.sin(angle) - h * (1.0 - math.cos(angle)) for angle in (peak, rotation)]
    return math.sqrt(rise[0] / rise[1])
