"""Compute the outcome of a rocking history independently with heyoka.

The equation is that of the paper, integrated to rounding. The side is a separate state. We avoid
the cases in which heyoka's event detection is known to miss events:

- just after uplift φ = 0 is a triple root: as long as the ground pushes outward no impact is
  possible, and the motion is integrated without events;
- a start on the event itself hides the next one: after an impact φ starts at 1e-24, and the
  cooldown is zero (the default skips fast bounces);
- in a step much longer than a bounce the root finder gives up with a mere warning: the steps of
  short bounces are kept short.

Time is τ = p t, accelerations are in g.
"""

import math
from typing import NamedTuple

import heyoka as hy
import numpy as np

AT_REST = 1e-13  # peak of the next bounce normalised by α, on ground that cannot lift the block
LOW = 1e-6  # a rotation below this, normalised by α, is not counted as rocking


class Found(NamedTuple):
    """The outcome of a block; the peak is NaN if it overturned."""

    overturned: bool
    peak_rotation: float
    number_of_impacts: int


#: The end of each pulse over π/ω, and the phases at which it turns.
_SYMMETRIC = [0.0, math.sqrt(6.0), -math.sqrt(6.0)]
_ANTISYMMETRIC = [
    outer * math.sqrt(3.0 * (3.0 + inner * math.sqrt(6.0)))
    for outer in (1.0, -1.0)
    for inner in (1.0, -1.0)
]
SHAPES = {
    "one-sine": (2, [0.5 * math.pi, 1.5 * math.pi]),
    "one-cosine": (2, [math.pi]),
    "half-sine": (1, [0.5 * math.pi]),
    "constant": (1, []),
    "ricker-symmetric": (9, [4.5 * math.pi + y for y in _SYMMETRIC]),
    "ricker-antisymmetric": (9, [4.5 * math.pi + y for y in _ANTISYMMETRIC]),
}


def unit_pulse(shape, phase, sin, cos, exp):
    """Return the pulse of unit amplitude, of numbers or of heyoka's expressions."""
    if shape in ("one-sine", "half-sine"):
        return sin(phase)
    if shape == "one-cosine":
        return cos(phase)
    if shape == "constant":
        return 1.0 + 0.0 * phase
    y = phase - 4.5 * math.pi
    if shape == "ricker-symmetric":
        return (1.0 - y * y / 2.0) * exp(-(y * y) / 4.0)
    return (1.0 / 1.3801) * (y * y / 3.0 - 3.0) * (y / math.sqrt(3.0)) * exp(-(y * y) / 6.0)


class Flights:
    """heyoka's integrators of the motion on one side: one with events, one without.

    `ground` is −s times the ground acceleration, an expression in `hy.time` and the parameters 1
    and 2; parameter 0 is α. `gravity` is that over g, an expression in the parameters 3 and 4.
    """

    def __init__(self, ground, linearised, gravity=1.0, tolerance=0.0):
        phi, rate = hy.make_vars("phi", "rate")
        alpha = hy.par[0]
        if linearised:
            curvature = gravity * (phi - alpha) + ground
        else:
            curvature = -gravity * hy.sin(alpha - phi) + ground * hy.cos(alpha - phi)  # Eq. (23)
        self.event, self.peak, self.highest = None, 0.0, 0.0

        # heyoka deep-copies its callbacks: functions stay the same, bound methods would not.
        def land(integrator, _):
            if integrator.state[1] >= 0.0:
                return True
            self.event = "landing"
            return False

        def fall(integrator, _):
            self.event = "flat"
            return False

        def turn(integrator, time, _):
            integrator.update_d_output(time)
            self.peak = max(self.peak, integrator.d_output[0])
            self.highest = max(self.highest, integrator.d_output[0])

        down, up = hy.event_direction.negative, hy.event_direction.positive
        stops = [hy.t_event(phi, callback=land, direction=down, cooldown=0.0)]
        if not linearised:
            flat = phi - math.pi / 2.0
            stops.append(hy.t_event(flat, callback=fall, direction=up, cooldown=0.0))
        turns = [hy.nt_event(rate, callback=turn, direction=down)]
        blank = {"state": [0.0, 0.0], "tol": tolerance}
        equations = [(phi, rate), (rate, curvature)]
        self.watched = hy.taylor_adaptive(equations, t_events=stops, nt_events=turns, **blank)
        self.unwatched = hy.taylor_adaptive(equations, **blank)

    def push(self, time, stop, parameters):
        """Integrate from rest while the ground pushes outward; return the state, None if flat."""
        integrator = _set(self.unwatched, time, (0.0, 0.0), parameters)
        for at in np.linspace(time, stop, 30)[1:]:
            integrator.propagate_until(at)
            if integrator.state[0] >= math.pi / 2.0:
                return None
        return integrator.state[0], abs(integrator.state[1])

    def fly(self, time, stop, state, parameters, pull):
        """Integrate up to the next event or `stop`; return the time and the state there."""
        integrator = _set(self.watched, time, state, parameters)
        integrator.reset_cooldowns()
        self.event = None
        if state[0] < 1e-20 and pull > 0.0 and 4.0 * state[1] / pull < 0.3:
            bounce = 4.0 * state[1] / pull
            integrator.propagate_until(min(stop, time + 3 * bounce), max_delta_t=bounce / 2)
        if self.event is None:
            integrator.propagate_until(stop)
        return integrator.time, (integrator.state[0], integrator.state[1])


