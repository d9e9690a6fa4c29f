"""Other solvers: SciPy's solve_ivp and heyoka, in their usual form and with our free-rocking stage.

Every history starts at the first uplift, with φ = 1e-17 instead of 0, so that no solver mistakes
the start for an impact. It is split at the end of the forcing, where a corner would cost a solver
many steps. Each impact is an event, and so is each turning point, for the peak. In the usual form,
the solver integrates the free rocking until the next rotation is less than a thousandth of α. With
our free-rocking stage, `free_rocking.ending` judges the state at the end of the forcing.

Time is τ = p t: the blocks have p = 1.
"""

import math

import heyoka as hy
from kernel import Found
from oracle import LOW
from scipy.integrate import solve_ivp

from topheavy.bodies.free_rocking import ending

START = 1e-17
FORCED_REST, FREE_REST = 1e-12, 1e-3  # of the next bounce, over α
LATE = 1e4  # τ at which an endless free motion is given up


def uplift(amplitude, frequency, level, time):
    """Return when a one-sine pulse next exceeds the level, and the side to which it rocks then."""
    if amplitude <= level:
        return math.inf, 1.0
    first = math.asin(level / amplitude) / frequency
    for half, side in ((0, -1.0), (1, 1.0)):
        begin = first + half * math.pi / frequency
        if time < (half + 1) * math.pi / frequency - first:
            return max(begin, time), side
    return math.inf, 1.0


def impact(t, y, _):
    """Where solve_ivp ends a flight: y = 0, on the way down."""
    return y[0]


def flat(t, y, _):
    """Where it ends the history: lying flat."""
    return y[0] - math.pi / 2.0


def turn(t, y, _):
    """Where the block turns back."""
    return y[1]


impact.terminal = flat.terminal = True
impact.direction = turn.direction = -1


def rests(block, rate, forced):
    """Return whether a rotation that starts at this rate is small enough to be neglected."""
    height = FORCED_REST if forced else FREE_REST
    return 0.5 * rate * rate < height * block.slenderness * math.sin(block.slenderness)


def judged(block, state, peak, impacts):
    """Return the outcome from the state at the end of the forcing, by our closed form."""
    end = ending(block, *state)
    return Found(end.overturned, max(peak, end.peak), impacts + end.impacts)


class SolveIvp:
    """SciPy's DOP853 under one-sine pulses, with a terminal event for every impact."""

    def __init__(self, block, tolerance, tail):
        self.block, self.tolerance, self.tail = block, tolerance, tail

    def __call__(self, amplitude, frequency):
        block, alpha, end = self.block, self.block.slenderness, 2.0 * math.pi / frequency
        level = math.tan(alpha)

        def moving(t, y, push):
            lean = alpha - y[0]
            return y[1], -math.sin(lean) + push * math.sin(frequency * t) * math.cos(lean)

        time, peak, impacts, later = 0.0, 0.0, 0, 0
        while True:
            time, side = uplift(amplitude, frequency, level, time)
            if time >= end:
                return Found(False, peak, impacts)
            state, height = (START, 0.0), 0.0
            while True:
                forced = time < end
                flight = solve_ivp(
                    moving,
                    (time, end if forced else LATE),
                    state,
                    method="DOP853",
                    rtol=self.tolerance,
                    atol=self.tolerance * alpha,
                    events=(impact, flat, turn),
                    args=(-side * amplitude if forced else 0.0,),
                )
                height = max([height, *(y[0] for y in flight.y_events[2])])
                peak, time, state = max(peak, height), flight.t[-1], flight.y[:, -1]
                if flight.status != 1:
                    if not forced:
                        return Found(False, peak, impacts)
                    if self.tail:
                        return judged(block, state, peak, impacts)
                    continue
                if flight.t_events[1].size:
                    return Found(True, math.nan, impacts + later)
                if height > LOW * alpha and forced:
                    impacts += 1
                elif height > LOW * alpha:
                    later += 1
                side, height = -side, 0.0
                state = (START, -block.restitution * state[1])
                if rests(block, state[1], forced):
                    if not forced:
                        return Found(False, peak, impacts)
                    if amplitude * abs(math.sin(frequency * time)) < level:
                        break


class _Heyoka:
    """heyoka's adaptive Taylor integrator of one side; at an impact it goes on, on the other side.

    `ground` is an expression in `hy.time`; parameter 0 is −s. (heyoka deep-copies its callbacks:
    functions stay the same, bound methods would not.)
    """

    def __init__(self, block, ground, tolerance, cooldown):
        self.block, self.forced, self.fallen = block, True, False
        self.peak, self.height, self.impacts = 0.0, 0.0, 0
        alpha, restitution = block.slenderness, block.restitution
        phi, rate = hy.make_vars("phi", "rate")
        push = hy.par[0] * ground

        def impact(integrator, _):
            self.impacts += int(self.height > LOW * alpha)
            self.height = 0.0
            integrator.state[0] = START
            integrator.state[1] *= -restitution
            integrator.pars[0] *= -1.0
            return not rests(block, integrator.state[1], self.forced)

        def flat(integrator, _):
            self.fallen = True
            return False

        def turn(integrator, time, _):
            integrator.update_d_output(time)
            self.height = max(self.height, integrator.d_output[0])
            self.peak = max(self.peak, self.height)

        down = hy.event_direction.negative
        patience = {} if cooldown is None else {"cooldown": cooldown}
        self.integrator = hy.taylor_adaptive(
            [(phi, rate), (rate, -hy.sin(alpha - phi) + push * hy.cos(alpha - phi))],
            tol=tolerance,
            t_events=[
                hy.t_event(phi, callback=impact, direction=down, **patience),
                hy.t_event(phi - math.pi / 2.0, callback=flat),
            ],
            nt_events=[hy.nt_event(rate, callback=turn, direction=down)],
        )


