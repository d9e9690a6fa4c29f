"""Compare the solvers with each other, and our numbers with the literature.

For the ensembles, a seeded sample represents all cells. Half of it comes from the grid, and half
lies within 1 % of an overturning boundary (in amplitude), where errors of the outcome are likely.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd
import sympy as sp

from replication.workbench import Finding, run, truth, value
from topheavy import (
    Column,
    Pulse,
    RockingBlock,
    RockingFrame,
    derivation,
    judge,
    overturning_intervals,
    simulate,
)
from topheavy.bodies.free_rocking import Ending, energy_drift
from topheavy.derivation.notation import alpha, gamma
from topheavy.ground.shapes import ELEMENTARY
from topheavy.second import reference
from topheavy.second.linear import simulate_linear_exact

PUBLISHED = 10  # numbers of the literature, at least
OF_PRINT = 0.005  # of a number: the prints, which have three digits, are that far off at most
Cell = tuple[RockingBlock, Pulse]


def cells(settings: dict, shape: str, *, linearised: bool) -> Iterator[Cell]:
    """Draw the seeded sample of one ensemble."""
    draw = np.random.default_rng(settings["seed"])
    for number in range(settings["cells"]):
        alpha = math.radians(draw.uniform(*settings["slendernesses"]))
        column = Column(math.sin(alpha), math.cos(alpha))
        block = RockingFrame(column, draw.choice(settings["mass_ratios"])).block()
        block = block.linear() if linearised else block
        omega = draw.uniform(*settings["frequency_ratios"]) * column.frequency_parameter
        ratio = draw.uniform(*settings["amplitudes"])
        level = block.uplift_acceleration
        if number % 2:
            found = overturning_intervals(
                block, Pulse(shape, level, omega), (1.0, settings["amplitudes"][1]), resolution=0.05
            )
            if found:
                ratio = found[0].lower[0] * (1.0 + draw.uniform(-0.01, 0.01))
        yield block, Pulse(shape, ratio * level, omega)


def compare(sample: list[Cell], route: Callable, other: Callable) -> dict:
    """Return the agreement of two solvers on a sample: outcomes, and peaks over α."""
    wrong, errors = 0, []
    for block, pulse in sample:
        first, second = route(block, pulse), other(block, pulse)
        wrong += first.overturned != second.overturned
        if not (first.overturned or second.overturned):
            errors.append(abs(first.peak - second.peak) / block.slenderness)
    return {
        "cells": len(sample),
        "verdicts_that_differ": wrong,
        "median_error": np.median(errors),
        "error_99": np.quantile(errors, 0.99),
        "largest_error": max(errors),
    }


def agreement(settings: dict, tightened: float) -> pd.DataFrame:
    """Compare the Taylor solver with SciPy, the exact solution, and a tighter tolerance."""

    def tight(block: RockingBlock, pulse: Pulse):
        return judge(block, pulse, tolerance=tightened)

    def exact(block: RockingBlock, pulse: Pulse):
        response = simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2)
        return Ending(response.overturned, response.peak_rotation, 0)

    rows = []
    for linearised in (False, True):
        for shape in settings["shapes"]:
            sample = list(cells(settings, shape, linearised=linearised))
            routes = {"SciPy integration": reference.judge, "tightened tolerance": tight}
            if linearised and shape in ELEMENTARY:
                routes["exact solution"] = exact
            for name, other in routes.items():
                equation = "linearised" if linearised else "exact"
                found = compare(sample, judge, other)
                rows.append({"equation": equation, "shape": shape, "against": name, **found})
                print(rows[-1])
    return pd.DataFrame(rows)


def convergence(settings: dict) -> pd.DataFrame:
    """Error of the peak against the tolerance of the kernel, on the sample of the first shape."""
    sample = list(cells(settings, settings["shapes"][0], linearised=False))
    best = [judge(*cell, tolerance=1e-14) for cell in sample]
    rows = []
    for tolerance in 10.0 ** np.arange(-4, -13, -1.0):
        errors = [
            abs(judge(*cell, tolerance=tolerance).peak - exact.peak) / cell[0].slenderness
            for cell, exact in zip(sample, best, strict=True)
            if not exact.overturned
        ]
        rows.append(
            {
                "tolerance": tolerance,
                "median_error": np.nanmedian(errors),
                "error_90": np.nanquantile(errors, 0.9),
            }
        )
    return pd.DataFrame(rows)


def drift(settings: dict) -> float:
    """Largest relative change of energy between two impacts of free rocking."""
    worst = 0.0
    for degrees in settings["slendernesses"]:
        block = RockingBlock(2.0, math.radians(degrees), 0.9)
        for each in (block, block.linear()):
            response = simulate(each, rotation=0.8 * block.slenderness, samples=4000)
            worst = max(worst, energy_drift(each, response, flights=6))
    return worst


def boundary(block: RockingBlock, pulse: Pulse, near: float, which: str = "lower") -> float:
    """Return the boundary of overturning of a pulse of 1 g nearest to one known to 2 %, in g."""
    around = (0.98 * near, 1.02 * near)
    found = overturning_intervals(block, pulse, around, resolution=1e-4 * near)
    ends = [getattr(interval, which) for interval in found if getattr(interval, which)]
    if which == "lower":
        ends = [end for end in ends if end[0] != end[1]]
    middles = [sum(end) / 2.0 for end in ends]
    return min(middles, key=lambda middle: abs(middle - near))


def published(settings: dict) -> pd.DataFrame:
    """The numbers of the literature, as printed and as computed here."""
    slender = RockingBlock(1.0, 0.25, 0.9, linearised=True)
    zhang = RockingBlock(2.14, 0.25, 0.9, linearised=True)
    peer = RockingBlock(2.0, math.radians(15.0), 0.89952)
    roussos = Column(0.2, 0.6).block().linear()
    heavy = RockingFrame(Column(0.75, 3.5), 13.23).block()
    free = simulate(slender, rotation=0.5 * 0.25, samples=2).impacts[0]
    bent = simulate(RockingBlock(1.0, 0.25, 1.0), rotation=0.9 * 0.25, duration=9.0, samples=2)
    decay = slender.with_restitution(math.sqrt(0.7))
    impacts = simulate(decay, rotation=0.5 * 0.25, samples=2).impacts
    fifth = simulate(
        decay, rotation=0.5 * 0.25, samples=np.linspace(impacts[4], impacts[5], 20001)[1:-1]
    )
    one_sine = Pulse("one-sine", 1.0, 5.0)
    near = {row["quantity"]: row["expected"] for row in settings["published"]}
    computed = {
        "housner_quarter_period": free,
        "exact_quarter_period": bent.impacts[0],
        "housner_decay": np.abs(fifth.rotation).max() / 0.25,
        "one_sine_with_impact": boundary(slender, one_sine, near["one_sine_with_impact"] * 0.25)
        / 0.25,
        "one_sine_end_of_impact_mode": boundary(
            slender, one_sine, near["one_sine_end_of_impact_mode"] * 0.25, "upper"
        )
        / 0.25,
        "one_sine_without_impact": boundary(
            slender, one_sine, near["one_sine_without_impact"] * 0.25
        )
        / 0.25,
        "one_sine_dimensional": boundary(
            zhang, Pulse("one-sine", 1.0, 15.7), near["one_sine_dimensional"]
        ),
        "one_cosine_exact": boundary(
            peer, Pulse("one-cosine", 1.0, math.pi), near["one_cosine_exact"]
        ),
        "half_sine_linear": boundary(
            roussos, Pulse("half-sine", 1.0, 2 * math.pi), near["half_sine_linear"]
        ),
        "heavy_frame_ricker": boundary(
            heavy, Pulse("ricker-symmetric", 1.0, 2 * math.pi / 3.14), near["heavy_frame_ricker"]
        ),
    }
    return pd.DataFrame(
        {
            "quantity": [row["quantity"] for row in settings["published"]],
            "source": [row["source"] for row in settings["published"]],
            "printed": [row["printed"] for row in settings["published"]],
            "expected": [row["expected"] for row in settings["published"]],
            "tolerance": [row["tolerance"] for row in settings["published"]],
            "computed": [computed[row["quantity"]] for row in settings["published"]],
        }
    )


def distance_from_derivation() -> float:
    """Return how far the library's formulas are from those that computer algebra derived.

    The largest difference of p̂/p, R̂/R, √r of column and frame, and g tan α over slenderness and γ.
    """
    frame = [sp.lambdify(gamma, f()) for f in (derivation.frequency_ratio, derivation.size_ratio)]
    frame_root = sp.lambdify((alpha, gamma), derivation.restitution())
    column_root = sp.lambdify(alpha, derivation.column_restitution())
    worst = 0.0
    for angle in np.radians(np.linspace(1.0, 60.0, 60)):
        column = Column(math.sin(angle), math.cos(angle))
        for ratio in (0.0, 0.1, 0.434, 1.0, 7.0, 100.0):
            ours = RockingFrame(column, ratio)
            pairs = [
                (ours.frequency_parameter / column.frequency_parameter, frame[0](ratio)),
                (ours.equivalent_size / column.size, frame[1](ratio)),
                (ours.restitution, frame_root(angle, ratio)),
                (column.restitution, column_root(angle)),
                (ours.uplift_acceleration, math.tan(angle)),
            ]
            worst = max(worst, *(abs(found - derived) for found, derived in pairs))
    return worst


def main(settings: dict, tightened: float) -> tuple[dict[str, pd.DataFrame], dict]:
    routes, order, literature = (
        agreement(settings, tightened),
        convergence(settings),
        published(settings),
    )
    lost, apart = drift(settings), distance_from_derivation()
    found = findings(routes, literature) | {
        "energy_drift": value(lost, 0.0),
        "library_follows_the_derivation": truth(apart < 1e-13, largest_difference=apart),
    }
    return {"routes": routes, "convergence": order, "published": literature}, found


def findings(
    verification_routes: pd.DataFrame, verification_published: pd.DataFrame
) -> dict[str, Finding]:
    """Return whether the solvers agree, and our numbers with the literature, from both tables."""
    routes, literature = verification_routes, verification_published
    off = (literature.computed - literature.expected).abs()
    off_print = (literature.computed / literature.printed - 1.0).abs()
    return {
        "routes_agree": truth(
            routes.verdicts_that_differ.sum() == 0 and routes.error_99.max() < 1e-6,
            comparisons=int(routes.cells.sum()),
            verdicts_that_differ=int(routes.verdicts_that_differ.sum()),
            error_99=routes.error_99.max(),
        ),
        "published_numbers": truth(
            len(literature) >= PUBLISHED
            and (off <= literature.tolerance).all()
            and (off_print < OF_PRINT).all(),
            numbers=len(literature),
            farthest_from_print=off_print.max(),
        ),
    }


def work(job: Any) -> tuple:
    tables, findings = main(job.params.settings, job.params.solver["tightened"])
    return tables["routes"], tables["convergence"], tables["published"], findings


if __name__ == "__main__":
    run(snakemake, work)
