"""Does the minimum overturning acceleration of a pulse always rise with γ?

For a pulse of one lobe it is proved. Other shapes, lines between a few values, are searched for a
fall; a fall that a finer search of the amplitudes removes is apparent only: it comes from a narrow
interval that overturns the lighter frame and that the coarse search misses.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth
from steps.shared.spectrum import progress
from studies.certainty.shapes import record, single_lobe
from studies.certainty.steps.theorem import at_once
from topheavy import (
    Column,
    Record,
    RockingFrame,
    judge,
    overturned_by,
    overturning_intervals,
    simulate,
)
from topheavy.bodies.structures import Structure
from topheavy.second import reference

SAMPLES = 1200  # of a history that is drawn
KEPT = 20  # shapes that a search varies
VARIED = 0.7  # of the shapes tried; the others are drawn anew
PAST = 1.0 + 1e-6
ROUNDING = 1e-8  # of a boundary


def minimum(structure: Structure, pulse: Record, highest: float, step: float) -> float:
    """Return the lowest amplitude (g tan α) of a grid from 1 on that overturns, or infinity."""
    scales = np.arange(1.0, highest * PAST, step)
    fell = overturned_by(structure, pulse, scales)
    return float(scales[fell.argmax()]) if fell.any() else math.inf


def search(settings: dict) -> tuple[list[dict], dict]:
    """Search for a shape whose minimum falls from the lightest to the heaviest frame.

    A coarse grid of amplitudes guides the search towards falls. Each shape that seems to fall on it
    is judged again on the finer grids, as long as it seems to.
    """
    spec, column = settings["search"], Column(**settings["column"])
    random = np.random.default_rng(spec["seed"])
    coarse, *finer = reversed(spec["steps"])
    light, heavy = (RockingFrame(column, settings["mass_ratios"][end]) for end in (0, -1))
    kept: list[tuple[float, np.ndarray, float]] = []
    rows: list[dict] = []
    shapes = 0
    for _ in progress(range(spec["trials"]), spec["trials"], "shapes"):
        if len(kept) > KEPT and random.random() < VARIED:
            _, values, duration = kept[random.integers(KEPT)]
            values = values + random.normal(0.0, 0.15, values.size)
            duration *= math.exp(random.normal(0.0, 0.1))
        else:
            values = random.uniform(-1.0, 1.0, spec["values"])
            duration = math.exp(random.uniform(math.log(1.5), math.log(25.0)))
        pulse = record(values, duration, column)
        first = minimum(light, pulse, spec["highest"], coarse)
        if first == math.inf:
            continue
        shapes += 1
        last = minimum(heavy, pulse, 1.5 * first, coarse)
        kept.append((last / first, values, duration))
        kept.sort(key=lambda shape: shape[0])
        del kept[3 * KEPT :]
        steps, ratios = iter(finer), [last / first]
        while ratios[-1] < 1.0 and (step := next(steps, None)) is not None:
            first = minimum(light, pulse, first, step)
            last = minimum(heavy, pulse, last, step)
            ratios.append(last / first)
        if ratios[0] < 1.0:
            rows.append(
                {
                    "coarse": ratios[0],
                    "last": ratios[-1],
                    "grids": len(ratios),
                    "duration": duration,
                }
                | {f"value_{k}": number for k, number in enumerate(values / np.abs(values).max())}
            )
    drawn = findings(pd.DataFrame(rows, columns=None if rows else ["coarse", "last"]))
    holds, *counts = drawn["no_fall_is_found"].items()
    return rows, truth(holds[1], shapes=shapes, **dict(counts), finest=finer[-1])


def findings(certainty_lowest: pd.DataFrame) -> dict[str, Any]:
    """Return what became of the shapes that seemed to fall; those that did not have no row."""
    confirmed = certainty_lowest["last"] < 1.0
    apparent = len(certainty_lowest)
    return {
        "no_fall_is_found": {
            "holds": apparent > 0 and not confirmed.any(),
            "apparent": apparent,
            "confirmed": int(confirmed.sum()),
            "largest_apparent": 1.0 - certainty_lowest.coarse.min() if apparent else 0.0,
        }
    }


def single_lobes(settings: dict, tightened: float) -> dict:
    """Return whether every lobe overturns from one amplitude on, without impact, later if heavier.

    Below and above one boundary of each lobe, SciPy judges too.
    """
    spec, random = settings["lobes"], np.random.default_rng(settings["lobes"]["seed"])
    exceptions, overturned, differ = 0, 0, 0
    for number in progress(range(spec["pulses"]), spec["pulses"], "lobes"):
        alpha = math.radians(random.uniform(*spec["slendernesses"]))
        column = Column(math.sin(alpha), math.cos(alpha))
        duration = math.exp(random.uniform(math.log(1.0), math.log(30.0)))
        pulse = record(single_lobe(random), duration, column)
        minima = []
        for gamma in settings["mass_ratios"]:
            block = RockingFrame(column, gamma).block()
            block = block.linear() if number % 2 else block
            scales = spec["lowest"], spec["highest"]
            level = block.uplift_acceleration / column.uplift_acceleration
            lobe = pulse.scaled(level)  # uplift begins at a scale of 1 in either equation
            found = overturning_intervals(block, lobe, scales, resolution=spec["resolution"])
            exceptions += len(found) > 1 or any(one.impacts or one.upper for one in found)
            overturned += bool(found)
            minima.append(found[0].lower if found else (math.inf, math.inf))
        exceptions += any(b[1] < a[0] * (1.0 - ROUNDING) for a, b in pairwise(minima))
        if minima[-1][1] < math.inf:
            for scale, falls in (
                (minima[-1][0] * (1 - 1e-4), False),
                (minima[-1][1] * (1 + 1e-4), True),
            ):
                scaled = lobe.scaled(scale)
                routes = judge(block, scaled, tolerance=tightened), reference.judge(block, scaled)
                differ += any(route.overturned != falls for route in routes)
    return truth(
        exceptions == 0 and overturned > 0 and differ == 0,
        pulses=spec["pulses"],
        overturned=overturned,
        exceptions=exceptions,
        routes_differ=differ,
    )


def extreme(settings: dict, spec: dict) -> tuple[Record, RockingFrame, RockingFrame]:
    """Return a motion beyond the theorem, and the lightest and the heaviest frame."""
    alpha = math.radians(spec["slenderness"])
    column = Column(settings["size"] * math.sin(alpha), settings["size"] * math.cos(alpha))
    values = np.repeat(spec["accelerations"], spec["samples"])
    pulse = record(values, spec["duration"], column)
    light, heavy = (RockingFrame(column, settings["mass_ratios"][end]) for end in (0, -1))
    return pulse.scaled(spec["amplitude"] / column.uplift_acceleration), light, heavy


def is_alone(settings: dict, spec: dict, tightened: float) -> tuple[bool, list[int]]:
    """Return whether both solvers overturn the heaviest frame alone without an impact.

    With the numbers of impacts of the lightest and the heaviest frame.
    """
    pulse, light, heavy = extreme(settings, spec)
    routes = {
        frame: (judge(frame, pulse, tolerance=tightened), reference.judge(frame, pulse))
        for frame in (light, heavy)
    }
    once = {
        frame: [end.overturned and not end.impacts for end in ends]
        for frame, ends in routes.items()
    }
    alone = at_once(heavy.block(), pulse) and all(once[heavy]) and not any(once[light])
    return alone, [ends[0].impacts for ends in routes.values()]


def against_the_theorem(settings: dict, tightened: float) -> tuple[dict, pd.DataFrame]:
    """Return whether an extreme motion overturns both frames without an impact, or neither.

    With the histories under the first of these motions.
    """
    specs = settings["extremes"]
    found = [is_alone(settings, spec, tightened) for spec in specs]
    pulse, *frames = extreme(settings, specs[0])
    time = np.linspace(0.0, 3.0 * pulse.duration, SAMPLES)
    evidence = {name: [spec[name] for spec in specs] for name in ("slenderness", "amplitude")}
    evidence["impacts"] = [impacts for _, impacts in found]
    evidence["exceptions"] = sum(alone for alone, _ in found)
    shown = [history(frame, pulse, time) for frame in frames]
    return truth(not any(alone for alone, _ in found), **evidence), pd.concat(shown)


def history(frame: RockingFrame, pulse: Record, time: np.ndarray) -> pd.DataFrame:
    """Return a history over the duration of its pulse."""
    response = simulate(frame, pulse, samples=time)
    return pd.DataFrame(
        {
            "mass_ratio": frame.mass_ratio,
            "time": time / pulse.duration,
            "acceleration": pulse.excitation(time),
            "rotation_over_alpha": response.rotation / frame.slenderness,
        }
    )


def main(settings: dict, solver: dict) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    rows, searched = search(settings)
    extreme, histories = against_the_theorem(settings, solver["tightened"])
    findings = {
        "no_fall_is_found": searched,
        "single_lobes": single_lobes(settings, solver["tightened"]),
        "exact_for_any_motion": extreme,
    }
    return pd.DataFrame(rows), histories, findings


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.solver)


if __name__ == "__main__":
    run(snakemake, work)
