"""Compare speed and error of the Taylor solver, solve_ivp and heyoka: `make benchmark`.

Each method runs the same seeded sample of cells of a grid of one-sine pulses, and the same
histories under records, at a ladder of tolerances. Our kernel is there twice: as maps, intervals
and fragility use it, with a history in each lane of the vector registers (on a record, one of 129
factors), and as the scalar kernel that `simulate` and `judge` use. Ratios are of the times at equal
99 % error of the peak, max|θ|/α, read off these work–precision curves. Times are processor times of
one thread, the least of several rounds in which every method has its turn, so that other work on
the machine disturbs them little. All is done three times: the published table has the median of
each value and ratio, the spread of the three values over their median, and the share of the
processors that other processes used meanwhile. A record without impacts is timed beside them: under
measured records, impacts limit the ratio of both kernels. The tables go to results/benchmark/ and,
as the picture, to docs/.
"""

import math
import os
import statistics
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path

import fresh_process
import mixtures
import numpy as np
import pandas as pd
import picture
from kernel import Found, KernelRecord, ScalarRecord, histories, scalar_factors, scalar_histories
from kernel import together as kernel_together
from oracle import PulseOracle, RecordOracle
from peers import Heyoka, HeyokaRecord, SolveIvp, SolveIvpRecord
from verify_grid import block_of

from steps.publish import machine
from topheavy import Column, Record, RockingFrame, read_at2
from topheavy.kernel.forcing import RECORD, SHAPES, prepare_record, prepare_two_records
from topheavy.kernel.grid import LANES, outcomes_of
from topheavy.kernel.outcome import TOLERANCE
from topheavy.kernel.taylor import oscillator

OUT = Path("results/benchmark")
BLOCK = block_of(14, 1, linearised=False)
SEED, SAMPLE, ROUNDS = 2014, 400, 4
RUNS = 3  # of the whole; an odd number has a median among its values
QUIET = 0.03  # the share of the processors that other processes may use
TIMES = 10  # so often is the sample in one call of our kernel
EQUAL = 1e-8  # the 99 % error at which times are compared
TINY = 1e-14  # heyoka's cooldown when it is at its best

RECORDS = [("el_centro_1940_NS", 2.0), ("ridgecrest_2019_CLC_360", 1.0)]
FRAMES = [
    RockingFrame(Column(0.5, 2.0), 0.5),
    RockingFrame(Column(0.5, 2.0), 2.0),
    RockingFrame(Column(1.0, 4.5), 1.0),
]

LADDERS = {
    "this kernel": (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, TOLERANCE, 1e-10, 1e-12),
    "solve_ivp": (1e-6, 1e-7, 1e-8, 1e-9, 1e-10),
    "solve_ivp on records": (1e-8, 1e-10, 1e-11, 1e-12, 1e-13),
    "heyoka": (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12, 1e-16),
}
TARGETS = {
    ("pulse", "scalar kernel"): 4.5 if LANES == 16 else 3.5,  # AVX-512, AVX2
    ("pulse", "solve_ivp"): 2000,
    ("pulse", "solve_ivp, our tail"): 400,
    ("pulse", "heyoka"): 100,
    ("pulse", "heyoka, our tail"): 18,
    ("record", "scalar kernel"): 4,
    ("record", "solve_ivp"): 5000,
    ("record", "heyoka"): 90,
}
WITH_VERTICAL = ("napa_2014_68150_090", "ridgecrest_2019_CLC_360")
LEVELS = np.linspace(0.5, 1.5, 9)  # factors on these, of each structure of `mixtures`


def grid() -> tuple[np.ndarray, np.ndarray]:
    """Return ω/p and amplitudes (g) of the 200 × 200 grid."""
    return np.linspace(0.5, 10.0, 200), math.tan(BLOCK.slenderness) * np.linspace(1.0, 10.0, 200)


