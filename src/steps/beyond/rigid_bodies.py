"""Columns and a cap beam in MuJoCo, a general rigid-body engine, in space or in a plane.

The engine knows bodies, contact and friction. It has no rocking-specific equations: no common
rotation, no pivots, no level cap beam, no √r. The ground is fixed, and an inertial force represents
its motion: gravity becomes (−ü_x, −ü_y, −g).

Contacts are compliant: a spring and a damper, critically damped, with a time constant of a few time
steps. If both decrease together, the limit is the rigid structure.
"""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.metadata import version
from itertools import product

import mujoco
import numpy as np

from replication.job import stop
from steps.beyond.inclinations import WAIT, overturn
from topheavy import STANDARD_GRAVITY, Cap, Column, Pulse

PACKAGE, OLDEST = "mujoco-core", "4.0.1"
IMPEDANCE = 0.95  # share of the force of the ideal contact (MuJoCo's `solimp`)
FRICTION_IMPEDANCE = 10.0  # hardness of friction, times that of the normal force, against creep
SPHERE = 0.02  # radius of a sphere, times the column's half width
ON_A_RIM = 16  # spheres around a round column; edges between them lie along and across the plane
CONTACT = 4.0  # time constant of a contact, in time steps; MuJoCo softens contacts below 2
FREE_JOINT = "<freejoint/>"
PLANAR_JOINTS = (
    '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>'
    '<joint type="hinge" axis="0 1 0"/>'
)
LOOK = 20  # time steps between looks


def checked_version() -> str:
    """Return the engine's name and version, or stop if its module is not its package's, or too old.

    Before 3.12, √r of frames was 0.01 to 0.03 off; 4.0.0 factorises sparse matrices wrongly.
    """
    module, package = mujoco.__version__, version(PACKAGE)
    mend = f"expected {PACKAGE} {OLDEST} or newer: uv sync --reinstall-package {PACKAGE}"
    if module != package:
        stop(
            f"the module mujoco is {module}, and the installed {PACKAGE} is {package}: another "
            f"package, such as mujoco, has written into its folder. Uninstall that; {mend}"
        )
    number, oldest = (tuple(map(int, re.findall(r"\d+", text)[:3])) for text in (module, OLDEST))
    if number < oldest:
        stop(f"MuJoCo is {module}, in which the impacts of frames are not reliable; {mend}")
    return f"MuJoCo {module}"


