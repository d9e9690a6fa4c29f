"""The motion of the rocking frame as three rigid bodies: flights by Newton–Euler, impacts, rest.

The nine coordinates of `newton_euler` are integrated and collide without the equation of
motion of the frame or its coefficient of restitution, which are results here.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike
from scipy.integrate import DOP853, DenseOutput
from scipy.optimize import brentq

from steps.shared.newton_euler import (
    COLUMNS,
    Sides,
    ThreeBodies,
    Vector,
    accelerations,
    impact,
    opening,
    uplift_accelerations,
)
from steps.shared.segments import Segment, segments_of
from topheavy import checks
from topheavy.bodies.response import EndState, sample_times
from topheavy.bodies.structures import STANDARD_GRAVITY, RockingFrame
from topheavy.ground.pulses import Pulse

TOLERANCE = 1e-12
"""Of the integration, relative to the size of a motion as large as α."""

REST_PEAK = 1e-6
"""Over α: a frame whose next bounce peaks below this may have come to rest."""

LARGEST_GAP = 1e-6
"""Of R: bodies further than this from upright, when a column is, have lost their contacts."""

_DEGREE = 7  # of DOP853's interpolating polynomial
_NODES = chebyshev.chebpts1(_DEGREE + 1)
_TO_SERIES = np.linalg.inv(chebyshev.chebvander(_NODES, _DEGREE))


@dataclass(frozen=True, eq=False)
class ThreeBodyResponse:
    """A history of the three bodies.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, from 0.
    coordinates, velocity : ndarray, shape (n, 9)
        q (m, rad) and q̇ (m/s, rad/s) relative to the ground; NaN behind the end of the history.
    forces : ndarray, shape (n, 4, 2)
        Contact forces on the upper body, to the right and upward, N for columns of 1 kg. NaN at
        rest, when the bodies stand on faces.
    drift : ndarray, shape (n,)
        Largest distance between two points in contact, m: what the integration has lost.
    impacts : ndarray, shape (m,)
        Times of all impacts, s.
    velocity_ratios : ndarray, shape (m, 2)
        Angular velocity behind over before an impact, of each column.
    impulses : ndarray, shape (m, 4, 2)
        N s, as the forces.
    outcome : {"no uplift", "rests", "rocking", "overturned"}
        Of this history: "overturned" is a column that lies flat, |θ| = π/2.
    """

    time: Vector
    coordinates: Vector
    velocity: Vector
    forces: Vector
    drift: Vector
    impacts: Vector
    velocity_ratios: Vector
    impulses: Vector
    outcome: EndState

    @property
    def rotation(self) -> Vector:
        """θ of each column, rad, shape (n, 2)."""
        return self.coordinates[:, COLUMNS]

    @property
    def cap_displacement(self) -> Vector:
        """u and v of the cap beam's centre, m, shape (n, 2)."""
        return self.coordinates[:, 6:8]

    @property
    def cap_angle(self) -> Vector:
        """Rotation of the cap beam, rad, shape (n,)."""
        return self.coordinates[:, 8]


@dataclass(frozen=True)
class _Arc:
    """A span of the motion; `course` gives (q, q̇) and is None at rest."""

    start: float
    stop: float
    sides: Sides
    ground: Segment
    course: DenseOutput | None


@dataclass
class _Motion:
    """The current state of a motion, with its peak and its number of impacts so far."""

    time: float
    sides: Sides
    state: Vector  # (q, q̇)
    moving: bool
    arcs: list[_Arc]
    impacts: list[tuple[float, Vector, Vector]]  # time, ratios, impulses
    launching: bool = False  # uplifted, and pushed on since without a break
    fallen: bool = False


def simulate_three_bodies(
    frame: RockingFrame,
    pulse: Pulse | None = None,
    *,
    span: float,
    cap_depth: float,
    duration: float,
    rotation: float = 0.0,
    velocity: float = 0.0,
    samples: int | ArrayLike = 1000,
    tolerance: float = TOLERANCE,
) -> ThreeBodyResponse:
    """Return the motion of the three bodies under a pulse, or rocking freely without one.

    Parameters
    ----------
    frame : RockingFrame
    pulse : Pulse, optional
    span, cap_depth : float
        Distance between the axes of the columns and depth of the cap beam, m.
    duration : float
        Where the history ends, s.
    rotation, velocity : float
        θ (rad) and θ̇ (rad/s) of both columns at t = 0, signed; the cap beam is level.
    samples : int or array_like
        A number of uniform times from 0 to the duration, or increasing times in s.
    tolerance : float
        Of the integration, relative to a motion as large as α.

    Raises
    ------
    ValueError
        For values out of range; see `ThreeBodies`.
    ArithmeticError
        When contacts have come apart by more than `LARGEST_GAP` of R before an impact.

    Notes
    -----
    Contacts are held also where a force would have to pull: `forces` tells where. All nine
    coordinates are integrated without correction; at an impact, when the frame is upright,
    they are set to zero. It rests when the next bounce peaks below `REST_PEAK` of α and the ground
    cannot lift it before the bouncing has died out.
    """
    bodies = ThreeBodies(frame, span, cap_depth)
    until = checks.positive("duration", duration, "s")
    checks.within("tolerance", tolerance, 1e-13, 1e-2)  # as SciPy takes it
    times = sample_times(samples)
    if isinstance(times, int):
        times = np.linspace(0.0, until, times)
    segments = segments_of(pulse, until)
    motion = _start(bodies, rotation, velocity)
    lifts = uplift_accelerations(bodies)
    level = min(abs(lift) for lift in lifts.values())
    for number, segment in enumerate(segments):
        while motion.time < segment.stop and not motion.fallen:
            if not motion.moving:
                uplift = segment.uplift(motion.time, level)
                rest_ends = segment.stop if uplift is None else uplift
                motion.arcs.append(_Arc(motion.time, rest_ends, motion.sides, segment, None))
                motion.time = rest_ends
                if uplift is None:
                    break
                motion.sides = _lifting(lifts, segment.acceleration(uplift))
                motion.moving = motion.launching = True
            if _fly(bodies, segment, motion, level, tolerance):
                _collide(bodies, segments[number:], motion, level)
    return _sampled(bodies, motion, times)


