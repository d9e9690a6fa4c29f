"""One shard of the ensemble: every n-th motion, on all that the steps of this study ask."""

from typing import Any

import numpy as np

from replication.workbench import run
from steps.shared.sweep import sweep
from studies.reversals.subjects import questions


def work(job: Any) -> None:
    asked = questions(**job.params.asked)
    found = sweep(asked, job.params.asked["motions"], job.wildcards.scatteritem)
    np.savez_compressed(job.output[0], **found)


if __name__ == "__main__":
    run(snakemake, work)
