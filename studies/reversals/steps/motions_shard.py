"""One shard of the ensemble: every n-th motion, on all structures, at all intensities."""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run
from steps.shared.outcomes import written
from steps.shared.spectrum import progress, shard_of
from topheavy import overturned_together
from topheavy.synthetic.ensemble import Draw, Subject, draws, factors, intensities, subjects


def outcomes(draw: Draw, under: list[Subject], levels, of: int) -> list[dict]:
    """Return a row for each structure: what becomes of it at each level.

    A structure with a share of the motions gets the first of each scenario, `of` to each.
    """
    record = draw.record()
    mine = [subject for subject in under if draw.number < subject.share * of]
    if not mine:
        return []
    scales = np.array([factors(subject, record, levels) for subject in mine])
    fell = overturned_together([subject.frame for subject in mine], record, scales)
    return [
        draw.labels | subject.labels | {"outcomes": written(row)}
        for subject, row in zip(mine, fell, strict=True)
    ]


def main(settings: dict, structures: dict, shard: str) -> pd.DataFrame:
    mine, levels = shard_of(draws(settings), shard), intensities(settings)
    under = [*subjects(settings, structures)]
    each = settings["runs"][settings["run"]]["motions"]
    found = (outcomes(draw, under, levels, each) for draw in mine)
    return pd.DataFrame(row for rows in progress(found, len(mine), "motions") for row in rows)


def work(job: Any) -> Any:
    return main(job.params.settings, job.params.structures, job.wildcards.scatteritem)


if __name__ == "__main__":
    run(snakemake, work)
