"""A pulse whose minimum overturning acceleration falls with γ, and pulses for which it cannot.

For a pulse of one lobe it is proved to rise with γ. The other pulses are lines between a few values.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth, value
from steps.spectrum import progress
from studies.certainty.shapes import record, single_lobe
from topheavy import (
    Column,
    Record,
    RockingFrame,
    judge,
    overturned_by,
    overturning_intervals,
    reference,
    simulate,
)
from topheavy.linear import simulate_linear_exact
from topheavy.structures import Structure

SAMPLES = 1200  # of a history that is drawn
KEPT = 20  # shapes that a search varies
VARIED = 0.7  # of the shapes tried; the others are drawn anew


def lowest(structure: Structure, pulse: Record, amplitudes: dict) -> tuple[float, float]:
    """Bracket the minimum overturning amplitude (g tan α); infinite if none overturns."""
    scales = amplitudes["lowest"], amplitudes["highest"]
    found = overturning_intervals(
        structure, pulse, scales, resolution=amplitudes["resolution"], most_impacts=1
    )
    return found[0].lower if found else (math.inf, math.inf)


def outcomes(structure: Structure, pulse: Record, tightened: float) -> list[bool]:
    """Return whether a pulse overturns, by all routes."""
    block = structure.block()
    found = [
        judge(block, pulse, tolerance=tightened).overturned,
        reference.judge(block, pulse).overturned,
    ]
    if block.linearised:
        exact = simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2)
        found.append(exact.overturned)
    return found


def falling(case: dict, pulse: Record, linearised: bool, tightened: float) -> tuple[list, dict]:
    """Return the minimum amplitude for every γ, and whether it falls by the judgment of all routes.

    The routes are asked where the heaviest frame overturns and the lightest survives: just above
    the minimum of the one, and at amplitudes up to the minimum of the other.
    """
    column, rows = Column(**case["column"]), []
    for gamma in case["mass_ratios"]:
        block = RockingFrame(column, gamma).block()
        low, high = lowest(block.linear() if linearised else block, pulse, case["amplitudes"])
        rows.append(
            {"linearised": linearised, "mass_ratio": gamma, "lowest_low": low, "lowest_high": high}
        )
    first, last = rows[0], rows[-1]
    ends = [RockingFrame(column, row["mass_ratio"]).block() for row in (first, last)]
    light, heavy = (block.linear() if linearised else block for block in ends)
    above = last["lowest_high"] * (1.0 + case["beside"])
    survived = np.linspace(case["amplitudes"]["lowest"], first["lowest_low"], case["confirmed"])
    falls = outcomes(heavy, pulse.scaled(above), tightened)
    stands = [outcomes(light, pulse.scaled(a), tightened) for a in (*survived[:-1], above)]
    fall = 1.0 - last["lowest_high"] / first["lowest_low"]
    return rows, truth(
        fall > 0.0 and all(falls) and not np.any(stands),
        fall=fall,
        error=(first["lowest_high"] - first["lowest_low"]) / first["lowest_low"],
        routes=len(falls),
        amplitudes=len(stands),
        lightest=first["lowest_low"],
        heaviest=last["lowest_high"],
        resolution=case["amplitudes"]["resolution"],
    )


def search(case: dict) -> tuple[float, np.ndarray, float]:
    """Search for a shape whose minimum falls most from the lightest to the heaviest frame.

    Returns
    -------
    float, ndarray, float
        The ratio of the two minima, the values of the shape, and its duration in 1/p.
    """
    spec, column = case["search"], Column(**case["column"])
    random = np.random.default_rng(spec["seed"])
    scales = np.arange(spec["lowest"], spec["highest"], spec["step"])
    light, heavy = (RockingFrame(column, case["mass_ratios"][end]) for end in (0, -1))
    kept: list[tuple[float, np.ndarray, float]] = []
    for _ in progress(range(spec["trials"]), spec["trials"], "shapes"):
        if len(kept) > KEPT and random.random() < VARIED:
            _, values, duration = kept[random.integers(KEPT)]
            values = values + random.normal(0.0, 0.15, values.size)
            duration *= math.exp(random.normal(0.0, 0.1))
        else:
            values = random.uniform(-1.0, 1.0, spec["values"])
            duration = math.exp(random.uniform(math.log(1.5), math.log(25.0)))
        pulse = record(values, duration, column)
        alone = overturned_by(light, pulse, scales)
        if alone.any():
            framed = overturned_by(heavy, pulse, scales)
            minima = [scales[fell.argmax()] if fell.any() else math.inf for fell in (alone, framed)]
            kept.append((minima[1] / minima[0], values, duration))
            kept.sort(key=lambda shape: shape[0])
            del kept[3 * KEPT :]
    return kept[0]


def single_lobes(case: dict) -> dict:
    """Return whether every lobe overturns from one amplitude on, without impact, later if heavier.

    The range reaches from uplift to `highest`, so that the first interval is that of all
    amplitudes above its lower end when it has no upper one.
    """
    spec, random = case["lobes"], np.random.default_rng(case["lobes"]["seed"])
    exceptions, overturned = 0, 0
    for number in progress(range(spec["pulses"]), spec["pulses"], "lobes"):
        alpha = math.radians(random.uniform(*spec["slendernesses"]))
        column = Column(math.sin(alpha), math.cos(alpha))
        duration = math.exp(random.uniform(math.log(1.0), math.log(30.0)))
        pulse = record(single_lobe(random), duration, column)
        minima = []
        for gamma in case["mass_ratios"]:
            block = RockingFrame(column, gamma).block()
            found = overturning_intervals(
                block.linear() if number % 2 else block,
                pulse,
                (spec["lowest"], spec["highest"]),
                resolution=spec["resolution"],
            )
            exceptions += [interval.impacts for interval in found] not in ([], [0])
            exceptions += any(interval.upper is not None for interval in found)
            overturned += bool(found)
            minima.append(found[0].lower[1] if found else math.inf)
        exceptions += any(b < a * (1.0 - 1e-8) for a, b in zip(minima, minima[1:], strict=False))
    return truth(
        exceptions == 0 and overturned > 0,
        pulses=spec["pulses"],
        overturned=overturned,
        exceptions=exceptions,
    )


def against_the_theorem(case: dict, tightened: float) -> tuple[dict, pd.DataFrame]:
    """Return whether an extreme motion overturns the heavier frame alone, and without an impact."""
    spec = case["extreme"]
    alpha = math.radians(spec["slenderness"])
    column = Column(case["size"] * math.sin(alpha), case["size"] * math.cos(alpha))
    pulse = record(np.array(spec["values"]), spec["duration"], column)
    pulse = pulse.scaled(spec["amplitude"] / column.uplift_acceleration)
    histories, found = [], []
    time = np.linspace(0.0, 3.0 * pulse.duration, SAMPLES)
    for gamma in (case["mass_ratios"][0], case["mass_ratios"][-1]):
        frame = RockingFrame(column, gamma)
        found.append([gamma, *outcomes(frame, pulse, tightened)])
        histories.append(history("extreme", frame, pulse, time))
    ends = [judge(RockingFrame(column, gamma), pulse) for gamma, *_ in found]
    moving = histories[1].rotation_over_alpha.to_numpy()
    moving = moving[np.isfinite(moving) & (histories[1].time.to_numpy() > time[2])]
    holds = [row[1:] for row in found] == [[False, False], [True, True]]
    once = ends[1].impacts == 0 and bool((moving > 0.0).all() or (moving < 0.0).all())
    return truth(holds and once, amplitude=spec["amplitude"], routes=2), pd.concat(histories)


def history(name: str, frame: RockingFrame, pulse: Record, time: np.ndarray) -> pd.DataFrame:
    """Return a history over the duration of its pulse."""
    response = simulate(frame, pulse, samples=time)
    return pd.DataFrame(
        {
            "pulse": name,
            "mass_ratio": frame.mass_ratio,
            "time": time / pulse.duration,
            "acceleration": pulse.excitation(time),
            "rotation_over_alpha": response.rotation / frame.slenderness,
        }
    )


def main(case: dict, solver: dict) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    column, spec = Column(**case["column"]), case["pulse"]
    pulse = record(np.array(spec["values"]), spec["duration"], column, "optimised")
    rows, findings = [], {}
    for name, linearised in (("exact", False), ("linearised", True)):
        more, findings[f"falls_{name}"] = falling(case, pulse, linearised, solver["tightened"])
        rows += more
    middle = 0.5 * (findings["falls_exact"]["lightest"] + findings["falls_exact"]["heaviest"])
    time = np.linspace(0.0, 3.0 * pulse.duration, SAMPLES)
    histories = [
        history("optimised", RockingFrame(column, gamma), pulse.scaled(middle), time)
        for gamma in (case["mass_ratios"][0], case["mass_ratios"][-1])
    ]
    ratio, values, duration = search(case)
    findings |= {
        "fall": value(findings["falls_exact"]["fall"], findings["falls_exact"]["error"]),
        "search": value(ratio, 0.0, values=(values / np.abs(values).max()).round(3), duration=duration),
        "single_lobes": single_lobes(case),
    }
    findings["beyond_the_theorem"], extreme = against_the_theorem(case, solver["tightened"])
    return pd.DataFrame(rows), pd.concat([*histories, extreme]), findings


def work(job: Any) -> tuple:
    return main(job.params.case, job.params.solver)


if __name__ == "__main__":
    run(snakemake, work)
