"""One shard of the motions: every n-th, on all structures, at all peak ground velocities."""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run
from steps.shared.outcomes import written
from steps.shared.spectrum import progress, shard_of
from studies.certainty.rated import Subject, subjects, velocities
from topheavy import overturned_together
from topheavy.synthetic.ensemble import Draw, first_draws


def outcomes(draw: Draw, under: list[Subject], pgvs: np.ndarray) -> list[dict]:
    """Return a row for each structure: which PGVs overturn it, and the PGV before scaling, m/s."""
    record = draw.record()
    own = record.peak_velocity
    fell = overturned_together([subject.block for subject in under], record, pgvs / own)
    return [
        draw.labels | {"pgv": own} | subject.labels | {"outcomes": written(row)}
        for subject, row in zip(under, fell, strict=True)
    ]


def main(settings: dict, ensemble: dict, shard: str) -> pd.DataFrame:
    every = first_draws(ensemble, settings["runs"][settings["run"]]["motions"])
    mine, under, pgvs = shard_of(every, shard), subjects(settings), velocities(settings)
    found = (outcomes(draw, under, pgvs) for draw in mine)
    return pd.DataFrame(row for rows in progress(found, len(mine), "motions") for row in rows)


def work(job: Any) -> Any:
    return main(job.params.settings, job.params.ensemble, job.wildcards.scatteritem)


if __name__ == "__main__":
    run(snakemake, work)
