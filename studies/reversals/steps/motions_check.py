"""A seeded sample of the ensemble judged again: at the tightened tolerance, nudged, and by SciPy.

Half of the sample is drawn from all cells, half within a per cent of a boundary of overturning.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import NUDGE
from steps.shared.outcomes import FALLS, STANDS, read
from steps.shared.spectrum import progress
from topheavy import Record, overturned_by, reference
from topheavy.structures import Structure
from topheavy.synthetic.ensemble import draws, factors, intensities, subjects

FINEST = 1e-6  # of a factor: how well a boundary is known around which cells are drawn


class Rows:
    """Rows of all shards, one after the other, of which few tables at a time are in memory."""

    def __init__(self, paths: list[str], some: Callable[[pd.DataFrame], pd.DataFrame]) -> None:
        self._read = lru_cache(maxsize=4)(lambda shard: some(pd.read_csv(paths[shard])))
        self._ends = np.cumsum([len(self._read(shard)) for shard in range(len(paths))])

    def __len__(self) -> int:
        return int(self._ends[-1])

    def __getitem__(self, number: int) -> pd.Series:
        shard = int(np.searchsorted(self._ends, number, side="right"))
        return self._read(shard).iloc[number - self._ends[shard]]  # from the end: negative


def those_that_change(table: pd.DataFrame) -> pd.DataFrame:
    """Return the rows in which some motions stand and some fall."""
    return table[table.outcomes.str.contains(STANDS) & table.outcomes.str.contains(FALLS)]


def boundary(structure: Structure, record: Record, low: float, high: float) -> float:
    """Return a factor between two of unlike outcome at which the outcome changes."""
    below = overturned_by(structure, record, [low])[0]
    while high - low > FINEST * high:
        middle = 0.5 * (low + high)
        if overturned_by(structure, record, [middle])[0] == below:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def main(
    settings: dict, structures: dict, paths: list[str], tightened: float
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    every, changing = Rows(paths, lambda table: table), Rows(paths, those_that_change)
    motions = {tuple(draw.labels.values()): draw for draw in draws(settings)}
    under = {tuple(subject.labels.values()): subject for subject in subjects(settings, structures)}
    levels, spec = intensities(settings), settings["sample"]
    rng = np.random.default_rng(settings["seed"])

    def again(number: int) -> dict:
        """Judge one cell of the sample; odd ones are moved close to a boundary."""
        near = number % 2 == 1
        some = changing if near else every
        run = some[rng.integers(len(some))]
        subject = under[run.structure, run.mass_ratio, run.as_large_as]
        record = motions[run.family, run.scenario, run.motion].record()
        scales = factors(subject, record, levels)
        if near:
            (letters,) = read([run.outcomes])
            at = rng.choice(np.flatnonzero(letters[1:] != letters[:-1]))
            edge = boundary(subject.frame, record, scales[at], scales[at + 1])
            factor = edge * (1.0 + rng.uniform(-spec["within"], spec["within"]))
        else:
            factor = rng.choice(scales)
        around = factor * np.array([1.0, 1.0 - NUDGE, 1.0 + NUDGE])
        first, *nudged = overturned_by(subject.frame, record, around)
        tight = overturned_by(subject.frame, record, [factor], tolerance=tightened)[0]
        found = {"near": near, "told": all(nudged) == any(nudged) == first, "tight": tight == first}
        if number < spec["second_route"]:
            other = reference.judge(subject.frame, record.scaled(factor)).overturned
            found["second_route"] = other == first
        return found

    cells = (again(number) for number in range(spec["points"]))
    sample = pd.DataFrame(progress(cells, spec["points"], "cells"))
    return sample, findings(sample)


def findings(reversals_sample: pd.DataFrame) -> dict[str, Finding]:
    """Return whether tolerance and SciPy change no outcome, from the table of the sample."""
    sample = reversals_sample
    told = sample[sample.told]
    routes = {"tightened": told.tight, "second_route": told.second_route.dropna().astype(bool)}
    return {
        f"{name}_agrees": truth(
            len(agrees) > 0 and agrees.all(),
            cells=len(agrees),
            differ=int((~agrees).sum()),
            near_a_boundary=int(told.near[agrees.index].sum()),
            not_told=len(sample) - len(told),
        )
        for name, agrees in routes.items()
    }


def work(job: Any) -> tuple:
    settings, structures = job.params.settings, job.params.structures
    return main(settings, structures, job.input.shards, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
