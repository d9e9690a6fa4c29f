"""A seeded sample of the outcomes of the rates, judged again: tighter, and by SciPy.

The sample takes all structures and families in turn. Every other cell is within 0.1 % of a
boundary, if the structure has one.
"""

from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import decided, overturns
from steps.shared.spectrum import progress
from steps.shared.sweep import Swept, read_answers
from studies.certainty.subjects import grid, rated, velocities
from topheavy import Record, RockingBlock, judge, overturned_by
from topheavy.second import reference

ROUTES = ("tightened", "second_route")
HALVINGS = 7  # of a step of the grid, in ln PGV: a boundary is then known to 0.1 %


def cell(
    block: RockingBlock,
    swept: Swept,
    place: int,
    settings: dict,
    near: bool,
    random: np.random.Generator,
) -> tuple[bool, Record, bool]:
    """Return whether a random cell of a structure is near a boundary, its motion, its outcome."""
    pgvs, size, fell = velocities(settings), grid(settings).size, swept.outcomes[:, place]
    changing = np.flatnonzero(np.diff(fell[:, :size]).any(axis=1))
    near = near and changing.size > 0
    at = int(random.choice(changing) if near else random.integers(len(fell)))
    record, peak = swept.draws[at].record(), swept.peaks[at]
    if not near:
        level = random.integers(pgvs.size)
        return near, record.scaled(pgvs[level] / peak), fell[at, level]
    level = random.choice(np.flatnonzero(np.diff(fell[at, :size])))
    ends = beside(block, record, pgvs[level : level + 2] / peak, fell[at, level])
    side = int(random.integers(2))
    return near, record.scaled(ends[side]), fell[at, level + side]


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
    settings: dict, ensemble: dict, swept: Swept, tightened: float
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    under, families, found = rated(settings).subjects, ensemble["families"], []
    of_family = {family: swept.of_family(family) for family in families}
    random, points = np.random.default_rng(settings["seed"]), settings["sample"]["points"]
    for number in progress(range(points), points, "cells"):
        rest, near = divmod(number, 2)
        family, place = families[rest % len(families)], rest // len(families) % len(under)
        block = under[place].block
        near, motion, falls = cell(block, of_family[family], place, settings, bool(near), random)
        fell = decided(partial(overturns, block, motion), 1.0)
        found.append(
            {"family": family, **under[place].labels, "near": near, "overturns": falls}
            | {"decided": fell is not None}
            | {"tightened": judge(block, motion, tolerance=tightened).overturned}
            | {"second_route": reference.judge(block, motion).overturned}
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
    settings, ensemble = job.params.settings, job.params.ensemble
    swept = read_answers(job.input.shards, "rates", ensemble, settings["motions"])
    return main(settings, ensemble, swept, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
