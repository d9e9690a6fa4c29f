"""Time a history and a map by three solvers at equal error: python benchmarks/peers.py

A column rocks under one-sine pulses; SciPy and heyoka compute a sample of the map. Each solver has
the largest tolerance at which the error of all peaks is below ERROR. Dependency group: `bench`.
"""

import math
from functools import partial
from time import process_time
from timeit import repeat

import heyoka as hy
import numpy as np
from oracle import AT_REST, Flights, ended
from scipy.integrate import solve_ivp

from topheavy import Column, Pulse, RockingBlock, judge
from topheavy.kernel.forcing import pulse_waveform
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.taylor import oscillator

ERROR = 1e-9  # of α
BLOCK = RockingBlock(1.0, math.atan(1 / 6), Column(0.5, 3.0).restitution)  # p = 1: ω is over p
ALPHA = BLOCK.slenderness
FREQUENCIES, AMPLITUDES = np.linspace(1.0, 8.0, 64), np.linspace(1.05, 6.0, 64)  # over p, tan α
N_SAMPLE, SEED = 40, 2014
TOLERANCES = 10.0 ** -np.arange(5.0, 15.5, 0.5)


class Scipy:
    """The flights of `oracle.Flights` by DOP853 of `solve_ivp`, with its events."""

    def __init__(self, tolerance):
        self.options = {"method": "DOP853", "rtol": tolerance, "atol": tolerance * 0.01}
        self.event, self.peak, self.highest = None, 0.0, 0.0

    def _solve(self, start, stop, state, parameters, events):
        alpha, size, omega = parameters

        def motion(t, y):  # Eq. (23)
            push = size * math.sin(omega * t)
            return y[1], -math.sin(alpha - y[0]) + push * math.cos(alpha - y[0])

        return solve_ivp(motion, (start, stop), state, events=events, **self.options)

    def push(self, start, stop, parameters):
        end = self._solve(start, stop, (0.0, 0.0), parameters, None).y[:, -1]
        return None if end[0] >= math.pi / 2 else (end[0], end[1])

    def fly(self, start, stop, state, parameters, pull):
        land, turn, flat = lambda t, y: y[0], lambda t, y: y[1], lambda t, y: y[0] - math.pi / 2
        land.direction = turn.direction = -1.0
        land.terminal = flat.terminal = True
        solution = self._solve(start, stop, state, parameters, (land, turn, flat))
        self.peak = max([self.peak, *(y[0] for y in solution.y_events[1])])
        self.event = "landing" if len(solution.t_events[0]) else None
        self.event = "flat" if len(solution.t_events[2]) else self.event
        return solution.t[-1], tuple(solution.y[:, -1])


heyoka = partial(Flights, hy.par[1] * hy.sin(hy.par[2] * hy.time), False, float, 1.0)


def peak(flights, omega, amplitude):
    """Return the peak over α from the flights between impacts; NaN if the column overturns."""
    tan, half = math.tan(ALPHA), math.pi / omega
    size = amplitude * tan
    lift = math.asin(1.0 / amplitude) / omega  # of the first half wave; the second is alike
    flights.peak, moment = 0.0, 0.0
    for begin, side in ((lift, -1.0), (lift + half, 1.0)):
        if moment > begin:
            continue  # it still rocks
        moment = begin + half - 2.0 * lift  # so long the ground pushes outward
        state = flights.push(begin, moment, (ALPHA, -side * size, omega))
        while state is not None:
            pull, numbers = (
                tan + side * size * math.sin(omega * moment),
                (ALPHA, -side * size, omega),
            )
            moment, state = flights.fly(moment, 2.0 * half, state, numbers, pull)
            if flights.event is None:
                return (
                    ended(False, ALPHA, BLOCK.restitution, state, flights.peak, 0).peak_rotation
                    / ALPHA
                )
            if flights.event == "flat":
                return math.nan
            state, side = (1e-24, -state[1] * BLOCK.restitution), -side
            pull = tan - abs(size * math.sin(omega * moment))
            if pull > 0.0 and state[1] ** 2 / (2.0 * pull) < AT_REST * ALPHA:
                break
        if state is None:
            return math.nan
    return flights.peak / ALPHA


def ours(tolerance, omega, amplitude):
    pulse = Pulse("one-sine", amplitude * BLOCK.uplift_acceleration, omega)
    return judge(BLOCK, pulse, tolerance=tolerance).peak_rotation / ALPHA


def main():
    random = np.random.default_rng(SEED)
    sample = random.choice(FREQUENCIES, N_SAMPLE), random.choice(AMPLITUDES, N_SAMPLE)
    sample = np.transpose(sample).tolist()
    exact = heyoka(0.0)
    reference = np.array([peak(exact, *cell) for cell in sample])
    history = sample[int(np.flatnonzero(np.isfinite(reference))[0])]
    w, a = (grid.ravel() for grid in np.meshgrid(FREQUENCIES, AMPLITUDES))
    grid = (
        [oscillator(BLOCK)],
        pulse_waveform("one-sine"),
        np.zeros(w.size, int),
        w,
        a * math.tan(ALPHA),
    )
    solvers = {
        "this solver": lambda tolerance: partial(ours, tolerance),
        "SciPy's solve_ivp": lambda tolerance: partial(peak, Scipy(tolerance)),
        "heyoka": lambda tolerance: partial(peak, heyoka(tolerance)),
    }
    least = None
    for name, solver in solvers.items():
        for tolerance in TOLERANCES:
            solve = solver(tolerance)
            apart = np.abs([solve(*cell) for cell in sample] - reference)
            if np.array_equal(np.isnan(apart), np.isnan(reference)) and np.nanmax(apart) < ERROR:
                break
        one = partial(solve, *history), 1
        many = partial(lambda solve: [solve(*cell) for cell in sample], solve), N_SAMPLE
        if least is None:
            many = partial(outcomes_of, *grid, tolerance=tolerance, threads=1), w.size
        times = np.array([min(repeat(f, timer=process_time, number=1)) / n for f, n in (one, many)])
        least = times if least is None else least
        print(
            f"{name}: {np.nanmax(apart):.0e} α off; history, cell: {1e6 * times} µs,", times / least
        )


if __name__ == "__main__":
    main()
