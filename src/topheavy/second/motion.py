"""A rocking motion from its start to its end: uplift, flights, impacts, rest, renewed uplift.

A flight is the motion on one side, between uplift or impact and the next impact. The side s = sgn θ
is a state of its own, since at θ = 0 the sign of θ says nothing; with it and φ = |θ| Eqs. (3) and
(23) read

    φ̈ = −p² { sin(α − φ) + s (ü_g/g) cos(α − φ) },    φ̈ = p² { φ − α − s ü_g/g }  (linearised)

A `Flight` (as in `reference`) integrates one flight; everything else is here.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum, auto
from itertools import takewhile

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies import free_rocking
from topheavy.bodies.response import Outcome, Response, initial_motion, sample_times
from topheavy.bodies.structures import RockingBlock
from topheavy.ground.excitation import (
    Excitation,
    Lines,
    Segment,
    checked_excitation,
    zero_acceleration,
)

#: Over α: a block whose next bounce peaks below this may have come to rest.
REST_PEAK = 1e-6
#: Over α: an impact that ends a lower rotation is not counted, as a block that bounces to rest has
#: infinitely many.
MIN_COUNTED_PEAK = 1e-6
#: The same where each impact has a √r of its own: no solver knows the order of smaller bounces.
MIN_COUNTED_PEAK_WITH_RATIOS = 1e-3
#: A history without a duration ends after this many impacts behind the forcing.
MAX_FREE_IMPACTS = 1000
#: Over 1/p. From α (1 − 1e-16) a block comes back within 75: one poised at α stays out longer.
MAX_FREE_FLIGHT = 100.0
#: All impacts of a history: only a block that loses next to nothing (√r → 1) has so many.
MAX_IMPACTS = 10_000
#: Over α: a block this far from φ = α, and going on, has left.
POISED_ROTATION = 1e-3


class Event(Enum):
    """The event that ended a flight."""

    IMPACT = auto()
    FALL = auto()  # it lies flat, or (linearised) is beyond return


@dataclass(frozen=True)
class Arc:
    """A span of the motion on one side; `course` gives (φ, φ̇) and is None at rest."""

    start: float
    stop: float
    side: int
    course: Callable[[NDArray[np.float64]], NDArray[np.float64]] | None

    def ends_at(self) -> tuple[float, float]:
        """Return φ and φ̇ at the stop."""
        if self.course is None:
            return 0.0, 0.0
        phi, rate = self.course(np.array(self.stop))
        return float(phi), float(rate)


@dataclass
class Motion:
    """The current state of a motion, with its peak and its number of impacts so far."""

    time: float
    side: int
    rotation: float  # φ = |θ|, rad
    rate: float  # φ̇, rad/s
    moving: bool
    ceiling: float  # φ from which nothing brings it back, rad
    counted: float  # φ: an impact that ends a lower rotation is not counted, rad
    peak: float
    height: float = 0.0  # largest φ of this flight, rad
    is_lifting: bool = False  # uplifted, and pushed outward ever since
    fallen: bool = False
    all_impacts: int = 0
    restitutions: Sequence[float] = ()  # √r of the counted impacts in turn, then the block's own
    impacts: list[float] = field(default_factory=list)
    arcs: list[Arc] = field(default_factory=list)


Flight = Callable[[RockingBlock, Segment, float, Motion, bool], Event | None]
"""Carry a motion over a segment to a time, or to the event that comes first; the last argument says
whether impacts are possible."""


def respond(
    block: RockingBlock,
    excitation: Excitation | None,
    fly: Flight,
    *,
    rotation: float,
    velocity: float,
    duration: float | None,
    samples: int | ArrayLike,
) -> Response:
    """Return the whole response; see `topheavy.simulate` for the parameters."""
    times = sample_times(samples)
    motion = start(block, rotation, velocity)
    forcing_end = force(block, excitation, motion, fly, duration)
    moved = bool(motion.moving or (motion.arcs and motion.peak > 0.0))

    end = free_ending(block, motion)
    counted = len(motion.impacts) + end.impacts
    until = duration
    if until is None and not isinstance(times, int):
        until = max(float(times[-1]), forcing_end)
    _rock_freely(block, motion, fly, until, end)

    if isinstance(times, int):
        last = max(motion.time, forcing_end) if duration is None else duration
        times = np.linspace(0.0, last, times)
    theta, theta_rate = _sample(motion, times)
    return Response(
        time=times,
        rotation=theta,
        velocity=theta_rate,
        impacts=np.array(motion.impacts),
        outcome=_outcome(block, motion, end, moved=moved),
        number_of_impacts=counted,
        peak_rotation=math.nan if end.overturned else max(motion.peak, end.peak),
    )


def start(block: RockingBlock, rotation: float, velocity: float) -> Motion:
    """Return the motion at t = 0 with θ (rad) and θ̇ (rad/s)."""
    theta, theta_rate = initial_motion(block, rotation, velocity)
    side = math.copysign(1.0, theta if theta != 0.0 else theta_rate)
    return Motion(
        time=0.0,
        side=int(side),
        rotation=abs(theta),
        rate=side * theta_rate,
        moving=theta != 0.0 or theta_rate != 0.0,
        ceiling=math.pi / 2,
        counted=MIN_COUNTED_PEAK * block.slenderness,
        peak=abs(theta),
        height=abs(theta),
    )


def force(
    block: RockingBlock,
    excitation: Excitation | None,
    motion: Motion,
    fly: Flight,
    duration: float | None = None,
) -> float:
    """Carry the motion through the forcing and return when that ends, s."""
    if duration is not None:
        checks.positive("duration", duration, "s")
    if excitation is None:
        return 0.0
    checked_excitation(excitation)
    forcing_end = min(excitation.duration, math.inf if duration is None else duration)
    if forcing_end == math.inf:
        raise ValueError("duration is None; expected one, as this excitation goes on forever")
    segments = excitation.segments(forcing_end)
    level = block.uplift_acceleration
    if block.linearised:
        # It cannot lie flat, but beyond α + max|ü_g|/g it is pushed outward for good.
        largest = max(segment.largest(segment.start, segment.stop) for segment in segments)
        motion.ceiling = max(math.pi / 2, block.slenderness + largest)
    number = 0
    while number < len(segments) and not motion.fallen:
        segment = segments[number]
        if isinstance(segments, Lines) and not motion.moving:
            later = segments.next_above(level, number)
            if later > number:
                rest_ends = segments[later - 1].stop
                motion.arcs.append(Arc(motion.time, rest_ends, motion.side, None))
                motion.time, number = rest_ends, later
                continue
        while motion.time < segment.stop and not motion.fallen:
            if not motion.moving:
                uplift = segment.uplift(motion.time, level)
                rest_ends = segment.stop if uplift is None else uplift
                motion.arcs.append(Arc(motion.time, rest_ends, motion.side, None))
                motion.time = rest_ends
                if uplift is None:
                    break
                motion.side = -1 if segment.acceleration(uplift) > 0.0 else 1
                motion.rotation = motion.rate = 0.0
                motion.moving = motion.is_lifting = True
            event = _flight(block, segment, motion, fly)
            if event is Event.IMPACT:
                _impact(block, segments, number, motion)
        number += 1
    return forcing_end


def free_ending(block: RockingBlock, motion: Motion) -> free_rocking.Ending:
    """Return how the free rocking ends that follows the forcing."""
    if motion.fallen:
        return free_rocking.Ending(overturned=True, peak=math.nan, impacts=0)
    if not motion.moving:
        return free_rocking.Ending(overturned=False, peak=0.0, impacts=0)
    next_impact = block.with_restitution(_next_restitution(block, motion))
    velocity = motion.rate / block.frequency_parameter
    return free_rocking.ending(next_impact, motion.rotation, velocity)


def _next_restitution(block: RockingBlock, motion: Motion) -> float:
    later = motion.restitutions[len(motion.impacts) :]
    return later[0] if later else block.restitution


def _flight(block: RockingBlock, segment: Segment, motion: Motion, fly: Flight) -> Event | None:
    """Fly to the end of the segment, or of the push that lifted the block."""
    stop, may_land = segment.stop, not motion.is_lifting
    if motion.is_lifting:
        # Pushed by more than the uplift acceleration, φ̈ > 0: no impact is possible yet. To look for
        # one would find those of rounding.
        push_ends = segment.falls_below(motion.time, motion.side, block.uplift_acceleration)
        motion.is_lifting = push_ends >= stop
        stop = min(stop, max(push_ends, math.nextafter(motion.time, math.inf)))
    event = fly(block, segment, stop, motion, may_land)
    motion.fallen = event is Event.FALL
    return event


def _impact(block: RockingBlock, segments: Sequence[Segment], number: int, motion: Motion) -> None:
    """Let the block pass to its other pivot, in a segment: the rate × √r, Eq. (25)."""
    motion.all_impacts += 1
    if motion.all_impacts > MAX_IMPACTS:
        raise ArithmeticError(
            f"{block}: more than {MAX_IMPACTS} impacts by {motion.time:.6g} s, and it bounces on; "
            "a shorter duration or a smaller restitution has fewer"
        )
    ratio = _next_restitution(block, motion)
    if motion.height > motion.counted:
        motion.impacts.append(motion.time)
    motion.height = 0.0
    motion.side = -motion.side
    motion.rotation, motion.rate = 0.0, ratio * max(0.0, -motion.rate)
    motion.moving = motion.rate > 0.0 and not _comes_to_rest(block, segments, number, motion)


def _comes_to_rest(
    block: RockingBlock, segments: Sequence[Segment], number: int, motion: Motion
) -> bool:
    """Return whether the bounces that start here are negligible and provably remain so.

    Bouncing to rest is a geometric sequence of infinitely many impacts in a finite time. With a
    restoring acceleration of at least d, each lasts at most 2 φ̇/d, and the train of them
    2 φ̇/d(1 − √r). It is over when d stays above half of its present value for twice that long:
    then the ground cannot lift the block before it rests. Without loss (√r = 1) the bounces never
    end; if d stays above that half for good, they never grow to a rotation that counts, and are
    followed no more.
    """

    def restoring(ground: float, gravity: float) -> float:
        alpha, square = block.slenderness, gravity * block.frequency_parameter**2
        if block.linearised:
            return square * (alpha - ground)
        return square * (math.sin(alpha) - ground * math.cos(alpha))

    segment = segments[number]
    now = restoring(abs(segment.acceleration(motion.time)), segment.gravity(motion.time))
    if now <= 0.0:
        return False
    if motion.rate**2 > 2.0 * now * REST_PEAK * block.slenderness:
        return False
    lost = 1.0 - block.restitution
    train_ends = motion.time + 4.0 * motion.rate / (now * lost) if lost else math.inf
    ahead = (segments[k] for k in range(number, len(segments)))
    during = list(takewhile(lambda segment: segment.start < train_ends, ahead))
    largest = max((segment.largest(motion.time, train_ends) for segment in during), default=0.0)
    gravity = min((segment.least_gravity(motion.time, train_ends) for segment in during), default=1)
    return restoring(largest, gravity) > now / 2.0


def _outcome(
    block: RockingBlock, motion: Motion, end: free_rocking.Ending, *, moved: bool
) -> Outcome:
    if end.overturned:
        return "overturned"
    if not moved:
        return "no uplift"
    return "rocking" if motion.moving or block.restitution == 1.0 else "rests"


def _rock_freely(
    block: RockingBlock, motion: Motion, fly: Flight, until: float | None, end: free_rocking.Ending
) -> None:
    """Carry the motion on without forcing, to where the history ends.

    The energy decides how (`end`). Within rounding of the barrier the block is poised at α, and the
    integration may lead to the other side than judged: the history ends with the flight before.
    """
    counted, all_impacts = len(motion.impacts), motion.all_impacts
    impacts_due = end.impacts
    longest = MAX_FREE_FLIGHT / block.frequency_parameter
    motion.is_lifting = False
    while motion.moving and not motion.fallen and motion.rotation < motion.ceiling:
        stop = motion.time + longest if until is None else until
        if motion.time >= stop:
            return
        free_impacts = max(len(motion.impacts) - counted, (motion.all_impacts - all_impacts) // 2)
        if until is None and free_impacts >= MAX_FREE_IMPACTS:
            return
        ground = Segment(motion.time, stop, zero_acceleration)
        begin, peak = motion.time, motion.peak
        first, outward = len(motion.arcs), end.overturned and impacts_due <= 0
        event = _flight(block, ground, motion, fly)
        if _leaves_wrongly(block, motion.rotation, motion.rate, outward=outward):
            kept = first
            while kept < len(motion.arcs) and not _leaves_wrongly(
                block, *motion.arcs[kept].ends_at(), outward=outward
            ):
                kept += 1
            motion.time = motion.arcs[kept - 1].stop if kept > first else begin
            motion.peak, motion.arcs[kept:] = peak, []
            return
        impacts_due -= 1
        if event is Event.IMPACT:
            _impact(block, [ground], 0, motion)
        elif until is None:
            return


def _leaves_wrongly(block: RockingBlock, phi: float, rate: float, *, outward: bool) -> bool:
    """Return whether a free motion leaves φ = α to the other side than was judged.

    `outward`: it overturns on this side. Any other free motion passes α only inward.
    """
    if outward:
        return rate < 0.0 and phi < (1.0 - POISED_ROTATION) * block.slenderness
    return rate > 0.0 and phi > (1.0 + POISED_ROTATION) * block.slenderness


def _sample(
    motion: Motion, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return θ and θ̇ at the times: those of the later arc where two meet.

    Beyond the last arc a block at rest stays there; of another nothing is known (NaN).
    """
    beyond = math.nan if motion.moving else 0.0
    theta, rate = np.full_like(times, beyond), np.full_like(times, beyond)
    for arc in motion.arcs:
        inside = slice(
            int(np.searchsorted(times, arc.start)), int(np.searchsorted(times, arc.stop, "right"))
        )
        if arc.course is None:
            theta[inside] = rate[inside] = 0.0
        elif inside.start < inside.stop:
            theta[inside], rate[inside] = arc.side * arc.course(times[inside])
    return theta, rate
