"""Time a history and a map by five solvers at equal error: python benchmarks/peers.py

A column rocks under one-sine pulses; SciPy, heyoka and MuJoCo compute a sample of the map. Each has
the largest tolerance at which the error of all peaks is below ERROR; MuJoCo, whose contacts are
compliant, has one time step. Dependency group: `bench`; C++ is left out where there is no compiler.
"""

import ctypes
import math
import shutil
import subprocess
import tempfile
from functools import partial
from pathlib import Path
from time import process_time
from timeit import repeat

import heyoka as hy
import numpy as np
from oracle import AT_REST, Flights, ended
from scipy.integrate import solve_ivp

from steps.beyond.rigid_bodies import OVERTURNED, WAIT, Bodies, motion
from topheavy import Cap, Column, Pulse, RockingBlock, judge
from topheavy.kernel.forcing import pulse_waveform
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.taylor import oscillator

ERROR = 1e-9  # of α
BLOCK = RockingBlock(1.0, math.atan(1 / 6), Column(0.5, 3.0).restitution)  # p = 1: ω is over p
ALPHA = BLOCK.slenderness
FREQUENCIES, AMPLITUDES = np.linspace(1.0, 8.0, 64), np.linspace(1.05, 6.0, 64)  # over p, tan α
N_SAMPLE, SEED = 40, 2014
TOLERANCES = 10.0 ** -np.arange(5.0, 15.5, 0.5)
ENGINE = Bodies(Column(0.5, 3.0), 0.5, 0.0, Cap(5.0, 1.0), 4e-4, in_row=1, is_planar=True)


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


def engine_peak(omega, amplitude):
    """Return the peak over α by MuJoCo; NaN if the column overturns."""
    p, highest = ENGINE.column.frequency_parameter, 1.0
    pulse = Pulse("one-sine", amplitude * ENGINE.column.uplift_acceleration, omega * p)
    for _, rotation in motion(ENGINE, pulse.excitation, pulse.duration + WAIT / (4.0 * p)):
        highest = min(highest, rotation[0, 2, 2])
        if highest < math.cos(OVERTURNED):
            return math.nan
    return math.acos(highest) / ALPHA


def compiled(folder):
    """Return the functions of peer.cpp, for one pulse and for many."""
    path, source = str(Path(folder, "peer.so")), str(Path(__file__).with_name("peer.cpp"))
    fast = ["-O3", "-march=native", "-ffast-math", "-fno-finite-math-only", "-shared", "-fPIC"]
    subprocess.run(["c++", *fast, source, "-o", path], check=True)
    library, real, many = ctypes.CDLL(path), ctypes.c_double, np.ctypeslib.ndpointer(float)
    library.peak.argtypes, library.peak.restype = [real] * 5, real
    library.peaks.argtypes = [real, real, many, many, ctypes.c_int, real]
    return library.peak, library.peaks


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
        "MuJoCo": lambda tolerance: engine_peak,
    }
    whole = {"this solver": lambda t: outcomes_of(*grid, tolerance=t, threads=1)}
    if shutil.which("c++"):
        with tempfile.TemporaryDirectory() as folder:
            one_by, many_by = compiled(folder)
        block = ALPHA, BLOCK.restitution
        solvers["scalar C++"] = lambda t: lambda *cell: one_by(*block, *cell, t)
        whole["scalar C++"] = lambda t: many_by(*block, w, a, w.size, t)
    least = None
    for name, solver in solvers.items():
        for tolerance in TOLERANCES if name != "MuJoCo" else TOLERANCES[:1]:
            solve = solver(tolerance)
            apart = np.abs([solve(*cell) for cell in sample] - reference)
            if np.array_equal(np.isnan(apart), np.isnan(reference)) and np.nanmax(apart) < ERROR:
                break
        one = partial(solve, *history), 1
        many = partial(lambda solve: [solve(*cell) for cell in sample], solve), N_SAMPLE
        if name in whole:
            many = partial(whole[name], tolerance), w.size
        times = np.array([min(repeat(f, timer=process_time, number=1)) / n for f, n in (one, many)])
        least = times if least is None else least
        print(
            f"{name}: {np.nanmax(apart):.0e} α off, {np.isnan(apart).sum()} overturn; "
            f"history, cell: {1e6 * times} µs,",
            times / least,
        )


if __name__ == "__main__":
    main()
