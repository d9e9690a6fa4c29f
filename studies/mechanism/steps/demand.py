"""What the contacts of a rocking frame have to give over a whole history, impacts included."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from steps.shared.histories import History
from topheavy import Cap, RockingFrame, contact_forces, impact_impulses

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Demand:
    """The largest friction demand and the least vertical reaction of the four contacts.

    Reactions are over the weight of the frame, impulses over their sum at the two bases; errors are
    what twice as many samples change. NaN where nothing moved, or nothing collided.
    """

    friction: float
    friction_error: float
    least: float
    least_error: float
    impact_friction: float
    impact_least: float
    impacts: int
    outcome: str

    @property
    def whole(self) -> float:
        """The friction demand of the whole history, impacts included."""
        return float(np.fmax(self.friction, self.impact_friction))

    @property
    def pulls(self) -> bool:
        """Whether a contact would have to pull, in motion or at an impact."""
        return self.least < 0.0 or self.impact_least < 0.0


def impact_demand(frame: RockingFrame, cap: Cap) -> tuple[float, float]:
    """Return the friction demand of an impact and the least vertical impulse.

    The impulse is over that of both bases. Neither depends on the velocity of the impact.
    """
    impulses = impact_impulses(frame, cap, 1.0)
    feet = impulses.base_left.vertical + impulses.base_right.vertical
    return float(impulses.friction_demand), float(impulses.least_vertical / feet)


def demand(frame: RockingFrame, cap: Cap, course: History) -> Demand:
    """Return what a history asks of the contacts."""
    forces = contact_forces(frame, cap, course.rotation, course.velocity, course.ground)
    friction, least = forces.friction_demand, forces.least_vertical
    moving = np.isfinite(least)
    if not moving.any():
        return Demand(*[math.nan] * 6, 0, course.outcome)
    largest, coarse = (np.nanmax(part, initial=0.0) for part in (friction, friction[:, ::2]))
    lowest, rough = (np.nanmin(part, initial=math.inf) for part in (least, least[:, ::2]))
    collides = impact_demand(frame, cap) if course.impacts else (math.nan, math.nan)
    return Demand(
        float(largest),
        _apart(largest, coarse),
        float(lowest),
        _apart(lowest, rough),
        *collides,
        course.impacts,
        course.outcome,
    )


def _apart(fine: float, coarse: float) -> float:
    return 0.0 if fine == coarse else abs(float(fine - coarse))
