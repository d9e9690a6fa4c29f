"""One shard of all motions: every n-th of each model, and what it overturns."""

from io import BytesIO

import numpy as np

from replication.step import run
from steps.shared.sweep import sweep


def compute(settings, break_even, structures, shard):
    content = BytesIO()
    np.savez_compressed(content, **sweep(settings, break_even, structures, shard))
    return {"outcomes": content.getvalue()}


if __name__ == "__main__":
    run(snakemake, compute)