def sample() -> tuple[np.ndarray, np.ndarray]:
    """Return the amplitudes and frequencies of the cells that every method runs."""
    frequencies, amplitudes = grid()
    cells = np.random.default_rng(SEED).choice(frequencies.size**2, SAMPLE, replace=False)
    return amplitudes[cells % amplitudes.size], frequencies[cells // amplitudes.size]


def least_times(works: dict, rounds: int) -> dict[object, tuple[float, object]]:
    """Return by key the least time of a run, and what it returned.

    Each work is a function and how often it runs in a round.
    """
    found = dict.fromkeys(works, (math.inf, None))
    for _ in range(rounds):
        for key, (work, repeats) in works.items():
            for _ in range(repeats):
                begin = time.process_time()
                result = work()
                found[key] = (min(found[key][0], time.process_time() - begin), result)
    return found


def judged(found: Sequence[Found], truth: Sequence[Found], scales: Sequence[float]) -> dict:
    """Return the errors of the outcomes; those of the peak are errors of max|θ|/α."""
    pairs = list(zip(found, truth, scales, strict=True))
    safe = [(a, b, s) for a, b, s in pairs if not (a.overturned or b.overturned)]
    errors = [float(abs(a.peak - b.peak)) / scale for a, b, scale in safe]
    return {
        "error_q50": np.quantile(errors, 0.5),
        "error_q99": np.quantile(errors, 0.99),
        "error_max": max(errors),
        "wrong_flags": sum(bool(a.overturned) != b.overturned for a, b, _ in pairs),
        "missed_impacts": sum(a.impacts != b.impacts for a, b, _ in pairs),
    }


def pulses() -> pd.DataFrame:
    """Return µs a history and the errors of every method and tolerance under one-sine pulses."""
    amplitudes, frequencies = sample()
    cells = list(zip(amplitudes.tolist(), frequencies.tolist(), strict=True))

    works: dict = {}
    many = (np.tile(amplitudes, TIMES), np.tile(frequencies, TIMES))
    for tolerance in LADDERS["this kernel"]:
        for method, run in (("this kernel", histories), ("scalar kernel", scalar_histories)):
            works[method, tolerance] = partial(run, BLOCK, "one-sine", *many, tolerance), 4
    for tail, called, cooldown in ((False, "", None), (True, ", our tail", TINY)):
        for tolerance in LADDERS["solve_ivp"]:
            method = SolveIvp(BLOCK, tolerance, tail)
            works[f"solve_ivp{called}", tolerance] = partial(each, method, cells), 1
        for tolerance in LADDERS["heyoka"]:
            method = Heyoka(BLOCK, tolerance, tail, cooldown)
            works[f"heyoka{called}", tolerance] = partial(each, method, cells), 2
    timed = least_times(works, ROUNDS)
    for method, tolerance in timed:
        if method.endswith("kernel"):
            seconds, found = timed[method, tolerance]
            rows = [Found(bool(over), peak, int(count)) for over, peak, count in found.T[:SAMPLE]]
            timed[method, tolerance] = seconds / TIMES, rows
    return curves("pulse", timed, true_pulses(), [BLOCK.slenderness] * SAMPLE)


@cache
def true_pulses() -> list[Found]:
    """Return what is exact to far more digits than any method gives."""
    oracle = PulseOracle("one-sine", precision=np.longdouble)
    cells = zip(*(values.tolist() for values in sample()), strict=True)
    return [oracle(BLOCK.slenderness, BLOCK.restitution, *cell) for cell in cells]


def each(method: Callable[[float, float], Found], cells: list) -> list[Found]:
    return [method(*cell) for cell in cells]


def shaken() -> list[tuple]:
    """Return block, samples and p Δt of every history under a record; time is τ = p t."""
    cases = []
    for name, factor in RECORDS:
        record: Record = read_at2(f"data/records/{name}.AT2").scaled(factor)
        for frame in FRAMES:
            block = frame.block()
            step = block.frequency_parameter * record.time_step
            scaled = type(block)(1.0, block.slenderness, block.restitution)
            cases.append((scaled, record.acceleration, step))
    return cases


def records() -> pd.DataFrame:
    """Return µs a history and the errors of every method and tolerance under records."""
    cases = shaken()
    scales = [block.slenderness for block, *_ in cases]
    makes = {
        "this kernel": (KernelRecord, "this kernel", 3),
        "scalar kernel": (ScalarRecord, "this kernel", 3),
        "heyoka": (partial(HeyokaRecord, cooldown=TINY), "heyoka", 2),
        "solve_ivp": (SolveIvpRecord, "solve_ivp on records", 1),
    }
    works: dict = {}
    for method, (make, ladder, repeats) in makes.items():
        for tolerance in LADDERS[ladder]:
            runs = [make(*case, tolerance) for case in cases]
            works[method, tolerance] = partial(all_of, runs), repeats
    timed = least_times(works, 2)
    for method, tolerance in timed:
        seconds, found = timed[method, tolerance]
        timed[method, tolerance] = seconds / getattr(makes[method][0], "histories", 1), found
    return curves("record", timed, true_records(), scales)


@cache
def true_records() -> list[Found]:
    oracle = RecordOracle()
    return [oracle(b.slenderness, b.restitution, samples, h) for b, samples, h in shaken()]


def all_of(runs: list[Callable[[], Found]]) -> list[Found]:
    return [run() for run in runs]


def curves(what: str, timed: dict, truth: list[Found], scales: list[float]) -> pd.DataFrame:
    """Return the points of all work–precision curves, and print them."""
    rows = []
    for (method, tolerance), (seconds, found) in timed.items():
        point = {"what": what, "method": method, "tolerance": tolerance}
        point["microseconds"] = 1e6 * seconds / len(truth)
        rows.append(point | judged(found, truth, scales))
    table = pd.DataFrame(rows)
    print(table.to_string(index=False, float_format="{:.3g}".format), flush=True)
    return table


def at_equal_error(curve: pd.DataFrame) -> pd.Series:
    """Return the cheapest way to a 99 % error of `EQUAL`: a point of the curve, or between two.

    The errors are those of the tighter of the two points. If a method does not reach this error,
    the point with the least error is returned, and the ratio is a lower bound.
    """
    curve = curve.sort_values("tolerance", ascending=False)
    ways = [point for _, point in curve.iterrows() if point.error_q99 <= EQUAL]
    for (_, loose), (_, tight) in zip(curve[:-1].iterrows(), curve[1:].iterrows(), strict=True):
        if loose.error_q99 > EQUAL >= tight.error_q99:
            ends = np.log([tight.error_q99, loose.error_q99])
            costs = np.log([tight.microseconds, loose.microseconds])
            between = tight.copy()
            between["microseconds"] = math.exp(np.interp(math.log(EQUAL), ends, costs))
            between["error_q99"] = EQUAL
            ways.append(between)
    if not ways:
        return curve.loc[curve.error_q99.idxmin()]
    return min(ways, key=lambda way: way.microseconds)


def ratios(points: pd.DataFrame) -> list[dict]:
    """Return the rows of the published table for one history at equal error."""
    rows = []
    for what, group in points.groupby("what"):
        best = {method: at_equal_error(curve) for method, curve in group.groupby("method")}
        ours = best["this kernel"].microseconds
        default = group[(group.method == "this kernel") & (group.tolerance == TOLERANCE)].iloc[0]
        rows.append(published(what, "this kernel", "its default", "µs", default))
        for method, point in best.items():
            ratio = point.microseconds / ours
            target = TARGETS.get((what, method))
            more = {} if target is None else {"ratio": ratio, "target": f"≥ {target}"}
            reached = point.error_q99 <= EQUAL
            setting = "at equal error" if reached else "at its least error"
            rows.append(published(what, method, setting, "µs", point) | more)
    return rows


def published(what: str, method: str, setting: str, unit: str, point: pd.Series) -> dict:
    """Return a row of the published table from a point of a curve."""
    kept = ("error_q99", "error_max", "wrong_flags", "missed_impacts")
    first = {"what": f"{what}, one history", "method": method, "setting": setting}
    return first | {"value": point.microseconds, "unit": unit} | {k: point[k] for k in kept}


def wall(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def threads() -> list[dict]:
    """Return the whole grid on one thread and on two."""
    frequencies, amplitudes = grid()
    run = partial(
        outcomes_of, oscillator(BLOCK), SHAPES["one-sine"], frequencies, np.tile(amplitudes, 4)
    )
    walls = [[wall(partial(run, threads=n)) for n in (1, 2)] for _ in range(40)]
    one, two = (1e6 * min(times) / (4 * 200 * 200) for times in zip(*walls, strict=True))
    return [
        figure("the whole grid, one cell", "this kernel", "one thread, wall", one, "µs"),
        figure("the whole grid, one cell", "this kernel", "two threads, wall", two, "µs")
        | {"ratio": one / two, "target": "≥ 1.75"},
    ]


def together() -> list[dict]:
    """Return what a history costs among those of its structure, of many, and with vertical motion.

    As many factors in one range are tried, whether on one structure or on several.
    """
    given = [structure.block() for structure in mixtures.STRUCTURES]
    blocks, p = list(map(oscillator, given)), [one.frequency_parameter for one in given]
    count, works = len(blocks), {}
    factors = np.linspace(LEVELS[0], LEVELS[-1], LEVELS.size * count)
    mix = (np.tile(np.arange(count), LEVELS.size), np.repeat(LEVELS, count))
    for name in WITH_VERTICAL:
        across, up = (
            read_at2(f"data/records/{of}.AT2") for of in (name, f"{name.rpartition('_')[0]}_UP")
        )
        scales = across.time_step * np.array(p)
        record = prepare_record(across.acceleration)
        ratio = up.time_step / across.time_step
        both = prepare_two_records(across.acceleration, up.acceleration, ratio)
        works["mixed", name] = partial(kernel_together, blocks, scales, *mix, record), 4
        for place in range(count):
            alone = (blocks, scales, np.full(factors.size, place), factors)
            works["alone", name, place] = partial(kernel_together, *alone, record), 1
            works["vertical", name, place] = partial(kernel_together, *alone, both), 1
    timed = least_times(works, ROUNDS)
    cost = {
        kind: 1e6 * np.mean([timed[key][0] for key in timed if key[0] == kind]) / factors.size
        for kind in ("alone", "mixed", "vertical")
    }
    what = f"records, one of {factors.size} histories"
    settings = {"alone": "of one structure", "mixed": f"of {count} structures at once"}
    settings["vertical"] = "of one structure, with vertical motion"
    rows = {kind: figure(what, "this kernel", settings[kind], cost[kind], "µs") for kind in cost}
    for kind, most in (("mixed", 1.1), ("vertical", 1.5)):
        rows[kind] |= {"ratio": cost[kind] / cost["alone"], "target": f"≤ {most}"}
    return [*rows.values(), *without_impacts()]


def without_impacts() -> list[dict]:
    """Return what a history costs that has no impact, and the scalar kernel over it.

    Impacts limit the ratio under measured records, where a history has a hundred of them.
    """
    block, step = oscillator(BLOCK), 0.01
    record = prepare_record(np.full(600, 1.0005 * math.tan(BLOCK.slenderness)))
    factors = np.linspace(1.0, 1.001, 1024)
    lanes = partial(outcomes_of, block, RECORD, np.array([step]), factors, record, threads=1)
    scalar = partial(scalar_factors, block, step, factors, record)
    timed = least_times({"lanes": (lanes, 4), "scalar": (scalar, 2)}, ROUNDS)
    one, other = (1e6 * timed[key][0] / factors.size for key in ("lanes", "scalar"))
    what = "record without impacts, one history"
    return [
        figure(what, "this kernel", "its default", one, "µs"),
        figure(what, "scalar kernel", "its default", other, "µs") | {"ratio": other / one},
    ]


def processes() -> list[dict]:
    """Return time and memory of a fresh process that imports the package, or computes a map."""
    warm, cold, growth = fresh_process.warm(), fresh_process.cold(), fresh_process.growth()
    what = f"fresh process to a map of {fresh_process.CELLS} cells"
    imported = figure(
        "fresh process",
        "this kernel",
        "import, beyond NumPy's, processor",
        fresh_process.imported(),
        "s",
    )
    limits = [
        ("warm cache, wall", warm.wall, "s", 2.5),
        ("warm cache, processor", warm.processor, "s", None),
        ("warm cache, memory", warm.memory, "MB", 300.0),
        ("no cache, wall", cold.wall, "s", 12.0),
        ("no cache, processor", cold.processor, "s", None),
        ("no cache, memory", cold.memory, "MB", 400.0),
        ("memory from 13 to 26 times the cells, over their results", growth, "", 1.05),
    ]
    rows = [imported | {"target": "< 0.15"}]
    for setting, value, unit, limit in limits:
        more = {} if limit is None else {"target": f"< {limit:g}"}
        rows.append(figure(what, "this kernel", setting, value, unit) | more)
    return rows


def figure(what: str, method: str, setting: str, value: float, unit: str) -> dict:
    return {"what": what, "method": method, "setting": setting, "value": value, "unit": unit}


def median(runs: list[list[dict]]) -> pd.DataFrame:
    """Return each row from the run with its median value, with the median ratio and the spread."""
    rows = []
    for same in zip(*runs, strict=True):
        if len({(row["what"], row["method"], row["setting"]) for row in same}) > 1:
            raise RuntimeError(f"the runs have different rows: {same}")
        row = dict(sorted(same, key=lambda row: row["value"])[RUNS // 2])
        values = [other["value"] for other in same]
        row["spread"] = (max(values) - min(values)) / row["value"]
        if "ratio" in row:
            row["ratio"] = statistics.median(other["ratio"] for other in same)
        rows.append(row | met(row))
    return pd.DataFrame(rows)


def met(row: dict) -> dict[str, str]:
    """Return whether the row's ratio is at least or at most, or its value below, its target."""
    if "target" not in row:
        return {}
    sign, bound = row["target"].split()
    if sign == "<":
        reached = row["value"] < float(bound)
    else:
        reached = row["ratio"] >= float(bound) if sign == "≥" else row["ratio"] <= float(bound)
    return {"met": "yes" if reached else "no"}


@contextmanager
def others(shares: list[float]) -> Iterator[None]:
    """Append the share of the processors that other processes used (Linux)."""
    begin, busy, own = time.perf_counter(), busy_seconds(), sum(os.times()[:4])
    yield
    wall, busy, own = time.perf_counter() - begin, busy_seconds() - busy, sum(os.times()[:4]) - own
    shares.append((busy - own) / (wall * os.cpu_count()))


def busy_seconds() -> float:
    """Return for how long the processors have worked since the machine started."""
    user, nice, system, _idle, _wait, irq, softirq, steal, *_ = map(
        int, Path("/proc/stat").read_text().splitlines()[0].split()[1:]
    )
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    warnings.simplefilter("ignore")
    OUT.mkdir(parents=True, exist_ok=True)
    curves, runs, shares = [], [], []
    for _ in range(RUNS):
        with others(shares):
            curves.append(pd.concat([pulses(), records()]))
            runs.append(ratios(curves[-1]) + threads() + together() + processes())
    points = pd.concat(curves).groupby(["what", "method", "tolerance"], sort=False).median()
    points = points.reset_index()
    points.to_csv(OUT / "work_precision.csv", index=False, float_format="%.4g")

    load = figure("other processes", "", "share of the processors", 100 * max(shares), "%")
    load |= {"target": f"< {100 * QUIET:g}"}
    table = pd.concat([median(runs), pd.DataFrame([load | met(load)])], ignore_index=True)
    table.loc[len(table), ["what", "setting"]] = ["machine", machine()]
    for column in ("wrong_flags", "missed_impacts"):
        table[column] = table[column].astype("Int64")
    order = ["what", "method", "setting", "value", "unit", "spread", "error_q99", "error_max"]
    order += ["wrong_flags", "missed_impacts", "ratio", "target", "met"]
    table[order].to_csv("docs/benchmark.csv", index=False, float_format="%.4g")
    picture.draw(points, machine(), Path("docs/benchmark.svg"))
    print(table[order].to_string(index=False, na_rep=""))


if __name__ == "__main__":
    main()