def _set(integrator, time, state, parameters):
    integrator.time = time
    integrator.state[:] = state
    integrator.pars[:] = parameters[: len(integrator.pars)]  # a constant pulse has no ω
    return integrator


class PulseOracle:
    """Outcomes under one shape of pulse."""

    def __init__(self, shape, linearised=False):
        self.shape, self.linearised = shape, linearised
        self.half_turns, self.turns = SHAPES[shape]
        pulse = unit_pulse(shape, hy.par[2] * hy.time, hy.sin, hy.cos, hy.exp)
        self.flights = Flights(hy.par[1] * pulse, linearised)

    def __call__(self, alpha, restitution, size, omega) -> Found:
        """Return the outcome for a pulse of amplitude `size` (g) and ω/p = `omega`."""
        flights = self.flights
        level = alpha if self.linearised else math.tan(alpha)
        end = math.pi * self.half_turns / omega
        time, impacts, flights.peak = 0.0, 0, 0.0

        def ground(at):
            phase = np.asarray(at) * omega
            return size * unit_pulse(self.shape, phase, np.sin, np.cos, np.exp)

        def first(holds, low, high):
            """Return when `holds` first becomes true in a scan that includes all turns of a."""
            turns = [turn / omega for turn in self.turns if low < turn / omega < high]
            times = np.sort(np.append(np.linspace(low, high, 4000), turns))
            found = holds(times)
            index = int(np.argmax(found))
            if index == 0:
                return times[0] if found[0] else None
            low, high = times[index - 1], times[index]
            for _ in range(80):
                middle = (low + high) / 2
                low, high = (low, middle) if holds(middle) else (middle, high)
            return high

        while True:
            time = first(lambda at: np.abs(ground(at)) > level, time, end) if time < end else None
            if time is None:
                return Found(False, flights.peak, impacts)
            side = -np.sign(ground(time))
            begin, inward = time, np.nextafter(time, end)
            time = first(lambda at, s=side: -s * ground(at) <= level, inward, end)
            time = end if time is None else time
            state = flights.push(begin, time, (alpha, -side * size, omega))
            if state is None:
                return Found(True, math.nan, impacts)
            flights.highest = 0.0
            while True:
                now = ground(time)
                parameters = (alpha, -side * size, omega)
                time, state = flights.fly(time, end, state, parameters, level + side * now)
                if flights.event == "flat":
                    return Found(True, math.nan, impacts)
                if flights.event is None:
                    return ended(self.linearised, alpha, restitution, state, flights.peak, impacts)
                impacts += int(flights.highest > LOW * alpha)
                velocity, side = -state[1] * restitution, -side
                state, flights.highest = (1e-24, velocity), 0.0
                pull = level - abs(ground(time))
                cosine = 1.0 if self.linearised else np.cos(alpha)
                if velocity <= 0.0 or (
                    pull > 0.0 and velocity**2 / (2 * pull * cosine) < AT_REST * alpha
                ):
                    break


