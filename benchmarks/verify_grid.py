"""Compare outcomes outside the benchmark's grid with heyoka: `make verify-grid CELLS=40000`.

Every set has its own slenderness and mass ratio; a third of its cells lie at A/tan α from 1 to 1.2,
the others from 1 to 10, all at ω/p from 0.5 to 10. If a relative change of 1e-10 in the amplitude
changes heyoka's outcome, the cell is listed separately, since the two solvers may differ there. The
table goes to results/benchmark/; a full run also writes it to docs/.

Mixed histories follow (`mixtures`): unlike structures under records, with vertical motion and
without, against heyoka; and the bits of every mixture with one thread and two, and with registers
of two widths.
"""

import math
import os
import shutil
import sys
import warnings
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import mixtures
import numpy as np
import pandas as pd
from kernel import histories
from oracle import PulseOracle, RecordOracle

from topheavy import RockingBlock, RockingFrame
from topheavy.bodies.structures import Column

FULL = 40_000
SLIGHT = 1e-10
PIECE = 2000  # cells of a job
MIXED = 0.025  # histories of a mixture, over the cells of a set

#: Shape, linearised, α in degrees, γ, and the share of the cells that the set gets.
SINE = [(3, 0), (5, 1), (8, 0.5), (8, 4), (11, math.inf), (20, 0), (20, 2), (27, 0.5), (35, 0)]
SINE += [(35, 1)]
OTHERS = [
    ("one-cosine", False),
    ("half-sine", False),
    ("constant", False),
    ("ricker-symmetric", False),
    ("ricker-antisymmetric", False),
    ("one-sine", True),
    ("one-cosine", True),
    ("ricker-symmetric", True),
]
SETS = [("one-sine", False, *pair, 1.0) for pair in SINE]
SETS += [(*kind, *pair, 0.1) for kind in OTHERS for pair in [(5, 1), (20, 0)]]


def block_of(slenderness_deg: float, mass_ratio: float, linearised: bool) -> RockingBlock:
    """Return the block with p = 1; only α and √r matter."""
    alpha = math.radians(slenderness_deg)
    frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), mass_ratio)
    return RockingBlock(1.0, alpha, frame.restitution, linearised)


