"""One shard of the overturning spectra: every n-th of their lines.

Amplitudes are over g tan α and frequencies over p of the solitary column, for every γ, and for the
linearised equation too, so that spectra can be compared.
"""

import itertools

import pandas as pd

from replication.workbench import grid, run
from steps.shared.spectrum import Line, line, shard_of, solve


def lines(settings: dict, shard: str = "1-of-1") -> list[Line]:
    """Return the lines of all spectra, in the order of the table, or those of a shard."""
    labels = itertools.product(
        settings["slendernesses"],
        settings["shapes"],
        settings["mass_ratios"],
        (False, True),
        map(float, grid(settings["frequency_ratios"])),
    )
    return [line(*each) for each in shard_of([*labels], shard)]


def main(settings: dict, shard: str) -> pd.DataFrame:
    return solve(lines(settings, shard), settings)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.wildcards.scatteritem))