class RecordOracle:
    """Outcomes under records: a restart at every sample, where the forcing has a corner."""

    def __init__(self, linearised=False, vertical=False):
        self.linearised = linearised
        weight = hy.par[3] + hy.par[4] * hy.time if vertical else 1.0
        self.flights = Flights(hy.par[1] + hy.par[2] * hy.time, linearised, weight)

    def follow(self, slenderness, restitution, pieces) -> Found:
        """Return the outcome for pieces: how long, and a and gravity (g) at both ends of each."""
        flights, alpha = self.flights, slenderness
        level = alpha if self.linearised else math.tan(alpha)
        flights.peak, impacts, moving, side, state = 0.0, 0, False, 1.0, (0.0, 0.0)
        flights.highest = 0.0
        for step, (first, last), (weight, final) in pieces:
            time, slope, change = 0.0, (last - first) / step, (final - weight) / step

            def push(sign, at, first=first, slope=slope, weight=weight, change=change):
                return sign * (first + slope * at) - level * (weight + change * at)

            def zero(sign, slope=slope, change=change, push=push):
                return -push(sign, 0.0) / (sign * slope - level * change)

            while time < step:
                if not moving:
                    lifted = [sign for sign in (1.0, -1.0) if push(sign, time) > 1e-14 * level]
                    later = [sign for sign in (1.0, -1.0) if push(sign, step) > 0.0]
                    if not lifted and not later:
                        break
                    side = -(lifted or later)[0]
                    time = time if lifted else zero(-side)
                    stop = step if push(-side, step) >= 0.0 else zero(-side)
                    parameters = (alpha, -side * first, -side * slope, weight, change)
                    state = flights.push(time, stop, parameters)
                    if state is None:
                        return Found(True, math.nan, impacts)
                    time, moving, flights.highest = stop, True, state[0]
                    continue
                parameters = (alpha, -side * first, -side * slope, weight, change)
                time, state = flights.fly(time, step, state, parameters, -push(-side, time))
                flights.highest = max(flights.highest, state[0])
                if flights.event == "flat":
                    return Found(True, math.nan, impacts)
                if flights.event is None:
                    flights.peak, time = max(flights.peak, state[0]), step
                    continue
                impacts += int(flights.highest > LOW * alpha)
                velocity, side = -state[1] * restitution, -side
                state, flights.highest = (1e-24, velocity), 0.0
                pull = -max(push(1.0, time), push(-1.0, time))
                low = pull > 0.0 and velocity**2 / (2 * pull) < AT_REST * alpha
                moving = velocity > 0.0 and not low
        if not moving:
            return Found(False, flights.peak, impacts)
        return ended(self.linearised, alpha, restitution, state, flights.peak, impacts)


def ended(linearised, slenderness, restitution, state, peak, impacts) -> Found:
    """Judge the state at the end of the forcing by its energy, in extended precision."""
    alpha, phi, rate = (np.longdouble(number) for number in (slenderness, *state))
    if linearised:
        surplus = rate**2 / 2 - (alpha - phi) ** 2 / 2
        barrier = alpha**2 / 2
    else:
        surplus = rate**2 / 2 + np.cos(alpha - phi) - 1
        barrier = 1 - np.cos(alpha)
    if rate < 0 and (phi <= alpha or surplus >= 0):
        surplus = (surplus + barrier) * np.longdouble(restitution) ** 2 - barrier
        if surplus >= 0:
            return Found(True, math.nan, impacts + 1)
    elif phi > alpha or surplus >= 0:
        return Found(True, math.nan, impacts)
    top = alpha - (np.sqrt(-2 * surplus) if linearised else np.arccos(1 + surplus))
    return Found(False, float(max(peak, phi, top)), impacts)
