"""One shard of all motions: every n-th of each model, and what it overturns."""

from io import BytesIO

import numpy as np

from replication.step import run
from steps.shared.sweep import sweep
from topheavy import Column


def compute(settings, break_even, structures, shard):
    column = Column(**structures[settings["structure"]])
    content = BytesIO()
    np.savez_compressed(content, **sweep(settings, break_even, column, shard))
    return {"outcomes": content.getvalue()}


if __name__ == "__main__":
    run(snakemake, compute)
