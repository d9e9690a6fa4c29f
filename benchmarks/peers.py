"""Time solvers at equal error, and count landings that they miss: python benchmarks/peers.py

A column rocks under one-sine pulses. This solver and a scalar C++ compute the whole map; SciPy,
CVODE, heyoka and two engines compute a sample of it. Each has the largest tolerance at which it
overturns the cells of the reference and the error of all its peaks is below ERROR; the engines,
whose contacts are compliant, have one time step. Dependency group: `bench`, on Python 3.12 or
later; C++ is left out where there is no compiler.

Then flights are pushed outward so that they dip below zero by a given depth and come up again: a
solver misses a landing where it sees none. Nor may it miss any of random flights.
"""

import ctypes
import math
import shutil
import subprocess
import tempfile
from functools import partial
from importlib.metadata import version
from itertools import product
from pathlib import Path
from time import process_time
from timeit import Timer

import dartpy
import heyoka as hy
import numpy as np
from oracle import AT_REST, Flights, ended
from scipy.integrate import solve_ivp
from sksundae.cvode import CVODE

from steps.beyond.inclinations import OVERTURNED, WAIT
from steps.beyond.rigid_bodies import Bodies, motion
from topheavy import STANDARD_GRAVITY, Cap, Column, Pulse, RockingBlock, judge, simulate
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
ENGINES = "MuJoCo", "DART"  # without a tolerance

MAX_STEP = 0.02  # over p: a bound on the steps of SciPy
DIPS = 10.0 ** -np.array([1.0, 2.0, 3.0, 4.0, 6.0, 8.0])  # of α: how far flights go below zero
RELEASE = 0.3  # of α: the rotation from which flights begin, inward
N_RANDOM = 150  # random flights
LATE = 1e-3  # over p: a landing that is later by more is another one


def curvature(time, rotation, parameters):
    """Return the second derivative of φ by Eq. (23) with p = 1."""
    alpha, size, omega = parameters
    return -math.sin(alpha - rotation) + size * math.sin(omega * time) * math.cos(alpha - rotation)


class Scipy:
    """The flights of `oracle.Flights` by `solve_ivp`, with its events."""

    def __init__(self, tolerance, method="DOP853", **options):
        self.options = {"method": method, "rtol": tolerance, "atol": tolerance * 0.01, **options}
        self.event, self.peak, self.highest = None, 0.0, 0.0

    def _solve(self, start, stop, state, parameters, events):
        def motion(t, y):
            return y[1], curvature(t, y[0], parameters)

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


class Cvode:
    """The flights of `oracle.Flights` by CVODE of SUNDIALS, with its roots."""

    def __init__(self, tolerance, method="Adams"):
        self.options = {"method": method, "rtol": tolerance, "atol": tolerance * 0.01}
        self.options["max_num_steps"] = 100_000
        self.event, self.peak, self.highest = None, 0.0, 0.0

    def _solve(self, start, stop, state, parameters, **events):
        def motion(t, y, rates):
            rates[:] = y[1], curvature(t, y[0], parameters)

        solver = CVODE(motion, **events, **self.options)
        return solver.solve(np.array([start, stop]), np.array(state))

    def push(self, start, stop, parameters):
        end = self._solve(start, stop, (0.0, 0.0), parameters).y[-1]
        return None if end[0] >= math.pi / 2 else (end[0], end[1])

    def fly(self, start, stop, state, parameters, pull):
        def events(t, y, values):
            values[:] = y[0], y[1], y[0] - math.pi / 2

        events.terminal, events.direction = [True, False, True], [-1, -1, 1]
        solution = self._solve(start, stop, state, parameters, eventsfn=events, num_events=3)
        self.event = None
        if solution.i_events is not None:
            landed, turned, flat = solution.i_events.astype(bool).T
            self.peak = max([self.peak, *solution.y_events[turned, 0]])
            self.event = "landing" if landed.any() else "flat" if flat.any() else None
        return solution.t[-1], tuple(solution.y[-1])


heyoka = partial(Flights, hy.par[1] * hy.sin(hy.par[2] * hy.time), False, 1.0)


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
    pulse = Pulse("one-sine", amplitude * BLOCK.uplift_acceleration, angular_frequency=omega)
    return judge(BLOCK, pulse, tolerance=tolerance).peak_rotation / ALPHA


def engine_peak(omega, amplitude):
    """Return the peak over α by MuJoCo; NaN if the column overturns."""
    p, highest = ENGINE.column.frequency_parameter, 1.0
    pulse = Pulse(
        "one-sine", amplitude * ENGINE.column.uplift_acceleration, angular_frequency=omega * p
    )
    for _, rotation in motion(ENGINE, pulse.excitation, pulse.duration + WAIT / (4.0 * p)):
        highest = min(highest, rotation[0, 2, 2])
        if highest < math.cos(OVERTURNED):
            return math.nan
    return math.acos(highest) / ALPHA