@dataclass(frozen=True)
class Bodies:
    """Columns that stand alone, with the cap fixed on top, or under a free cap beam or slab.

    Parameters
    ----------
    column : Column
        Its half width is along the plane, and the radius of a round one; `half_depth` is across.
    mass_ratio : float
        γ, the cap's mass over that of all columns; 0 has no cap.
    cap : Cap
        Above several columns it overhangs the outer ones by one half width.
    time_step : float
        Over 1/p of the column.
    in_row, rows : int
        Columns in a plane, and planes that share the slab, a span apart.
    is_planar : bool
        Bodies of one row stay in its plane, and touch as boxes. In space, with six degrees of
        freedom each, spheres at corners or around rims make contact.
    is_round, is_fixed : bool
        Columns are round; the cap is fixed to the one column. Both only in space.
    friction : float
        Coefficient μ of all contacts.
    gaps : array, shape (columns, contacts of an end, 2), optional
        How far each sphere of base and top lies back, m.
    """

    column: Column
    half_depth: float
    mass_ratio: float
    cap: Cap
    time_step: float
    in_row: int = 2
    rows: int = 1
    is_planar: bool = False
    is_round: bool = False
    is_fixed: bool = False
    friction: float = 5.0
    gaps: np.ndarray | None = None

    @property
    def contacts(self) -> list[tuple[float, float]]:
        """Positions of the spheres of one end from the axis of the column, m."""
        b, d = self.column.half_width, self.half_depth
        if self.is_planar:
            return []
        if not self.is_round:
            return [(x * b, y * d) for x in (-1, 1) for y in (-1, 1)]
        angles = (np.arange(ON_A_RIM) + 0.5) * 2.0 * math.pi / ON_A_RIM
        return [(b * math.cos(angle), b * math.sin(angle)) for angle in angles]

    @property
    def axes(self) -> list[tuple[float, float]]:
        """Positions of the columns at rest, m."""
        x, y = (
            [self.cap.span * (i - 0.5 * (count - 1)) for i in range(count)]
            for count in (self.in_row, self.rows)
        )
        return [*product(x, y)]

    @property
    def seconds(self) -> float:
        """The time step, s."""
        return 1.0 / self.column.frequency_parameter * self.time_step

    def pose(self, rotation: float = 0.0) -> np.ndarray:
        """Return the planar engine's coordinates with columns rotated by θ and the cap level."""
        b, h = self.column.half_width, self.column.half_height
        sine, cosine = math.sin(abs(rotation)), math.cos(rotation)
        shift, rise = math.copysign(h * sine + b * (1.0 - cosine), rotation), h * cosine + b * sine
        places = [(x + shift, rise, rotation) for x, _ in self.axes]
        if self.mass_ratio:
            places.append((2.0 * shift, 2.0 * rise + self.cap.half_depth, 0.0))
        return np.ravel(places)

    def model(self) -> mujoco.MjModel:
        """Return the model of the engine: the columns, then the cap beam if it is free."""
        b, h, d = self.column.half_width, self.column.half_height, self.cap.half_depth
        gaps = np.zeros((len(self.axes), len(self.contacts), 2)) if self.gaps is None else self.gaps
        free_cap = self.mass_ratio > 0.0 and not self.is_fixed
        quiet, radius = 'contype="0" conaffinity="0"', SPHERE * b
        joint = PLANAR_JOINTS if self.is_planar else FREE_JOINT
        section = f'"cylinder" size="{b} {h}"'
        if not self.is_round:
            section = f'"box" size="{b} {self.half_depth} {h}"'
        bodies, pairs = [], []
        for i, (x, y) in enumerate(self.axes):
            parts = f'<geom name="column{i}" type={section} mass="1" {quiet}/>'
            if self.is_planar:
                pairs += [(f"column{i}", face) for face in ("ground", "cap")[: 1 + free_cap]]
            if self.is_fixed:
                place = f'pos="0 0 {h + d}" size="{b} {self.half_depth} {d}"'
                parts += f'<geom type="box" {place} mass="{self.mass_ratio}" {quiet}/>'
            for j, (along, across) in enumerate(self.contacts):
                for end, face in ((-1, "ground"), (1, "cap"))[: 1 + free_cap]:
                    name = f"{face}{i}_{j}"
                    z = end * (h - radius - gaps[i, j, (end + 1) // 2])
                    place = f'size="{radius}" pos="{along} {across} {z}" mass="0"'
                    parts += f'<geom name="{name}" type="sphere" {place} {quiet}/>'
                    pairs.append((face, name))
            place = "" if self.is_planar else f'pos="{x} {y} {h}"'
            bodies.append(f"<body {place}>{joint}{parts}</body>")
        if free_cap:
            length, width = (
                0.5 * self.cap.span * (n - 1) + 2.0 * b if n > 1 else self.half_depth + radius
                for n in (self.in_row, self.rows)
            )
            size = f'size="{length} {width} {d}" mass="{self.mass_ratio * len(self.axes)}"'
            cap = f'<geom name="cap" type="box" {size} {quiet}/>'
            place = "" if self.is_planar else f'pos="0 0 {2.0 * h + d}"'
            bodies.append(f"<body {place}>{joint}{cap}</body>")
        contact = (
            f'condim="3" friction="{self.friction} {self.friction} 0 0 0" solimp="{IMPEDANCE}'
            f' {IMPEDANCE} 0.001 0.5 1" solref="{CONTACT * self.seconds} 1"'
        )
        contacts = "".join(f'<pair geom1="{a}" geom2="{b}" {contact}/>' for a, b in pairs)
        return mujoco.MjModel.from_xml_string(
            f'<mujoco><option timestep="{self.seconds}" gravity="0 0 {-STANDARD_GRAVITY}"'
            f' integrator="Euler" solver="Newton" tolerance="1e-12" cone="elliptic"'
            f' impratio="{FRICTION_IMPEDANCE}"/><worldbody>'
            f'<geom name="ground" type="plane" size="1 1 1" {quiet}/>'
            f"{''.join(bodies)}</worldbody><contact>{contacts}</contact></mujoco>"
        )


def motion(
    bodies: Bodies,
    ground: Callable,
    duration: float,
    direction: float = 0.0,
    rotation: float = 0.0,
    look: int = LOOK,
) -> Iterator[tuple[float, np.ndarray]]:
    """Yield times and the columns' rotation matrices while the ground accelerates.

    The ground's acceleration (g) is a function of times (s); its direction is measured from the
    plane of the frame, in degrees. Bodies start from rest, and the columns of planar ones rotated
    by θ. Rotations are those at the beginning of every `look`-th time step. A warning of the engine
    raises ArithmeticError.
    """
    model = bodies.model()
    data, columns = mujoco.MjData(model), 1 + len(bodies.axes)
    if bodies.is_planar:
        data.qpos[:] = bodies.pose(rotation)
    times = (np.arange(math.ceil(duration / bodies.seconds)) + 0.5) * bodies.seconds
    towards = np.array([math.cos(math.radians(direction)), math.sin(math.radians(direction))])
    pushes = -STANDARD_GRAVITY * np.outer(ground(times), towards)
    gravity, step = model.opt.gravity[:2], mujoco.mj_step
    for begin in range(0, len(times) - look + 1, look):
        part = pushes[begin : begin + look]
        if part.any():
            for push in part:
                gravity[:] = push
                step(model, data)
        else:
            gravity[:] = 0.0
            step(model, data, look)
        if data.warning.number.any():
            raise ArithmeticError(f"{bodies}: MuJoCo warns after {begin + look} steps")
        yield times[begin + look - 1], data.xmat[1:columns].reshape(-1, 3, 3).copy()


def overturns(bodies: Bodies, pulse: Pulse, direction: float = 0.0) -> bool:
    """Return whether a pulse overturns a column."""
    duration = pulse.duration + WAIT / bodies.column.frequency_parameter
    looks = motion(bodies, pulse.excitation, duration, direction)
    inclined = ((time, math.acos(min(1.0, turned[:, 2, 2].min()))) for time, turned in looks)
    return overturn(inclined, bodies.column, pulse)


def released(bodies: Bodies, rotation: float, duration: float) -> np.ndarray:
    """Return θ (rad) of the left of planar columns in each time step after a release at θ."""
    duration += bodies.seconds  # as rotations are those at the beginning of a step
    looks = motion(bodies, np.zeros_like, duration, rotation=rotation, look=1)
    return np.array([math.atan2(*turned[0, [0, 2], 2]) for _, turned in looks])
