"""The largest forces of a frame that rocks, and of the same frame held against uplift."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from steps.shared.histories import History, history
from topheavy import (
    Cap,
    FixedFrame,
    Pulse,
    Record,
    Response,
    RockingFrame,
    base_shear_slope,
    largest_forces,
    peak_elastic,
    peak_rigid,
    simulate,
)
from topheavy.forces.fixed_frame import STEPS, Top

FORCES = ("base_shear", "overturning_moment", "bending_moment")
RIGID = "rigid"
MARGIN = 0.01  # of the base shear just after uplift: what a later one may exceed it by
PINNED: Top = "pinned"
GUIDED: Top = "guided"


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
    whole = route(frame, motion, samples=2)
    if whole.overturned:
        nothing = dict.fromkeys(FORCES, math.nan)
        return Peaks(nothing, math.nan, math.nan, math.nan, whole.outcome)
    course = history(frame, motion, samples, route, whole)
    found = largest_forces(frame, cap, course.rotation, course.velocity, course.ground)
    fine, coarse = (dict(zip(FORCES, row, strict=True)) for row in found.tolist())
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
) -> list[dict[tuple[Top, str], dict[str, float]]]:
    """Return, for each frame, the largest forces of the frames in `held`.

    `steps` are those in a period, as in `peak_elastic`.
    """
    fixed = [(place, top) for place, one in enumerate(frames) for top in tops(one.mass_ratio)]
    held = [FixedFrame(frames[place], cap, top) for place, top in fixed]
    peaks = {RIGID: [peak_rigid(one, motion) for one in held]}
    peaks |= {f"{period:g} s": peak_elastic(held, motion, period, steps) for period in periods}
    found: list[dict[tuple[Top, str], dict[str, float]]] = [{} for _ in frames]
    for name, forces in peaks.items():
        for (place, top), one in zip(fixed, forces, strict=True):
            found[place][top, name] = one._asdict()
    return found


def tops(mass_ratio: float) -> tuple[Top, ...]:
    """Return what the tops of columns held against uplift may be; without a cap beam, pinned."""
    return (PINNED, GUIDED) if mass_ratio > 0.0 else (PINNED,)


def held(mass_ratio: float, periods: Sequence[float]) -> list[tuple[Top, str]]:
    """Return the frames that a rocking one is compared with: tops, and rigid or the period."""
    names = [RIGID, *(f"{period:g} s" for period in periods)]
    return [(top, name) for top in tops(mass_ratio) for name in names]


def ratio_of(force: str, top: str, name: str) -> str:
    """Return the name of the column with a force of the rocking frame over that of a held one."""
    return f"{force}, {top}, {name}"


def shear_after_uplift(frame: RockingFrame, peak: float) -> float:
    """Return V/W of the resting frame that a ground acceleration (g) uplifts at once."""
    level = frame.uplift_acceleration
    return level + base_shear_slope(frame) * (peak - level)


def bending(ratio: pd.Series) -> dict[str, float]:
    """Count the ratios of bending moments, and those that are not below 1; add their range."""
    not_lower = int((ratio >= 1.0).sum())
    ends = {"least": float(ratio.min()), "largest": float(ratio.max())}
    return {"histories": len(ratio), "not_lower": not_lower} | ends
