"""One shard of the motions: every n-th, on columns and frames with changed √r, at all levels."""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run
from steps.shared.outcomes import written
from steps.shared.spectrum import progress, shard_of
from studies.certainty.changed import Subject, columns, subjects
from studies.certainty.rated import stated
from topheavy import overturned_together
from topheavy.synthetic.ensemble import Draw, first_draws


def outcomes(draw: Draw, under: list[Subject], pgvs: np.ndarray) -> list[dict[str, Any]]:
    """Return a row for each structure: which of its levels, a row of `pgvs` (m/s), overturn it."""
    record = draw.record()
    blocks = [subject.block for subject in under]
    fell = overturned_together(blocks, record, pgvs / record.peak_velocity)
    return [
        draw.labels | subject.labels | {"outcomes": written(row)}
        for subject, row in zip(under, fell, strict=True)
    ]


def main(settings: dict, ensemble: dict, shard: str) -> pd.DataFrame:
    mine = shard_of(first_draws(ensemble, settings["runs"][settings["run"]]["motions"]), shard)
    of_each = [(column, subjects(column, settings)) for column in columns(settings)]
    under = [one for _, some in of_each for one in some]
    levels = [
        [pgv for *_, pgv in stated(column, settings)] for column, some in of_each for _ in some
    ]
    pgvs = np.array(levels)
    found = (outcomes(draw, under, pgvs) for draw in mine)
    return pd.DataFrame(row for rows in progress(found, len(mine), "motions") for row in rows)


def work(job: Any) -> Any:
    return main(job.params.settings, job.params.ensemble, job.wildcards.scatteritem)


if __name__ == "__main__":
    run(snakemake, work)
