"""What the contacts of a rocking frame have to give over a whole history, impacts included."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from topheavy import Cap, Pulse, Record, RockingFrame, contact_forces, impact_impulses, simulate

Array = NDArray[np.float64]

SCAN = 513  # times in a scan for the point of no return, three times over
ASIDE = 1e-9  # over p: so near to an impact is each side of it looked at
CHUNKS = 4.0  # of a period of a pulse: pieces of an arc in which the forces turn at most once or so


@dataclass(frozen=True, eq=False)
class History:
    """Arcs between impacts and other kinks, each with as many samples, shape (arcs, samples).

    `outcome` is that of `simulate`, `impacts` the number of them in the arcs.
    """

    time: Array
    rotation: Array
    velocity: Array
    ground: Array
    impacts: int
    outcome: str


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


def history(frame: RockingFrame, excitation: Pulse | Record, samples: int) -> History:
    """Return a whole history; one that overturns up to where |θ| passes α for good.

    Each arc holds both its ends and 2·samples − 1 times between them, evenly.
    """
    found = simulate(frame, excitation, samples=2)
    if isinstance(excitation, Pulse):
        step = 2.0 * math.pi / excitation.angular_frequency / CHUNKS
    else:
        step = excitation.time_step
    end = excitation.duration if found.outcome == "no uplift" else found.time[-1]
    if found.outcome == "overturned":
        end = _point_of_no_return(frame, excitation, end)
    kinks = np.arange(round(excitation.duration / step) + 1) * step
    knots = np.concatenate([kinks, found.impacts])
    knots = np.unique(np.append(knots[knots < end], end))
    aside = ASIDE / frame.frequency_parameter
    knots = knots[np.append(True, np.diff(knots) > 4.0 * aside)]
    time = np.linspace(knots[:-1] + aside, knots[1:] - aside, 2 * samples + 1, axis=1)
    motion = simulate(frame, excitation, samples=time.ravel())
    return History(
        time,
        motion.rotation.reshape(time.shape),
        motion.velocity.reshape(time.shape),
        excitation.excitation(time.ravel()).reshape(time.shape),
        int((found.impacts < end).sum()),
        found.outcome,
    )


def _point_of_no_return(frame: RockingFrame, excitation: Pulse | Record, end: float) -> float:
    """Return the last time at which |θ| passes α on the way to overturning, s."""
    first = 0.0
    for _ in range(3):
        times = np.linspace(first, end, SCAN)
        rotation = simulate(frame, excitation, samples=times).rotation
        last = np.flatnonzero(np.abs(rotation) <= frame.slenderness)[-1]
        first, end = times[last], times[min(last + 1, SCAN - 1)]
    return float(first)


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