def cells_of(number: int, count: int, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return amplitudes (g) and frequencies ω/p of a set."""
    chance = np.random.default_rng(100 + number)
    frequencies = chance.uniform(0.5, 10.0, count)
    near, far = chance.uniform(1.0, 1.2, count), chance.uniform(1.0, 10.0, count)
    return np.where(chance.random(count) < 1 / 3, near, far) * level, frequencies


def compared(job: tuple[int, int, int]) -> pd.DataFrame:
    """Compare the Taylor solver with heyoka on the cells of a set from `start` on."""
    warnings.simplefilter("ignore")
    number, count, start = job
    shape, linearised, *pair, _ = SETS[number]
    block = block_of(*pair, linearised)
    alpha, restitution = block.slenderness, block.restitution
    amplitudes, frequencies = cells_of(number, count, alpha if linearised else math.tan(alpha))
    amplitudes, frequencies = (axis[start : start + PIECE] for axis in (amplitudes, frequencies))
    ours = histories(block, shape, amplitudes, frequencies)
    nudged = [
        histories(block, shape, amplitudes * (1.0 + sign * SLIGHT), frequencies)[0]
        for sign in (-1.0, 1.0)
    ]
    oracle = PulseOracle(shape, linearised)
    rows = []
    for i, (amplitude, frequency) in enumerate(zip(amplitudes, frequencies, strict=True)):
        truth = oracle(alpha, restitution, amplitude, frequency)
        differs, on_boundary = truth.overturned != ours[0, i], False
        if differs or nudged[0][i] != nudged[1][i]:
            flags = {
                oracle(alpha, restitution, amplitude * (1.0 + sign * SLIGHT), frequency).overturned
                for sign in (-1.0, 1.0)
            }
            on_boundary = len(flags | {truth.overturned}) > 1
        rows.append(
            {
                "set": number,
                "amplitude_g": amplitude,
                "frequency_ratio": frequency,
                "wrong": differs and not on_boundary,
                "on_boundary": on_boundary,
                "count_differs": not differs and truth.impacts != ours[2, i],
                "error": abs(truth.peak - ours[1, i]) / alpha,
            }
        )
    return pd.DataFrame(rows)


def mixed(job: tuple[int, int]) -> dict:
    """Compare the outcomes of a mixture under records with heyoka; return a row of its table."""
    warnings.simplefilter("ignore")
    number, count = job
    kind, linearised, ratio = mixtures.SETS[number]
    given, oracle = mixtures.mixture(number, count), RecordOracle(linearised, ratio is not None)
    peak, overturned, _ = mixtures.outcomes(given)
    wrong, on_boundary, errors = 0, 0, []
    for k in range(count):
        found = mixtures.truth(given, k, oracle)
        if found.overturned != overturned[k]:
            nudged = [mixtures.truth(given, k, oracle, sign * SLIGHT) for sign in (-1.0, 1.0)]
            near = {one.overturned for one in nudged} != {found.overturned}
            on_boundary, wrong = on_boundary + near, wrong + (not near)
        elif not found.overturned:
            errors.append(abs(found.peak - peak[k]) / given.blocks[given.which[k]].slenderness)
    return {
        "motion": kind if ratio is None else f"{kind} and vertical record, Δt × {ratio:g}",
        "equation": "linearised" if linearised else "exact",
        "structures": len(mixtures.STRUCTURES),
        "histories": count,
        "overturned": int(overturned.sum()),
        "wrong_flags": wrong,
        "on_boundary": on_boundary,
        "error_q50": np.quantile(errors, 0.5),
        "error_q99": np.quantile(errors, 0.99),
        "error_max": max(errors),
    }


def summary(cells: pd.DataFrame) -> pd.DataFrame:
    """Return one row a set."""
    rows = []
    for number, found in cells.groupby("set"):
        shape, linearised, slenderness, mass_ratio, _ = SETS[number]
        alike = found.error[~found.wrong & ~found.on_boundary].dropna()
        rows.append(
            {
                "pulse": shape,
                "equation": "linearised" if linearised else "exact",
                "slenderness_deg": slenderness,
                "mass_ratio": mass_ratio,
                "restitution": block_of(slenderness, mass_ratio, linearised).restitution,
                "cells": len(found),
                "wrong_flags": int(found.wrong.sum()),
                "on_boundary": int(found.on_boundary.sum()),
                "other_impact_counts": int(found.count_differs.sum()),
                "error_q50": alike.quantile(0.5),
                "error_q99": alike.quantile(0.99),
                "error_max": alike.max(),
            }
        )
    return pd.DataFrame(rows)


def main(count: int) -> int:
    jobs = [
        (number, cells, start)
        for number, (*_, share) in enumerate(SETS)
        for cells in [math.ceil(count * share)]
        for start in range(0, cells, PIECE)
    ]
    found = []
    with ProcessPoolExecutor(len(os.sched_getaffinity(0)), mp_context=get_context("spawn")) as pool:
        for done, piece in enumerate(pool.map(compared, jobs), 1):
            found.append(piece)
            print(f"\r{done} of {len(jobs)} pieces", end="", file=sys.stderr, flush=True)
        shaken = [(number, math.ceil(count * MIXED)) for number in range(len(mixtures.SETS))]
        together = pd.DataFrame(pool.map(mixed, shaken))
    cells = pd.concat(found)
    table, out = summary(cells), Path("results/benchmark")
    out.mkdir(parents=True, exist_ok=True)
    table.to_csv(out / "verify_grid.csv", index=False, float_format="%.4g")
    apart = cells[cells.wrong | cells.on_boundary]
    apart.to_csv(out / "verify_grid_cells.csv", index=False)
    together.to_csv(out / "verify_mixed.csv", index=False, float_format="%.4g")
    print("\r" + table.to_string(index=False))
    print(together.to_string(index=False))
    if len(apart):
        print("\nCells that are wrong, or on a boundary:", apart.to_string(index=False), sep="\n")
    if count >= FULL:
        shutil.copyfile(out / "verify_grid.csv", "docs/verify_grid.csv")
        shutil.copyfile(out / "verify_mixed.csv", "docs/verify_mixed.csv")
    differ = mixtures.same_bits(math.ceil(count * MIXED))
    wrong = int(table.wrong_flags.sum() + together.wrong_flags.sum())
    print(f"{wrong} wrong flags in {len(cells)} cells and {together.histories.sum()} histories")
    print(f"{differ} mixtures whose bits depend on the width of the registers")
    return 1 if wrong or differ else 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else FULL))
