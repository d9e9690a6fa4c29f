"""The rocking motion by adaptive integration with SciPy: the readable, independent solver.

Every step's interpolating polynomial is cut at its turning points into monotone arcs, so that no
impact inside a step, grazing or double, is missed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.integrate import DOP853, DenseOutput
from scipy.optimize import brentq

from topheavy import checks
from topheavy.bodies import free_rocking
from topheavy.bodies.response import Response
from topheavy.bodies.structures import RockingBlock, Structure, as_block
from topheavy.ground.excitation import Excitation, Segment, checked_excitation, sign_change
from topheavy.ground.records import Record
from topheavy.ground.vertical import with_vertical
from topheavy.second import motion
from topheavy.second.motion import Arc, Event, Motion

#: Of the integration, relative to α and αp.
TOLERANCE = 1e-11
#: SciPy raises a smaller tolerance without notice; a larger one is too coarse to follow a motion.
MIN_TOLERANCE, MAX_TOLERANCE = 1e-13, 1e-2
#: Maximum number of steps per flight and segment.
MAX_STEPS = 1_000_000
#: Over 1/p: DOP853 takes a shorter segment in one step, without a search for its first step.
MAX_ONE_STEP = 0.05

_DEGREE = 7  # of DOP853's interpolating polynomial
_NODES = chebyshev.chebpts1(_DEGREE + 1)
_TO_SERIES = np.linalg.inv(chebyshev.chebvander(_NODES, _DEGREE))
_TO_SLOPE = chebyshev.chebder(np.eye(_DEGREE + 1))  # from a series to that of its derivative


def simulate(
    structure: Structure,
    excitation: Excitation | None = None,
    *,
    rotation: float = 0.0,
    velocity: float = 0.0,
    duration: float | None = None,
    samples: int | ArrayLike = 1000,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
) -> Response:
    """Return the rocking response by SciPy; the parameters are those of `topheavy.simulate`.

    The tolerance is that of the integration, relative to α and αp. `vertical` is the vertical
    ground acceleration that starts with a record: g, positive upward.

    Raises
    ------
    ValueError
        As `topheavy.simulate`.
    ArithmeticError
        For a history of more than `motion.MAX_IMPACTS` impacts or a million steps in a flight.
    """
    block = as_block(structure)
    return motion.respond(
        block,
        with_vertical(excitation, vertical),
        _flight(tolerance),
        rotation=rotation,
        velocity=velocity,
        duration=duration,
        samples=samples,
    )


def judge(
    structure: Structure,
    excitation: Excitation,
    *,
    tolerance: float = TOLERANCE,
    vertical: Record | None = None,
    restitutions: Sequence[float] = (),
) -> free_rocking.Ending:
    """Return only how the response to a ground motion of finite duration ends.

    The parameters are those of `topheavy.judge`, the errors those of `simulate`. The free rocking
    is not integrated.
    """
    block = as_block(structure)
    checked_excitation(excitation, ends=True)
    course = motion.start(block, 0.0, 0.0)
    course.restitutions = [checks.fraction("restitutions", value) for value in restitutions]
    if course.restitutions:
        course.counted = motion.MIN_COUNTED_PEAK_WITH_RATIOS * block.slenderness
    ground = with_vertical(excitation, vertical)
    motion.force(block, ground, course, _flight(tolerance))
    end = motion.free_ending(block, course)
    return free_rocking.Ending(
        overturned=end.overturned,
        peak=math.nan if end.overturned else max(course.peak, end.peak),
        impacts=len(course.impacts) + end.impacts,
    )


def _flight(tolerance: float) -> motion.Flight:
    """Return the integration at a tolerance, or raise ValueError with the accepted range."""
    low, high = MIN_TOLERANCE, MAX_TOLERANCE
    return partial(_fly, checks.within("tolerance", tolerance, low, high))


def _fly(
    tolerance: float,
    block: RockingBlock,
    segment: Segment,
    stop: float,
    course: Motion,
    may_land: bool,
) -> Event | None:
    """Integrate on one side to `stop`, or to the impact or fall that comes first.

    `may_land` is False while no impact is possible.
    """
    alpha, p = block.slenderness, block.frequency_parameter
    ahead = stop - course.time
    is_short = 0.0 < p * ahead < MAX_ONE_STEP
    acceleration = _equation(block, segment, course.side)
    solver = DOP853(
        lambda t, y: (y[1], acceleration(float(t), float(y[0]))),
        course.time,
        [course.rotation, course.rate],
        stop,
        rtol=tolerance,
        atol=[tolerance * alpha, tolerance * alpha * p],
        first_step=ahead if is_short else None,
    )
    for _ in range(MAX_STEPS):
        if solver.status != "running":
            break
        message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(f"{block}: no step is possible at {solver.t:.6g} s: {message}")
        rotation, rate = solver.y.tolist()
        step = solver.dense_output()
        event, course.time = _first_event(step, course, may_land)
        course.arcs.append(Arc(step.t_old, course.time, course.side, step))
        course.rotation, course.rate = step(course.time).tolist() if event else (rotation, rate)
        if event is not None:
            return event
    else:
        raise ArithmeticError(
            f"{block}: {MAX_STEPS} steps end at {solver.t:.6g} s of {stop:.6g} s; a shorter "
            "duration or a larger tolerance has fewer"
        )
    course.rotation = max(course.rotation, 0.0)
    return None


def _equation(block: RockingBlock, segment: Segment, side: int) -> Callable[[float, float], float]:
    """Return φ̈ as a function of the time and φ on one side: Eq. (23), or linearised."""
    alpha, square = block.slenderness, block.frequency_parameter**2
    acceleration, gravity = segment.acceleration, segment.gravity

    def exact(t: float, rotation: float) -> float:
        lean, push = alpha - rotation, side * acceleration(t)
        return -square * gravity(t) * (math.sin(lean) + push * math.cos(lean))  # Eq. (23)

    def linearised(t: float, rotation: float) -> float:
        return square * gravity(t) * (rotation - alpha - side * acceleration(t))

    return linearised if block.linearised else exact


def _first_event(step: DenseOutput, course: Motion, may_land: bool) -> tuple[Event | None, float]:
    """Return the first event in this step and its time, or None and the end of the step.

    The peak of the motion is raised to the largest φ on the way there. In Chebyshev form a
    polynomial lies within c₀ ± Σ|cₖ|: mostly that alone proves that nothing happens. Otherwise the
    step is cut at the turning points of φ, between which a sign change is found for certain.
    """
    middle, half = (step.t_old + step.t) / 2.0, (step.t - step.t_old) / 2.0
    heights = step(np.array([step.t_old, *(middle + half * _NODES), step.t]))[0]
    series = _TO_SERIES @ heights[1:-1]
    reach = np.abs(series[1:]).sum()
    if series[0] - reach > 0.0 and series[0] + reach < min(course.ceiling, course.peak):
        course.height = max(course.height, float(heights.max()))
        return None, step.t
    slope = _TO_SLOPE @ series
    real = np.empty(0)
    if abs(slope[0]) <= np.abs(slope[1:]).sum():  # otherwise φ has no turning point in the step
        turns = chebyshev.chebroots(chebyshev.chebder(series))
        real = np.sort(turns.real[(np.abs(turns.imag) < 1e-9) & (np.abs(turns.real) < 1.0)])

    def height(t: float, above: float = 0.0) -> float:
        return float(step(t)[0]) - above

    before, value = step.t_old, float(heights[0])
    inside = [(time, height(time)) for time in middle + half * real]
    for time, upcoming in (*inside, (step.t, float(heights[-1]))):
        if may_land and value >= 0.0 > upcoming:
            return Event.IMPACT, sign_change(height, before, time)
        if value <= course.ceiling < upcoming:
            return Event.FALL, float(brentq(height, before, time, args=(course.ceiling,)))
        course.height = max(course.height, upcoming)
        course.peak = max(course.peak, upcoming)
        before, value = time, upcoming
    return None, step.t