def _start(bodies: ThreeBodies, rotation: float, velocity: float) -> _Motion:
    """Return the motion at t = 0: equal columns at θ and θ̇, and all contacts closed."""
    theta = checks.finite("rotation", rotation)
    rate = checks.finite("velocity", velocity)
    if abs(theta) >= math.pi / 2:
        raise ValueError(f"rotation is {theta:.6g} rad; expected less than π/2, where it lies flat")
    side = -1 if (theta or rate) < 0.0 else 1
    sides = (side, side)
    coordinates = np.zeros(9)
    coordinates[COLUMNS] = theta
    for body in range(3):  # the contact of the same number closes as the body is moved there
        coordinates[3 * body : 3 * body + 2] -= bodies.gaps(sides, coordinates)[body]
    jacobian = bodies.matrix(bodies.turned_arms(sides, coordinates))[9:, :9]
    moving_on = np.vstack([jacobian, np.eye(9)[2]])
    velocities = np.linalg.solve(moving_on, rate * np.eye(9)[8])
    state = np.concatenate([coordinates, velocities])
    return _Motion(0.0, sides, state, bool(theta or rate), [], [])


def _lifting(lifts: dict[Sides, float], ground: float) -> Sides:
    """Return the corners on which the frame turns when the ground lifts it by this push (g)."""
    return next(sides for sides, lift in lifts.items() if lift * ground > 0.0)


def _fly(
    bodies: ThreeBodies, segment: Segment, motion: _Motion, level: float, tolerance: float
) -> bool:
    """Move to the end of the segment, or of the push that lifted it; return whether it collides."""
    stop, possible = segment.stop, not motion.launching
    if motion.launching:
        # While pushed by more than the uplift acceleration it only rises: no impact is looked for
        # where rounding could feign one.
        push_ends = segment.falls_below(motion.time, motion.sides[0], level)
        motion.launching = push_ends >= stop
        stop = min(stop, max(push_ends, math.nextafter(motion.time, math.inf)))
    column = bodies.frame.column
    length, alpha = np.array([column.size, column.size, 1.0] * 3), column.slenderness
    rate = math.sqrt(STANDARD_GRAVITY / column.size)
    sides = motion.sides

    def newton_euler(t: float, y: Vector) -> Vector:
        second, _ = accelerations(bodies, sides, y[:9], y[9:], segment.acceleration(t))
        return np.concatenate([y[9:], second])

    solver = DOP853(
        newton_euler,
        motion.time,
        motion.state,
        stop,
        rtol=tolerance,
        atol=tolerance * alpha * np.concatenate([length, rate * length]),
    )
    while solver.status == "running":
        message = solver.step()
        if solver.status == "failed":
            raise ArithmeticError(f"{bodies}: no step is possible at {solver.t:.6g} s: {message}")
        step = solver.dense_output()
        event, motion.time = _first_event(step, sides, possible)
        motion.arcs.append(_Arc(step.t_old, motion.time, sides, segment, step))
        motion.state = step(motion.time)
        if event is not None:
            motion.fallen = event == "fall"
            return event == "impact"
    return False


