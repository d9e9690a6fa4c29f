"""A seeded sample of the outcomes of the rates, judged again: tighter, and by SciPy.

The sample takes all structures and families in turn. Every other cell is within 0.1 % of a
boundary, if the structure has one.
"""

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.outcomes import FALLS, read
from steps.shared.spectrum import progress
from studies.certainty.rated import grid, subjects, velocities
from studies.certainty.second import decided
from topheavy import Record, RockingBlock, judge, overturned_by, reference
from topheavy.synthetic.ensemble import first_draws

ROUTES = ("tightened", "second_route")
HALVINGS = 7  # of a step of the grid, in ln PGV: a boundary is then known to 0.1 %


def cell(
    block: RockingBlock,
    rows: pd.DataFrame,
    draws: dict,
    settings: dict,
    near: bool,
    random: np.random.Generator,
) -> tuple[bool, Record, bool]:
    """Return whether a random cell of a structure is near a boundary, its motion, its outcome."""
    pgvs, size, fell = velocities(settings), grid(settings).size, read(rows.outcomes) == FALLS
    changing = np.flatnonzero(np.diff(fell[:, :size]).any(axis=1))
    near = near and changing.size > 0
    at = int(random.choice(changing) if near else random.integers(len(rows)))
    row = rows.iloc[at]
    record = draws[row.family, row.scenario, row.motion].record()
    if not near:
        place = random.integers(pgvs.size)
        return near, record.scaled(pgvs[place] / row.pgv), fell[at, place]
    place = random.choice(np.flatnonzero(np.diff(fell[at, :size])))
    ends = beside(block, record, pgvs[place : place + 2] / row.pgv, fell[at, place])
    side = int(random.integers(2))
    return near, record.scaled(ends[side]), fell[at, place + side]


def overturns(block: RockingBlock, motion: Record, factor: float) -> bool:
    """Return whether a motion times a factor overturns a block."""
    return judge(block, motion.scaled(factor)).overturned


def beside(
    block: RockingBlock, record: Record, factors: np.ndarray, below: bool
) -> tuple[float, float]:
    """Return two factors just below and just above a change of the outcome between two others."""
    low, high = map(float, factors)
    for _ in range(HALVINGS):
        middle = (low * high) ** 0.5
        if overturned_by(block, record, [middle])[0] == below:
            low = middle
        else:
            high = middle
    return low, high


def main(
    settings: dict, ensemble: dict, shards: pd.DataFrame, tightened: float
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    under, families, found = subjects(settings), ensemble["families"], []
    every = first_draws(ensemble, settings["runs"][settings["run"]]["motions"])
    draws = {tuple(draw.labels.values()): draw for draw in every}
    groups = dict(iter(shards.groupby(["family", "structure", "mass_ratio", "lowered"])))
    random, points = np.random.default_rng(settings["seed"]), settings["sample"]["points"]
    for number in progress(range(points), points, "cells"):
        rest, near = divmod(number, 2)
        family, one = families[rest % len(families)], under[rest // len(families) % len(under)]
        rows = groups[family, *one.labels.values()]
        near, motion, falls = cell(one.block, rows, draws, settings, bool(near), random)
        fell = decided(partial(overturns, one.block, motion), 1.0)
        found.append(
            {"family": family, **one.labels, "near": near, "overturns": falls}
            | {"decided": fell is not None}
            | {"tightened": judge(one.block, motion, tolerance=tightened).overturned}
            | {"second_route": reference.judge(one.block, motion).overturned}
        )
    table = pd.DataFrame(found)
    return table, findings(table)


def findings(certainty_rates_check: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the outcomes that were judged again are the same, of those decided."""
    told = certainty_rates_check[certainty_rates_check.decided.astype(bool)]
    named = told.groupby(["structure", "mass_ratio", "lowered"])
    differ = {name: int((told[name] != told.overturns).sum()) for name in ROUTES}
    return {
        f"{name}_agrees": truth(
            len(told) > 0 and differ[name] == 0,
            cells=len(told),
            differ=differ[name],
            near_a_boundary=int(told.near.sum()),
            structures=named.ngroups,
            undecided=len(certainty_rates_check) - len(told),
        )
        for name in ROUTES
    }


def work(job: Any) -> tuple:
    shards = pd.concat(map(pd.read_csv, job.input.shards), ignore_index=True)
    return main(job.params.settings, job.params.ensemble, shards, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
