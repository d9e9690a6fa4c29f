"""A whole rocking history in arcs between impacts, so that both sides of every jump are seen."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from topheavy import Pulse, Record, Response, RockingFrame, simulate

Array = NDArray[np.float64]

NUDGE = 1e-9  # of a record: what no measurement resolves
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


def history(
    frame: RockingFrame,
    excitation: Pulse | Record,
    samples: int,
    route: Callable[..., Response] = simulate,
    whole: Response | None = None,
) -> History:
    """Return a whole history by one of the solvers; one that overturns up to its last |θ| = α.

    Each arc holds both its ends and 2·samples − 1 times between them, evenly. Under a record the
    arcs begin with the piece in which the ground first uplifts it. `whole` is the response from 0
    to its end, where the caller has it.
    """
    found = whole or route(frame, excitation, samples=2)
    if isinstance(excitation, Pulse):
        step = 2.0 * math.pi / excitation.angular_frequency / CHUNKS
    else:
        step = excitation.time_step
    end = excitation.duration if found.outcome == "no uplift" else found.time[-1]
    if found.outcome == "overturned":
        end = _point_of_no_return(frame, excitation, end)
    kinks = np.arange(round(excitation.duration / step) + 1) * step
    if isinstance(excitation, Record):
        lifting = np.abs(excitation.acceleration) >= frame.uplift_acceleration
        kinks = kinks[max(int(lifting.argmax()) - 1, 0) :]  # all, where none does
    knots = np.concatenate([kinks, found.impacts])
    knots = np.unique(np.append(knots[knots < end], end))
    aside = ASIDE / frame.frequency_parameter
    knots = knots[np.append(True, np.diff(knots) > 4.0 * aside)]
    time = np.linspace(knots[:-1] + aside, knots[1:] - aside, 2 * samples + 1, axis=1)
    motion = route(frame, excitation, samples=time.ravel())
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
