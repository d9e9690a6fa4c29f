"""The motion of the rocking frame as three rigid bodies: flights by Newton–Euler, impacts, rest.

The nine coordinates of `newton_euler` are integrated and collide without the equation of
motion of the frame or its coefficient of restitution, which are results here.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
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
from topheavy.bodies.response import EndState, sample_times
from topheavy.bodies.structures import STANDARD_GRAVITY, RockingFrame
from topheavy.forces.contacts import Cap
from topheavy.ground.pulses import Pulse

TOLERANCE = 1e-12  # tolerance of the integration, relative to a motion as large as α
BELOW = 1e-12  # rotation beyond upright at which an impact is detected, times α; above rounding
REST_PEAK = 1e-6  # peak of the next bounce below which a frame may have come to rest, times α
LARGEST_GAP = 1e-6  # largest distance of a body from upright at an impact, times R
LOOKS = 4001  # instants of a pulse at which the uplift of a frame at rest is tested


class ThreeBodyResponse(NamedTuple):
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
    impacts : ndarray, shape (m,)
        Times of all impacts, s.
    velocity_ratios : ndarray, shape (m, 2)
        Angular velocity behind over before an impact, of each column.
    outcome : {"no uplift", "rests", "rocking", "overturned"}
        Of this history: "overturned" is a column that lies flat, |θ| = π/2.
    """

    time: Vector
    coordinates: Vector
    velocity: Vector
    forces: Vector
    impacts: Vector
    velocity_ratios: Vector
    outcome: EndState

    @property
    def rotation(self) -> Vector:
        """θ of each column, rad, shape (n, 2)."""
        return self.coordinates[:, COLUMNS]


def simulate_three_bodies(
    frame: RockingFrame,
    cap: Cap,
    pulse: Pulse,
    *,
    duration: float,
    samples: int | ArrayLike = 1000,
) -> ThreeBodyResponse:
    """Return the motion of the three bodies from rest under a pulse.

    Parameters
    ----------
    duration : float
        End of the history, s.
    samples : int or array_like
        A number of uniform times from 0 to the duration, or increasing times in s.

    Raises
    ------
    ValueError
        For values out of range; see `ThreeBodies`.
    ArithmeticError
        When contacts have come apart by more than `LARGEST_GAP` of R before an impact.

    Notes
    -----
    Contacts hold also where a force would have to pull, as `forces` shows. All nine
    coordinates are integrated without correction; at an impact, when the frame is upright,
    they are set to zero. It rests when the next bounce peaks below `REST_PEAK` of α and the ground
    cannot lift it before the bouncing has died out.
    """
    bodies, times = ThreeBodies(frame, cap), sample_times(samples)
    if isinstance(times, int):
        times = np.linspace(0.0, duration, times)
    sides, state = (1, 1), np.zeros(18)
    lifts = uplift_accelerations(bodies)
    level = min(abs(lift) for lift in lifts.values())
    size, alpha = frame.column.size, frame.slenderness
    length = np.array([size, size, 1.0] * 3)
    scale = TOLERANCE * alpha * np.append(length, math.sqrt(STANDARD_GRAVITY / size) * length)
    states, forces = np.full((times.size, 18), math.nan), np.full((times.size, 4, 2), math.nan)
    impacts: list[float] = []
    velocity_ratios: list[Vector] = []
    moving, outcome, time, end = False, "no uplift", 0.0, min(duration, pulse.duration)
    while time < duration and outcome != "overturned":
        stop = end if time < end else duration
        ground = pulse.excitation if time < end else np.zeros_like
        if not moving:
            lifted = _uplift(ground, time, stop, level)
            states[(time <= times) & (times <= lifted)] = 0.0
            time, moving = lifted, lifted < stop
            if moving:
                push = ground(math.nextafter(time, stop))
                sides = next(corners for corners, lift in lifts.items() if lift * push > 0.0)
            continue

        def newton_euler(
            t: float, y: Vector, sides: Sides = sides, ground: Callable = ground
        ) -> Vector:
            second, _ = accelerations(bodies, sides, y[:9], y[9:], float(ground(t)))
            return np.append(y[9:], second)

        def upright(t: float, y: Vector, sides: Sides = sides) -> float:
            return float((y[COLUMNS] * sides).min()) + BELOW * alpha

        def flat(t: float, y: Vector) -> float:
            return math.pi / 2.0 - float(np.abs(y[COLUMNS]).max())

        upright.terminal = flat.terminal = True  # type: ignore[attr-defined]
        flight = solve_ivp(
            newton_euler,
            (time, stop),
            state,
            "DOP853",
            dense_output=True,
            events=[upright, flat],
            rtol=TOLERANCE,
            atol=scale,
        )
        if not flight.success:
            raise ArithmeticError(f"{bodies}: no step is possible at {flight.t[-1]:.6g} s")
        for k in np.flatnonzero((time <= times) & (times <= flight.t[-1])):
            states[k] = flight.sol(times[k])
            _, forces[k] = accelerations(bodies, sides, *np.split(states[k], 2), ground(times[k]))
        time, state, outcome = flight.t[-1], flight.y[:, -1], "rocking"
        if flight.t_events[1].size:
            outcome = "overturned"
        elif flight.t_events[0].size:
            sides = (-sides[0], -sides[1])
            state, ratios = _collided(bodies, sides, state, time)
            impacts.append(time)
            velocity_ratios.append(ratios)
            lifting = state[9:][COLUMNS] * sides
            rests = _rests(bodies, sides, ground, time, level, lifting.max(), ratios.max())
            moving = bool((lifting > 0.0).all()) and not rests
            if not moving:
                state, outcome = np.zeros(18), "rests"
    return ThreeBodyResponse(
        times,
        states[:, :9],
        states[:, 9:],
        forces,
        np.array(impacts),
        np.reshape(velocity_ratios, (-1, 2)),
        outcome,
    )


