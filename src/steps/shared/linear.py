"""The exact solution of the linearised motion, piece by piece: a check of every solver.

On one side and one segment of the ground motion (Allen et al. 1986; Housner 1963)

    φ(t) = α + s κ a(t) + C₁ exp(pτ) + C₂ exp(−pτ),    κ = 1/(1 + (ω/p)²)

for a sine or cosine of ω; κ = 1 for a straight line. The bounds of φ̈ on the segment give
a time before which neither an impact nor a turning point can occur. The solution advances by such
times, which converge to the event.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from topheavy.bodies.response import Response
from topheavy.bodies.structures import RockingBlock, Structure, as_block
from topheavy.ground.excitation import Excitation, Segment, zero_acceleration
from topheavy.ground.pulses import Pulse
from topheavy.ground.shapes import ELEMENTARY
from topheavy.ground.vertical import with_vertical
from topheavy.second import motion
from topheavy.second.motion import Arc, Event, Motion

_TURNED = 1e-10  # φ̇/αp below which a turning point is reached: φ is off by its square
_NUDGE = 1e-6  # 1/p: the step across a turning point, over which φ changes by its square
_MOST_MARCHES = 100_000
"""Of a flight in one segment. Towards a turn φ̇ shrinks by a factor each time, which the bounds of φ̈
make; towards an impact the time left does. A hundred are many."""


def simulate_linear_exact(
    structure: Structure,
    excitation: Excitation | None = None,
    *,
    rotation: float = 0.0,
    velocity: float = 0.0,
    duration: float | None = None,
    samples: int | ArrayLike = 1000,
) -> Response:
    """Return the linearised response in exact form; parameters as of `topheavy.simulate`.

    Raises
    ------
    ValueError
        For a block that is not linearised, a pulse that is not `ELEMENTARY`, and as `simulate`.
    """
    block = as_block(structure)
    if not block.linearised:
        raise ValueError("the block is not linearised; expected block.linear()")
    pulse = excitation if isinstance(excitation, Pulse) else None
    if pulse is not None and pulse.shape not in ELEMENTARY:
        raise ValueError(
            f"shape is {pulse.shape!r}, which has no elementary solution; "
            f"expected one of {', '.join(ELEMENTARY)}"
        )
    return motion.respond(
        block,
        with_vertical(excitation, None),
        partial(_fly, pulse),
        rotation=rotation,
        velocity=velocity,
        duration=duration,
        samples=samples,
    )


Ground = Callable[[ArrayLike], tuple[Any, Any]]


@dataclass(frozen=True)
class _Course:
    """The closed form of (φ, φ̇) from `start` on, of a block with this α and p on one side."""

    start: float
    alpha: float
    p: float
    side: int
    growing: float  # C₁
    fading: float  # C₂
    ground: Ground  # κ (a, ȧ)

    def __call__(self, t: ArrayLike) -> NDArray[np.float64]:
        """Return (φ, φ̇) at the time(s) t."""
        push, slope = self.ground(t)
        tau = np.subtract(t, self.start)
        up = self.growing * np.exp(self.p * tau)
        down = self.fading * np.exp(-self.p * tau)
        return np.array(
            [self.alpha + self.side * push + up + down, self.side * slope + self.p * (up - down)]
        )


def _ground(pulse: Pulse | None, block: RockingBlock, segment: Segment) -> Ground:
    """Return what the ground adds to the solution on a segment: t ↦ κ (a, ȧ)."""
    if pulse is None or pulse.shape == "constant" or segment.acceleration is zero_acceleration:
        first = segment.acceleration(segment.start)
        rise = segment.acceleration(segment.stop) - first
        incline = rise / (segment.stop - segment.start)
        return lambda t: (first + incline * np.subtract(t, segment.start), incline)
    omega = pulse.angular_frequency
    amplitude = pulse.amplitude / (1.0 + (omega / block.frequency_parameter) ** 2)
    if pulse.shape == "one-cosine":
        return lambda t: (
            amplitude * np.cos(np.multiply(omega, t)),
            -amplitude * omega * np.sin(np.multiply(omega, t)),
        )
    if pulse.shape not in ("one-sine", "half-sine", "harmonic"):
        raise ValueError(f"shape is {pulse.shape!r}, which has no exact solution here")
    return lambda t: (
        amplitude * np.sin(np.multiply(omega, t)),
        amplitude * omega * np.cos(np.multiply(omega, t)),
    )


def _fly(
    pulse: Pulse | None,
    block: RockingBlock,
    segment: Segment,
    stop: float,
    course: Motion,
    possible: bool,
) -> Event | None:
    """March on one side to `stop`, or to the impact or fall that comes first."""
    alpha, p, side, begin = block.slenderness, block.frequency_parameter, course.side, course.time
    ground = _ground(pulse, block, segment)
    push, slope = ground(begin)
    offset = course.rotation - alpha - side * push
    speed = (course.rate - side * slope) / p
    exact = _Course(begin, alpha, p, side, (offset + speed) / 2, (offset - speed) / 2, ground)

    ends = (side * segment.acceleration(begin), side * segment.acceleration(stop))
    event, marches = None, 0
    while course.time < stop and event is None:
        marches += 1
        if marches > _MOST_MARCHES:
            raise ArithmeticError(
                f"{block}: {_MOST_MARCHES} marches from {begin:.6g} s end at {course.time:.6g} s, "
                f"with no event before {stop:.6g} s; a shorter duration may help"
            )
        phi, rate = course.rotation, course.rate
        rising = rate >= 0.0
        # Bounds of φ̈ = p² (φ − α − s a) as long as φ rises, or falls, give the earliest turn.
        bound = p * p * (alpha - phi + max(ends) if rising else phi - alpha - min(ends))
        ahead = abs(rate) / bound if bound > 0.0 else math.inf
        if bound > 0.0 and abs(rate) <= _TURNED * alpha * p:
            ahead = max(ahead, _NUDGE / p)
        if possible and not rising:
            earliest = _earliest_impact(phi, rate, p * p * (alpha + max(ends)))
            if earliest <= 4.0 * math.ulp(course.time):
                event = Event.IMPACT
                break
            ahead = min(ahead, earliest)
        time = min(stop, course.time + ahead)
        if phi < course.ceiling < exact(time)[0]:
            event = Event.FALL
            time = brentq(lambda t: exact(t)[0] - course.ceiling, course.time, time)
        course.time = time
        course.rotation, course.rate = (float(value) for value in exact(time))
        course.height = max(course.height, course.rotation)
        course.peak = max(course.peak, course.height)
    course.rotation = max(course.rotation, 0.0)
    course.arcs.append(Arc(begin, course.time, side, exact))
    return event


def _earliest_impact(phi: float, rate: float, slowing: float) -> float:
    """Return a time before which φ cannot reach 0, given φ̈ ≥ −slowing and φ̇ ≤ 0."""
    if phi <= 0.0:
        return 0.0
    return 2.0 * phi / (math.sqrt(rate**2 + 2.0 * max(slowing, 0.0) * phi) - rate)