class Heyoka(_Heyoka):
    """heyoka under one-sine pulses."""

    def __init__(self, block, tolerance, tail, cooldown=None):
        super().__init__(block, hy.par[1] * hy.sin(hy.par[2] * hy.time), tolerance, cooldown)
        self.tail = tail

    def __call__(self, amplitude, frequency):
        block, integrator, end = self.block, self.integrator, 2.0 * math.pi / frequency
        level = math.tan(block.slenderness)
        self.peak, self.impacts, self.fallen, self.forced, time = 0.0, 0, False, True, 0.0
        while True:
            time, side = uplift(amplitude, frequency, level, time)
            if time >= end:
                return Found(False, self.peak, self.impacts)
            integrator.time, self.height = time, 0.0
            integrator.state[:] = START, 0.0
            integrator.pars[:] = -side, amplitude, frequency
            integrator.reset_cooldowns()
            integrator.propagate_until(end)
            while integrator.time < end and not self.fallen:
                if amplitude * abs(math.sin(frequency * integrator.time)) < level:
                    break  # it rests
                integrator.propagate_until(end)
            if self.fallen:
                return Found(True, math.nan, self.impacts)
            time = integrator.time
            if time < end:
                continue
            forced = self.impacts
            if self.tail:
                return judged(block, integrator.state, self.peak, forced)
            integrator.pars[1], self.forced = 0.0, False
            integrator.propagate_until(LATE)
            if self.fallen:
                return Found(True, math.nan, self.impacts)
            return Found(False, self.peak, forced)


def uplift_of_record(samples, step, level, time):
    """Return when a record next exceeds the level, and the side to which it rocks then."""
    k = min(int(time / step), len(samples) - 2)
    now = samples[k] + (samples[k + 1] - samples[k]) * (time / step - k)
    if abs(now) > level:
        return time, -math.copysign(1.0, now)
    while k < len(samples) - 1:
        first, last = samples[k], samples[k + 1]
        if abs(last) > level:
            sign = math.copysign(1.0, last)
            return max(time, step * (k + (sign * level - first) / (last - first))), -sign
        k += 1
    return math.inf, 1.0


class SolveIvpRecord:
    """SciPy's DOP853 under a record, never stepping farther than one sample."""

    def __init__(self, block, samples, step, tolerance):
        self.block, self.step, self.tolerance = block, step, tolerance
        self.samples = [float(sample) for sample in samples]

    def __call__(self):
        block, samples, step = self.block, self.samples, self.step
        alpha, level = block.slenderness, math.tan(block.slenderness)
        end = step * (len(samples) - 1)

        def at(t):
            k = min(int(t / step), len(samples) - 2)
            return samples[k] + (samples[k + 1] - samples[k]) * (t / step - k)

        def moving(t, y, side):
            lean = alpha - y[0]
            return y[1], -math.sin(lean) - side * at(t) * math.cos(lean)

        time, peak, impacts, standing, side = 0.0, 0.0, 0, True, 1.0
        while True:
            if standing:
                time, side = uplift_of_record(samples, step, level, time)
                if time == math.inf:
                    return Found(False, peak, impacts)
                state, standing, height = (START, 0.0), False, 0.0
            flight = solve_ivp(
                moving,
                (time, end),
                state,
                method="DOP853",
                rtol=self.tolerance,
                atol=self.tolerance * alpha,
                max_step=step,
                events=(impact, flat, turn),
                args=(side,),
            )
            height = max([0.0, *(y[0] for y in flight.y_events[2])])
            peak, time, state = max(peak, height), flight.t[-1], flight.y[:, -1]
            if flight.status != 1:
                return judged(block, state, peak, impacts)
            if flight.t_events[1].size:
                return Found(True, math.nan, impacts)
            impacts += int(height > LOW * alpha)
            side, state = -side, (START, -block.restitution * state[1])
            standing = rests(block, state[1], True) and abs(at(time)) < level


class HeyokaRecord(_Heyoka):
    """heyoka under a record at its best: one call a sample, which mostly takes one step."""

    def __init__(self, block, samples, step, tolerance, cooldown):
        super().__init__(block, hy.par[1] + hy.par[2] * hy.time, tolerance, cooldown)
        self.step = step
        self.samples = [float(sample) for sample in samples]

    def __call__(self):
        block, integrator, step, samples = self.block, self.integrator, self.step, self.samples
        level, pars, time, k = math.tan(block.slenderness), integrator.pars, 0.0, 0
        self.peak, self.impacts, self.fallen, standing = 0.0, 0, False, True
        while k < len(samples) - 1:
            begin = 0.0
            if standing:
                time, side = uplift_of_record(samples, step, level, time)
                if time == math.inf:
                    return Found(False, self.peak, self.impacts)
                k = int(time / step)
                begin, pars[0], self.height, standing = max(time - k * step, 0.0), -side, 0.0, False
                integrator.state[:] = START, 0.0
            integrator.time = begin
            pars[1], pars[2] = samples[k], (samples[k + 1] - samples[k]) / step
            integrator.propagate_until(step)
            while integrator.time < step and not self.fallen:
                if abs(pars[1] + pars[2] * integrator.time) < level:
                    time, standing = k * step + integrator.time, True
                    break
                integrator.propagate_until(step)
            if self.fallen:
                return Found(True, math.nan, self.impacts)
            if not standing:
                k += 1
        if standing:
            return Found(False, self.peak, self.impacts)
        return judged(block, integrator.state, self.peak, self.impacts)