def _uplift(ground: Callable, time: float, stop: float, level: float) -> float:
    """Return the first instant at which |ü_g| exceeds a level (g), or the stop."""
    looks = np.linspace(time, stop, LOOKS)
    above = np.flatnonzero(np.abs(ground(looks)) > level)
    if not above.size or above[0] == 0:
        return time if above.size else stop
    before, after = looks[above[0] - 1], looks[above[0]]
    return float(brentq(lambda t: abs(float(ground(t))) - level, before, after, xtol=1e-15))


def _collided(
    bodies: ThreeBodies, sides: Sides, state: Vector, time: float
) -> tuple[Vector, Vector]:
    """Return (q, q̇) behind the impact of the upright frame, and the ratios of its velocities."""
    largest = np.abs(state[:9] * ([1.0, 1.0, bodies.frame.column.size] * 3)).max()
    if largest > LARGEST_GAP * bodies.frame.column.size:
        raise ArithmeticError(
            f"{bodies}: at {time:.6g} s a column is upright and another body is "
            f"{largest:.3g} m off; expected less than {LARGEST_GAP:g} R"
        )
    after, _ = impact(bodies, sides, state[9:])
    return np.append(np.zeros(9), after), after[COLUMNS] / state[9:][COLUMNS]


def _rests(
    bodies: ThreeBodies,
    sides: Sides,
    ground: Callable,
    time: float,
    level: float,
    rate: float,
    ratio: float,
) -> bool:
    """Return whether the bounces after an impact are negligible and die out.

    At the restoring acceleration d a bounce lasts 2 θ̇/d, and the train of them
    2 θ̇/d(1 − ratio); it is over when d keeps above a half of its value for twice that long.
    """
    now = abs(float(ground(time)))
    restoring = -float(opening(bodies, sides, -sides[0] * now).max())
    peak = REST_PEAK * bodies.frame.slenderness
    if restoring <= 0.0 or ratio >= 1.0 or rate**2 > 2.0 * restoring * peak:
        return False
    train = np.linspace(0.0, 4.0 * rate / (restoring * (1.0 - ratio)), 20)
    return bool(level - np.abs(ground(time + train)).max() > (level - now) / 2.0)
