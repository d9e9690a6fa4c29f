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
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import DOP853, DenseOutput
from scipy.optimize import brentq

from topheavy import checks, free_rocking, motion
from topheavy.excitation import Excitation, Segment, root
from topheavy.motion import Arc, Event, Motion
from topheavy.records import Record
from topheavy.response import Response
from topheavy.structures import RockingBlock, Structure, as_block
from topheavy.vertical import with_vertical

TOLERANCE = 1e-11
"""Of the integration, relative to α and αp."""

SMALLEST_TOLERANCE, LARGEST_TOLERANCE = 1e-13, 1e-2
"""SciPy raises a smaller one without asking, and a larger one follows no motion."""

MOST_STEPS = 1_000_000
"""Of a flight in one segment; the solver refuses steps that are below rounding, but not so many."""

SHORT = 0.05
"""1/p. A step of DOP853 over so short a piece of the forcing needs no search for its length."""

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
        For a history of more than `motion.MOST_IMPACTS` impacts or a million steps in a flight.
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

    `restitutions` are √r of the counted impacts in turn, after which the block's own is taken.
    As `simulate` has it, without the history: the free rocking is not integrated. The peak is
    max|θ| over the whole motion (NaN if overturned), the impacts are counted as in `Response`.
    Errors are those of `simulate`.
    """
    block = as_block(structure)
    course = motion.start(block, 0.0, 0.0)
    course.restitutions = [checks.fraction("restitutions", value) for value in restitutions]
    ground = with_vertical(excitation, vertical)
    motion.force(block, ground, course, _flight(tolerance, keep=False))
    end = motion.free_ending(block, course)
    return free_rocking.Ending(
        overturned=end.overturned,
        peak=math.nan if end.overturned else max(course.peak, end.peak),
        impacts=len(course.impacts) + end.impacts,
    )


def _flight(tolerance: float, *, keep: bool = True) -> motion.Flight:
    """Return the integration at a tolerance, or raise ValueError with the accepted range.

    `keep` says whether the history is wanted, and not only how it ends.
    """
    low, high = SMALLEST_TOLERANCE, LARGEST_TOLERANCE
    return partial(_fly, checks.within("tolerance", tolerance, low, high), keep)


def _fly(
    tolerance: float,
    keep: bool,
    block: RockingBlock,
    segment: Segment,
    stop: float,
    course: Motion,
    possible: bool,
) -> Event | None:
    """Integrate on one side to `stop`, or to the impact or fall that comes first."""
    alpha, p = block.slenderness, block.frequency_parameter
    ahead = stop - course.time
    largest = math.inf if keep else _largest(block, segment)
    solver = DOP853(
        _equation(block, segment, course.side),
        course.time,
        [course.rotation, course.rate],
        stop,
        rtol=tolerance,
        atol=[tolerance * alpha, tolerance * alpha * p],
        first_step=ahead if 0.0 < p * ahead < SHORT else None,
    )
    for _ in range(MOST_STEPS):
        if solver.status != "running":
            break
        message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(f"{block}: no step is possible at {solver.t:.6g} s: {message}")
        ends = course.rotation, float(solver.y[0])
        aside = largest * (solver.t - solver.t_old) ** 2 / 8.0  # of the chord of φ at most
        if min(ends) - aside > 0.0 and max(ends) + aside < min(course.ceiling, course.peak):
            course.height, course.time = max(course.height, *ends), solver.t
            course.rotation, course.rate = map(float, solver.y)
            continue  # nothing happens in this step
        step = solver.dense_output()
        event, course.time = _first_event(step, course, possible)
        course.arcs.append(Arc(step.t_old, course.time, course.side, step))
        course.rotation, course.rate = (float(value) for value in step(course.time))
        if event is not None:
            return event
    else:
        raise ArithmeticError(
            f"{block}: {MOST_STEPS} steps end at {solver.t:.6g} s of {stop:.6g} s; a shorter "
            "duration or a larger tolerance has fewer"
        )
    course.rotation = max(course.rotation, 0.0)
    return None


def _equation(
    block: RockingBlock, segment: Segment, side: int
) -> Callable[[float, NDArray[np.float64]], tuple[float, float]]:
    """Return the equation of motion (φ, φ̇)' on one side: Eq. (23), or linearised."""
    alpha, square = block.slenderness, block.frequency_parameter**2
    acceleration, gravity = segment.acceleration, segment.gravity

    def exact(t: float, y: NDArray[np.float64]) -> tuple[float, float]:
        lean = alpha - float(y[0])
        push = side * float(acceleration(t))
        return y[1], -square * gravity(t) * (math.sin(lean) + push * math.cos(lean))  # Eq. (23)

    def linearised(t: float, y: NDArray[np.float64]) -> tuple[float, float]:
        return y[1], square * gravity(t) * (float(y[0]) - alpha - side * float(acceleration(t)))

    return linearised if block.linearised else exact


def _largest(block: RockingBlock, segment: Segment) -> float:
    """Return a bound on |φ̈| of the exact equation, rad/s²; none is known of the linearised one."""
    if block.linearised:
        return math.inf
    ends = segment.start, segment.stop
    gravity = max(map(segment.gravity, ends))
    return block.frequency_parameter**2 * gravity * (1.0 + segment.largest(*ends))


def _first_event(step: DenseOutput, course: Motion, possible: bool) -> tuple[Event | None, float]:
    """Return what happens first in this step and when, or None and the end of the step.

    The peak of the motion is raised to the largest φ on the way there. In Chebyshev form a
    polynomial lies within c₀ ± Σ|cₖ|: mostly that alone proves that nothing happens. Otherwise the
    step is cut at the turning points of φ, between which a sign change is found for certain.
    """
    middle, half = (step.t_old + step.t) / 2.0, (step.t - step.t_old) / 2.0
    heights = step(middle + half * _NODES)[0]
    series = _TO_SERIES @ heights
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

    before, value = step.t_old, height(step.t_old)
    for time in (*(middle + half * real), step.t):
        upcoming = height(time)
        if possible and value >= 0.0 > upcoming:
            return Event.IMPACT, root(height, before, time)
        if value <= course.ceiling < upcoming:
            return Event.FALL, float(brentq(height, before, time, args=(course.ceiling,)))
        course.height = max(course.height, upcoming)
        course.peak = max(course.peak, upcoming)
        before, value = time, upcoming
    return None, step.t
