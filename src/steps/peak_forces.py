"""The largest forces of a frame that rocks, and of the same frame held against uplift."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from steps.histories import History, history
from topheavy import (
    Cap,
    FixedFrame,
    Pulse,
    Record,
    Response,
    RockingFrame,
    frame_forces,
    peak_elastic,
    peak_rigid,
    simulate,
)
from topheavy.fixed_frame import STEPS

FORCES = ("base_shear", "overturning_moment", "bending_moment")
RIGID = "rigid"


@dataclass(frozen=True)
class Peaks:
    """Of one history of a rocking frame.

    Attributes
    ----------
    forces : dict
        The largest of each of FORCES over the weight: a shear, and moments in m. NaN if overturned.
    error : float
        How much twice as many samples change them, relative, at most.
    rotation : float
        max|θ| over α; NaN if overturned.
    impulse : float
        The largest horizontal impulse of an impact over the mass, m/s: told apart from the forces.
    outcome : str
    """

    forces: dict[str, float]
    error: float
    rotation: float
    impulse: float
    outcome: str


def rocking_peaks(
    frame: RockingFrame,
    cap: Cap,
    motion: Pulse | Record,
    samples: int,
    route: Callable[..., Response] = simulate,
) -> Peaks:
    """Return the largest forces between the impacts of a history by one of the solvers."""
    course = history(frame, motion, samples, route)
    if course.outcome == "overturned":
        nothing = dict.fromkeys(FORCES, math.nan)
        return Peaks(nothing, math.nan, math.nan, math.nan, course.outcome)
    # At rest there is less shear than at uplift, where the forces go on without a jump.
    moves = course.rotation.any(axis=1)
    arcs = moves if moves.any() else ~moves
    found = frame_forces(
        frame, cap, course.rotation[arcs], course.velocity[arcs], course.ground[arcs]
    )
    fine, coarse = ({}, {})
    for name in FORCES:
        force = np.abs(getattr(found, name))
        fine[name], coarse[name] = _largest(force), _largest(force[:, ::2])
    moved = [name for name in FORCES if fine[name] > 0.0]
    return Peaks(
        fine,
        max((1.0 - coarse[name] / fine[name] for name in moved), default=0.0),
        float(np.abs(course.rotation).max()) / frame.slenderness,
        impact_impulse(frame, course),
        course.outcome,
    )


def impact_impulse(frame: RockingFrame, course: History) -> float:
    """Return the largest horizontal impulse of an impact over the mass, m/s.

    At an impact the velocity drops from θ̇ to √r θ̇, of the columns at half the height of the cap.
    """
    arriving = np.abs(course.velocity[:, -1])
    leaving = np.append(np.abs(course.velocity[1:, 0]), np.nan)
    upright = np.abs(course.rotation[:, -1]) < 1e-6 * frame.slenderness
    drops = np.where(upright, arriving - leaving, np.nan)
    gamma = frame.mass_ratio
    share = 2.0 if gamma == math.inf else (1.0 + 2.0 * gamma) / (1.0 + gamma)
    return share * frame.column.half_height * float(np.nanmax(drops, initial=0.0))


def held_peaks(
    frames: Sequence[RockingFrame],
    cap: Cap,
    motion: Pulse | Record,
    periods: Sequence[float],
    steps: int = STEPS,
) -> list[dict[str, dict[str, float]]]:
    """Return, for each frame held against uplift, its largest forces by its period.

    `steps` are those in a period, as in `peak_elastic`.
    """
    fixed = [FixedFrame(frame, cap) for frame in frames]
    found = [{RIGID: peak_rigid(one, motion)._asdict()} for one in fixed]
    for period in periods:
        for place, forces in enumerate(peak_elastic(fixed, motion, period, steps)):
            found[place][f"{period:g} s"] = forces._asdict()
    return found


def _largest(force: np.ndarray) -> float:
    """Return the largest of the forces that are determined; 0 where none is."""
    return float(np.nanmax(force, initial=0.0))