def dart_peak(omega, amplitude):
    """Return the peak over α by DART, a box on a box at its defaults; NaN if it overturns."""
    b, h, p = ENGINE.column.half_width, ENGINE.column.half_height, ENGINE.column.frequency_parameter
    world = dartpy.simulation.World()
    world.setTimeStep(ENGINE.seconds)
    skeletons = []
    for size, mass, base in (((100.0, 100.0, 2.0), 1.0, -1.0), ((2 * b, 2 * b, 2 * h), 1e4, h)):
        skeleton, shape = dartpy.dynamics.Skeleton(f"at {base}"), dartpy.dynamics.BoxShape(size)
        is_free = base > 0.0
        make = "createFreeJointAndBodyNodePair" if is_free else "createWeldJointAndBodyNodePair"
        joint, body = getattr(skeleton, make)()
        node = body.createShapeNode(shape)
        node.createCollisionAspect()
        node.createDynamicsAspect()
        node.getDynamicsAspect().setFrictionCoeff(ENGINE.friction)
        inertia, place = dartpy.dynamics.Inertia(), np.eye(4)
        inertia.setMass(mass)
        inertia.setMoment(shape.computeInertia(mass))
        body.setInertia(inertia)
        place[2, 3] = base
        joint.setTransformFromParentBodyNode(dartpy.math.Isometry3(place))
        world.addSkeleton(skeleton)
        skeletons.append(skeleton)
    pulse = Pulse(
        "one-sine", amplitude * ENGINE.column.uplift_acceleration, angular_frequency=omega * p
    )
    duration, highest = pulse.duration + WAIT / (4.0 * p), 0.0
    times = (np.arange(math.ceil(duration / ENGINE.seconds)) + 0.5) * ENGINE.seconds
    for push in pulse.excitation(times):
        world.setGravity([-push * STANDARD_GRAVITY, 0.0, -STANDARD_GRAVITY])
        world.step()
        highest = max(highest, abs(skeletons[1].getPositions()[1]))
        if highest > OVERTURNED:
            return math.nan
    return highest / ALPHA


def landing(solver, omega, amplitude, velocity):
    """Return when a flight first lands under the pulse by a solver; infinite if it sees none."""
    parameters = ALPHA, amplitude * math.tan(ALPHA), omega
    state = RELEASE * ALPHA, velocity
    time, _ = solver.fly(0.0, 2.0 * math.pi / omega, state, parameters, 0.0)
    return time if solver.event == "landing" else math.inf


def our_landing(tolerance, omega, amplitude, velocity):
    """Return when a flight first lands, by this library."""
    pulse = Pulse("one-sine", amplitude * BLOCK.uplift_acceleration, angular_frequency=omega)
    start = {"rotation": -RELEASE * ALPHA, "velocity": -velocity, "duration": pulse.duration}
    times = simulate(BLOCK, pulse, **start, samples=2, tolerance=tolerance).impact_times
    return times[0] if len(times) else math.inf


def dipping(random):
    """Return N_SAMPLE flights for each dip: ω/p, amplitude over that of uplift, velocity, time.

    The velocity is that with which a flight that nothing stops has its lowest point so far below
    zero, and the time is that of this point. The bisection is over heyoka's flights.
    """
    phi, rate = hy.make_vars("phi", "rate")
    force = hy.par[0] * math.tan(ALPHA) * hy.sin(hy.par[1] * hy.time)
    motion = [(phi, rate), (rate, -hy.sin(ALPHA - phi) + force * hy.cos(ALPHA - phi))]
    stop = [hy.t_event(rate, direction=hy.event_direction.positive)]
    integrator = hy.taylor_adaptive(motion, [0.0, 0.0], t_events=stop)

    def lowest(omega, amplitude, velocity):
        integrator.time, integrator.state[:] = 0.0, (RELEASE * ALPHA, velocity)
        integrator.pars[:] = amplitude, omega
        integrator.reset_cooldowns()
        turns = int(integrator.propagate_until(math.pi / omega)[0]) == -1
        return (integrator.time, integrator.state[0]) if turns else (math.nan, -math.inf)

    def flight(omega, amplitude, dip):
        slow, fast = -0.01 * ALPHA, -6.0 * ALPHA
        for _ in range(60):
            middle = (slow + fast) / 2.0
            is_low = lowest(omega, amplitude, middle)[1] < -dip * ALPHA
            slow, fast = (slow, middle) if is_low else (middle, fast)
        time, rotation = lowest(omega, amplitude, fast)
        is_there = abs(rotation / ALPHA + dip) < 0.01 * dip
        return (omega, amplitude, fast, time) if is_there else None

    flights = []
    while len(flights) < N_SAMPLE:
        pulse = random.uniform(2.0, 6.0), random.uniform(1.5, 5.0)
        at_each_dip = [flight(*pulse, dip) for dip in DIPS]
        if None not in at_each_dip:
            flights.append(at_each_dip)
    return [*zip(*flights, strict=True)]


