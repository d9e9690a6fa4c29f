"""A seeded sample of the ensemble judged again: at the tightened tolerance, nudged, and by SciPy.

Half of the sample is drawn from all cells, half within a per cent of a boundary of overturning.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import NUDGE
from steps.shared.spectrum import progress
from steps.shared.sweep import Swept, read_answers
from studies.reversals.subjects import frames_and_columns
from topheavy import Record, overturned_by
from topheavy.bodies.structures import Structure
from topheavy.second import reference

FINEST = 1e-6  # of a factor: how well a boundary is known around which cells are drawn


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
    settings: dict, structures: dict, answered: Mapping[str, Swept], tightened: float
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    asked, spec = frames_and_columns(settings, structures), settings["sample"]
    rng, every, changing = np.random.default_rng(settings["seed"]), [], []
    for name, swept in answered.items():
        fell = swept.outcomes
        both = fell.any(axis=-1) & ~fell.all(axis=-1)
        every += [(name, *place) for place in np.argwhere(np.ones_like(both)).tolist()]
        changing += [(name, *place) for place in np.argwhere(both).tolist()]

    def again(number: int) -> dict:
        """Judge one cell of the sample; odd ones are moved close to a boundary."""
        near = number % 2 == 1
        some = changing if near else every
        name, motion, place = some[rng.integers(len(some))]
        swept, block = answered[name], asked[name].subjects[place].block
        record = swept.draws[motion].record()
        scales = asked[name].levels / swept.peaks[motion]
        if near:
            at = rng.choice(np.flatnonzero(np.diff(swept.outcomes[motion, place])))
            edge = boundary(block, record, scales[at], scales[at + 1])
            factor = edge * (1.0 + rng.uniform(-spec["within"], spec["within"]))
        else:
            factor = rng.choice(scales)
        around = factor * np.array([1.0, 1.0 - NUDGE, 1.0 + NUDGE])
        first, *nudged = overturned_by(block, record, around)
        tight = overturned_by(block, record, [factor], tolerance=tightened)[0]
        found = {
            "near": near,
            "decided": all(nudged) == any(nudged) == first,
            "tight": tight == first,
        }
        if number < spec["second_route"]:
            other = reference.judge(block, record.scaled(factor)).overturned
            found["second_route"] = other == first
        return found

    cells = (again(number) for number in range(spec["points"]))
    sample = pd.DataFrame(progress(cells, spec["points"], "cells"))
    return sample, findings(sample)


def findings(reversals_sample: pd.DataFrame) -> dict[str, Finding]:
    """Return whether tolerance and SciPy change no outcome, from the table of the sample."""
    sample = reversals_sample
    told = sample[sample.decided]
    routes = {"tightened": told.tight, "second_route": told.second_route.dropna().astype(bool)}
    return {
        f"{name}_agrees": truth(
            len(agrees) > 0 and agrees.all(),
            cells=len(agrees),
            differ=int((~agrees).sum()),
            near_a_boundary=int(told.near[agrees.index].sum()),
            undecided=len(sample) - len(told),
        )
        for name, agrees in routes.items()
    }


def work(job: Any) -> tuple:
    settings, structures = job.params.settings, job.params.structures
    answered = {
        name: read_answers(job.input.shards, name, settings, asked.motions)
        for name, asked in frames_and_columns(settings, structures).items()
    }
    return main(settings, structures, answered, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