def _first_event(
    step: DenseOutput, sides: Sides, possible: bool
) -> tuple[Literal["impact", "fall"] | None, float]:
    """Return what happens first in a step and when, or None and the end of the step.

    In Chebyshev form a polynomial lies within c₀ ± Σ|cₖ|. Where that does not exclude events, the
    step is cut at the turning points of the rotation, between which a sign change is certain.
    """
    middle, half = (step.t_old + step.t) / 2.0, (step.t - step.t_old) / 2.0
    events: list[tuple[float, Literal["impact", "fall"]]] = []
    at_nodes = step(middle + half * _NODES)
    for angle, side in zip(COLUMNS, sides, strict=True):
        series = _TO_SERIES @ (side * at_nodes[angle])
        reach = np.abs(series[1:]).sum()
        if series[0] - reach > 0.0 and series[0] + reach < math.pi / 2:
            continue
        turns = chebyshev.chebroots(chebyshev.chebder(series))
        real = np.sort(turns.real[(np.abs(turns.imag) < 1e-9) & (np.abs(turns.real) < 1.0)])

        def above(t: float, level: float, angle: int = angle, side: int = side) -> float:
            return side * float(step(t)[angle]) - level

        before = step.t_old
        for time in (*(middle + half * real), step.t):
            if possible and above(before, 0.0) >= 0.0 > above(time, 0.0):
                root = brentq(above, before, time, args=(0.0,), xtol=1e-300, rtol=1e-15)
                events.append((float(root), "impact"))
                break
            if above(before, math.pi / 2) <= 0.0 < above(time, math.pi / 2):
                events.append((float(brentq(above, before, time, args=(math.pi / 2,))), "fall"))
                break
            before = time
    if not events:
        return None, step.t
    time, event = min(events)
    return event, time


def _collide(
    bodies: ThreeBodies, segments: Sequence[Segment], motion: _Motion, level: float
) -> None:
    """Apply the impact of the upright frame: it changes to its other corners."""
    largest = np.abs(motion.state[:9] * ([1.0, 1.0, bodies.frame.column.size] * 3)).max()
    if largest > LARGEST_GAP * bodies.frame.column.size:
        raise ArithmeticError(
            f"{bodies}: at {motion.time:.6g} s a column is upright and another body is "
            f"{largest:.3g} m off; expected less than {LARGEST_GAP:g} R"
        )
    before = motion.state[9:]
    motion.sides = (-motion.sides[0], -motion.sides[1])
    after, impulses = impact(bodies, motion.sides, before)
    ratios = after[COLUMNS] / before[COLUMNS]
    motion.impacts.append((motion.time, ratios, impulses))
    lifting = after[COLUMNS] * np.array(motion.sides)
    motion.moving = bool(np.all(lifting > 0.0)) and not _comes_to_rest(
        bodies, segments, motion, level, float(lifting.max()), float(ratios.max())
    )
    motion.state = np.concatenate([np.zeros(9), after if motion.moving else np.zeros(9)])


def _comes_to_rest(
    bodies: ThreeBodies,
    segments: Sequence[Segment],
    motion: _Motion,
    level: float,
    rate: float,
    ratio: float,
) -> bool:
    """Return whether the bounces that start here are negligible and provably die out.

    At the restoring acceleration d a bounce lasts 2 θ̇/d, and the train of
    them 2 θ̇/d(1 − ratio); it is over when d keeps above a half of its value for twice that long.
    """
    now = abs(segments[0].acceleration(motion.time))
    restoring = -float(opening(bodies, motion.sides, -motion.sides[0] * now).max())
    if (
        restoring <= 0.0
        or ratio >= 1.0
        or rate**2 > 2.0 * restoring * REST_PEAK * bodies.frame.slenderness
    ):
        return False
    train_ends = motion.time + 4.0 * rate / (restoring * (1.0 - ratio))
    largest = max(segment.largest(motion.time, train_ends) for segment in segments)
    return level - largest > (level - now) / 2.0


def _sampled(bodies: ThreeBodies, motion: _Motion, times: Vector) -> ThreeBodyResponse:
    """Return the history at the times: that of the later arc where two meet."""
    states = np.full((times.size, 18), math.nan)
    forces, drift = np.full((times.size, 4, 2), math.nan), np.full(times.size, math.nan)
    for arc in motion.arcs:
        first, last = np.searchsorted(times, arc.start), np.searchsorted(times, arc.stop, "right")
        for k in range(int(first), int(last)):
            if arc.course is None:
                states[k], forces[k], drift[k] = 0.0, math.nan, 0.0
                continue
            t = float(times[k])
            states[k] = arc.course(t)
            q, rates = states[k, :9], states[k, 9:]
            _, forces[k] = accelerations(bodies, arc.sides, q, rates, arc.ground.acceleration(t))
            drift[k] = np.hypot(*bodies.gaps(arc.sides, q).T).max()
    moved = any(arc.course is not None for arc in motion.arcs)
    outcome: EndState = "rests" if moved else "no uplift"
    if motion.fallen or motion.moving:
        outcome = "overturned" if motion.fallen else "rocking"
    return ThreeBodyResponse(
        time=times,
        coordinates=states[:, :9],
        velocity=states[:, 9:],
        forces=forces,
        drift=drift,
        impacts=np.array([time for time, _, _ in motion.impacts]),
        velocity_ratios=np.array([ratios for _, ratios, _ in motion.impacts]).reshape(-1, 2),
        impulses=np.array([impulses for _, _, impulses in motion.impacts]).reshape(-1, 4, 2),
        outcome=outcome,
    )