def landings():
    """Print how many landings each solver misses, by dip, and of random flights."""
    random, exact = np.random.default_rng(SEED), heyoka(0.0)
    sets = dipping(random)
    pulses = random.uniform((2.0, 1.5, -3.0 * ALPHA), (6.0, 5.0, 0.0), (20 * N_RANDOM, 3)).tolist()
    landed = ((*pulse, landing(exact, *pulse)) for pulse in pulses)
    sets.append([flight for flight in landed if math.isfinite(flight[-1])][:N_RANDOM])
    print(f"landings missed of {[*map(len, sets)]}: dips of {DIPS} α, and random flights")
    solvers = {
        "this solver": lambda tolerance: partial(our_landing, tolerance),
        "heyoka": lambda tolerance: partial(landing, heyoka(tolerance)),
        f"DOP853, steps up to {MAX_STEP}/p": lambda tolerance: partial(
            landing, Scipy(tolerance, max_step=MAX_STEP)
        ),
    }
    for method in ("RK45", "DOP853", "LSODA", "Radau"):
        solvers[method] = lambda tolerance, method=method: partial(
            landing, Scipy(tolerance, method)
        )
    for method in ("Adams", "BDF"):
        solvers[f"CVODE {method}"] = lambda tolerance, method=method: partial(
            landing, Cvode(tolerance, method)
        )
    for (name, solver), tolerance in product(solvers.items(), (1e-6, 1e-9, 1e-12)):
        if (name, tolerance) == ("Radau", 1e-12):
            continue  # its steps are too many
        land = solver(tolerance)
        missed = [sum(land(*f[:3]) > f[3] + LATE for f in flights) for flights in sets]
        print(f"{name}, {tolerance:.0e}:", *missed)


def compiled(folder):
    """Return the functions of peer.cpp, for one pulse and for many."""
    path, source = str(Path(folder, "peer.so")), str(Path(__file__).with_name("peer.cpp"))
    fast = ["-O3", "-march=native", "-ffast-math", "-fno-finite-math-only", "-shared", "-fPIC"]
    subprocess.run(["c++", *fast, source, "-o", path], check=True)
    library, real, many = ctypes.CDLL(path), ctypes.c_double, np.ctypeslib.ndpointer(float)
    library.peak.argtypes, library.peak.restype = [real] * 5, real
    library.peaks.argtypes = [real, real, many, many, ctypes.c_int, real, many]
    library.peaks.restype = None
    return library.peak, library.peaks


def seconds(compute):
    """Return the processor time of a call, from as many as take 0.2 s: the first finds no cache."""
    timer = Timer(compute, timer=process_time)
    calls, _ = timer.autorange()
    return min(timer.repeat(number=calls)) / calls


def main():
    w, a = (grid.ravel() for grid in np.meshgrid(FREQUENCIES, AMPLITUDES))
    exact, cells = heyoka(0.0), np.transpose([w, a]).tolist()
    reference = np.array([peak(exact, *cell) for cell in cells])
    places = np.random.default_rng(SEED).choice(w.size, N_SAMPLE, replace=False)
    sample = [cells[place] for place in places]
    history = sample[int(np.flatnonzero(np.isfinite(reference[places]))[0])]
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
        "SciPy, bounded": lambda tolerance: partial(peak, Scipy(tolerance, max_step=MAX_STEP)),
        "CVODE": lambda tolerance: partial(peak, Cvode(tolerance)),
        "heyoka": lambda tolerance: partial(peak, heyoka(tolerance)),
        "MuJoCo": lambda tolerance: engine_peak,
        "DART": lambda tolerance: dart_peak,
    }
    whole = {"this solver": lambda t: outcomes_of(*grid, tolerance=t, threads=1).peaks / ALPHA}
    if shutil.which("c++"):
        with tempfile.TemporaryDirectory() as folder:
            one_by, many_by = compiled(folder)
        block = ALPHA, BLOCK.restitution
        solvers["scalar C++"] = lambda t: lambda *cell: one_by(*block, *cell, t)
        peaks = np.empty(w.size)
        whole["scalar C++"] = lambda t: many_by(*block, w, a, w.size, t, peaks) or peaks
    least = None
    for name, solver in solvers.items():
        for tolerance in TOLERANCES if name not in ENGINES else TOLERANCES[:1]:
            solve = solver(tolerance)
            compute = partial(lambda solve: [solve(*cell) for cell in sample], solve)
            expected = reference[places]
            if name in whole:
                compute, expected = partial(whole[name], tolerance), reference
            apart = np.abs(compute() - expected)
            if np.array_equal(np.isnan(apart), np.isnan(expected)) and np.nanmax(apart) < ERROR:
                break
        one, many = (partial(solve, *history), 1), (compute, expected.size)
        times = np.array([seconds(f) / n for f, n in (one, many)])
        least = times if least is None else least
        print(
            f"{name} at {tolerance:.0e}: {expected.size} cells, {np.nanmax(apart):.0e} α off, "
            f"{np.isnan(apart).sum()} overturn; "
            f"history, cell: {1e6 * times} µs,",
            times / least,
        )


if __name__ == "__main__":
    packages = "topheavy", "scipy", "heyoka", "scikit-sundae", "mujoco-core", "dartpy"
    print(", ".join(f"{package} {version(package)}" for package in packages))
    main()
    landings()
