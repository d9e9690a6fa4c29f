"""Columns and a cap beam in space in MuJoCo; spheres at corners or around rims make contact.

Each body has six degrees of freedom, or the cap is fixed to the one column. The ground is fixed,
and gravity becomes (−ü_x, −ü_y, −g).
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product

import mujoco
import numpy as np

from steps.beyond.boxes import OVERTURNED, compiled
from topheavy import STANDARD_GRAVITY, Cap, Column, Pulse

SPHERE = 0.02  # radius over the column's half width
ON_A_RIM = 16  # spheres around a round column; edges between them lie along and across the plane
CONTACT = 4.0  # time steps in the time constant of a contact, which has critical damping
LOOK = 20  # time steps between looks
WAIT, REST = 14.0, 0.5  # over p: the longest wait for an outcome, and how long rest has to last
UPRIGHT = 0.05  # inclination over α


@dataclass(frozen=True)
class Bodies:
    """Columns that stand alone, with the cap fixed on top, or under a free cap beam or slab.

    Parameters
    ----------
    column : Column
        Its half width is along the plane, and the radius of a round one; `half_depth` is across.
    mass_ratio : float
        γ, the cap's mass over that of all columns; 0 has no cap.
    time_step : float
        Over 1/p of the column.
    in_row, rows : int
        Columns in a plane, and planes that share the slab, a span apart.
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
    is_round: bool = False
    is_fixed: bool = False
    friction: float = 5.0
    gaps: np.ndarray | None = None

    @property
    def contacts(self) -> list[tuple[float, float]]:
        """Positions of the spheres of one end from the axis of the column, m."""
        b, d = self.column.half_width, self.half_depth
        if not self.is_round:
            return [(x * b, y * d) for x in (-1, 1) for y in (-1, 1)]
        angles = (np.arange(ON_A_RIM) + 0.5) * 2.0 * math.pi / ON_A_RIM
        return [(b * math.cos(angle), b * math.sin(angle)) for angle in angles]

    @property
    def axes(self) -> list[tuple[float, float]]:
        """Positions of the columns at rest, m."""
        counts = self.in_row, self.rows
        return [
            *product(*([self.cap.span * (i - 0.5 * (n - 1)) for i in range(n)] for n in counts))
        ]

    @property
    def seconds(self) -> float:
        """The time step, s."""
        return self.time_step / self.column.frequency_parameter

    def model(self) -> mujoco.MjModel:
        """Return the model of the engine: the columns, then the cap beam if it is free."""
        b, h, d = self.column.half_width, self.column.half_height, self.cap.half_depth
        gaps = np.zeros((len(self.axes), len(self.contacts), 2)) if self.gaps is None else self.gaps
        free_cap = self.mass_ratio > 0.0 and not self.is_fixed
        quiet, radius = 'contype="0" conaffinity="0"', SPHERE * b
        section = f'"cylinder" size="{b} {h}"'
        if not self.is_round:
            section = f'"box" size="{b} {self.half_depth} {h}"'
        bodies, pairs = [], []
        for i, (x, y) in enumerate(self.axes):
            parts = f'<geom type={section} mass="1" {quiet}/>'
            if self.is_fixed:
                place = f'pos="0 0 {h + d}" size="{b} {self.half_depth} {d}"'
                parts += f'<geom type="box" {place} mass="{self.mass_ratio}" {quiet}/>'
            for j, (along, across) in enumerate(self.contacts):
                for end, other in ((-1, "ground"), (1, "cap"))[: 1 + free_cap]:
                    name = f"{other}{i}_{j}"
                    z = end * (h - radius - gaps[i, j, (end + 1) // 2])
                    place = f'size="{radius}" pos="{along} {across} {z}" mass="0"'
                    parts += f'<geom name="{name}" type="sphere" {place} {quiet}/>'
                    pairs.append((other, name))
            bodies.append(f'<body pos="{x} {y} {h}"><freejoint/>{parts}</body>')
        if free_cap:
            length, width = (
                0.5 * self.cap.span * (n - 1) + 2.0 * b if n > 1 else self.half_depth + radius
                for n in (self.in_row, self.rows)
            )
            size = f'size="{length} {width} {d}" mass="{self.mass_ratio * len(self.axes)}"'
            cap = f'<geom name="cap" type="box" {size} {quiet}/>'
            bodies.append(f'<body pos="0 0 {2.0 * h + d}"><freejoint/>{cap}</body>')
        contact = (self.friction, CONTACT * self.seconds, 1)
        return compiled(bodies, pairs, self.seconds, *contact)


def motion(
    bodies: Bodies, ground: Callable, duration: float, direction: float = 0.0
) -> Iterator[tuple[float, np.ndarray]]:
    """Yield times and the columns' rotation matrices while the ground accelerates.

    The ground's acceleration (g) is a function of times (s); its direction is measured from the
    plane of the frame, in degrees. A warning of the engine raises ArithmeticError.
    """
    model = bodies.model()
    data, columns = mujoco.MjData(model), 1 + len(bodies.axes)
    times = (np.arange(math.ceil(duration / bodies.seconds)) + 0.5) * bodies.seconds
    towards = np.array([math.cos(math.radians(direction)), math.sin(math.radians(direction))])
    pushes = -STANDARD_GRAVITY * np.outer(ground(times), towards)
    for step, push in enumerate(pushes):
        model.opt.gravity[:2] = push
        mujoco.mj_step(model, data)
        if step % LOOK == LOOK - 1:
            if data.warning.number.any():
                raise ArithmeticError(f"{bodies}: MuJoCo warns after {step} steps")
            yield times[step], data.xmat[1:columns].reshape(-1, 3, 3).copy()


def overturns(bodies: Bodies, pulse: Pulse, direction: float = 0.0) -> bool:
    """Return whether a pulse inclines a column by π/3.

    Bodies survive that rest after the pulse, that return to upright twice without it, as each
    impact takes energy, and that still rock 14/p after it.
    """
    alpha, p = bodies.column.slenderness, bodies.column.frequency_parameter
    duration, looks = pulse.duration + WAIT / p, REST / (LOOK * bodies.time_step)
    returns, rest = 0, 0
    for time, rotation in motion(bodies, pulse.excitation, duration, direction):
        cosine = rotation[:, 2, 2].min()
        if cosine < math.cos(OVERTURNED):
            return True
        if time > pulse.duration:
            upright = cosine > math.cos(UPRIGHT * alpha)
            returns += upright and rest == 0
            rest = rest + 1 if upright else 0
            if returns > 2 or rest > looks:
                break
    return False
