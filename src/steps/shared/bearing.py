"""What the ground has to bear while a monolithic portal rocks about one corner.

The model holds the corner down. Ground without tension does not: where the bearing base would be
pulled, the portal leaves the ground, and nothing that the model says of such a motion is quoted.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from steps.shared.histories import History, history
from topheavy import MonolithicPortal, Pulse, Record, Response, rocking_portal_forces, simulate

AMPLITUDES = 160
"""From uplift to the minimum overturning acceleration: at these the base is looked at."""

HALVINGS = 30
"""Of the interval between two of them in which the base begins to be pulled."""

SAMPLES = 24
"""Of a quarter of an arc, as `History` has them."""


def on_the_ground(portal: MonolithicPortal, course: History) -> tuple[float, float]:
    """Return the least normal force (over the weight) and the largest required friction.

    Of a history in which the portal rocks. The friction is that of the instants without tension.
    """
    base = rocking_portal_forces(portal, course.rotation, course.velocity, course.ground).base
    along, across = base.axial.sum(axis=-1), base.shear.sum(axis=-1)  # one column bears all
    cos, sin = np.cos(course.rotation), np.sin(course.rotation)
    normal, tangential = along * cos - across * sin, np.abs(across * cos + along * sin)
    friction = tangential / np.where(normal > 0.0, normal, np.nan)
    return float(np.nanmin(normal, initial=math.inf)), float(np.nanmax(friction, initial=0.0))


@dataclass(frozen=True)
class Bearing:
    """What the base of a portal bears under a pulse, up to a peak acceleration.

    `pulled_from` is the lowest peak acceleration (g) at which it is pulled, infinite if there is
    none; `friction` the largest coefficient that the motions below both require.
    """

    pulled_from: float
    friction: float


def bearing(
    portal: MonolithicPortal,
    pulse: Pulse | Record,
    highest: float,
    route: Callable[..., Response] = simulate,
    amplitudes: int = AMPLITUDES,
) -> Bearing:
    """Return what the base bears in the motions from uplift to the highest peak, which survive.

    The pulse has a peak of 1 g; as many amplitudes are tried.
    """

    def at(peak: float) -> tuple[float, float]:
        return on_the_ground(portal, history(portal, pulse.scaled(peak), SAMPLES, route))

    friction, below = 0.0, portal.uplift_acceleration
    for peak in np.linspace(below, highest, amplitudes + 1)[1:]:
        least, required = at(float(peak))
        if least <= 0.0:
            high = float(peak)
            for _ in range(HALVINGS):
                middle = 0.5 * (below + high)
                below, high = (below, middle) if at(middle)[0] <= 0.0 else (middle, high)
            return Bearing(high, friction)
        friction, below = max(friction, required), float(peak)
    return Bearing(math.inf, friction)
