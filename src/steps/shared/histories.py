"""A whole rocking history in arcs between impacts, with samples on both sides of every jump."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from topheavy import Pulse, Response, RockingFrame, simulate

Array = NDArray[np.float64]

ASIDE = 1e-9  # time from an impact at which each side of it is computed, times 1/p
CHUNKS = 4.0  # pieces of an arc per period of a pulse: about one extremum of the forces in each


@dataclass(frozen=True, eq=False)
class History:
    """Arcs between impacts and other kinks; all arrays have the shape (arcs, samples)."""

    rotation: Array
    velocity: Array
    ground: Array
    impacts: int


def history(
    frame: RockingFrame,
    pulse: Pulse,
    response: Response,
    samples: int,
    solver: Callable[..., Response] = simulate,
) -> History:
    """Return the history of a response that does not overturn, by one of the solvers.

    Each arc holds both its ends and 2·samples − 1 times between them, evenly.
    """
    step = 2.0 * math.pi / pulse.angular_frequency / CHUNKS
    end = pulse.duration if response.outcome == "no uplift" else response.time[-1]
    kinks = np.arange(round(pulse.duration / step) + 1) * step
    knots = np.concatenate([kinks, response.impact_times])
    knots = np.unique(np.append(knots[knots < end], end))
    aside = ASIDE / frame.frequency_parameter
    knots = knots[np.append(True, np.diff(knots) > 4.0 * aside)]
    time = np.linspace(knots[:-1] + aside, knots[1:] - aside, 2 * samples + 1, axis=1)
    motion = solver(frame, pulse, samples=time.ravel())
    return History(
        motion.rotation.reshape(time.shape),
        motion.velocity.reshape(time.shape),
        pulse.excitation(time.ravel()).reshape(time.shape),
        int((response.impact_times < end).sum()),
    )
