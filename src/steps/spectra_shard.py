"""One shard of the overturning spectra: every n-th of their lines.

Amplitudes are over g tan α and frequencies over p of the solitary column, for every γ, and for the
linearised equation too, so that spectra can be compared.
"""

import itertools
import math

import pandas as pd

from replication.workbench import grid, run
from steps.spectrum import Line, shard_of, solve
from topheavy import Column, Pulse, RockingFrame


def lines(case: dict, shard: str = "1-of-1") -> list[Line]:
    """Return the lines of all spectra, in the order of the table, or those of a shard."""
    labels = itertools.product(
        case["slendernesses"],
        case["shapes"],
        case["mass_ratios"],
        (False, True),
        map(float, grid(case["frequency_ratios"])),
    )
    return [line(*each) for each in shard_of([*labels], shard)]


def line(slenderness: float, shape: str, gamma: float, linearised: bool, ratio: float) -> Line:
    """Return the line of a frame whose columns have a slenderness in degrees."""
    alpha = math.radians(slenderness)
    column = Column(math.sin(alpha), math.cos(alpha))
    block = RockingFrame(column, gamma).block()
    labels = {
        "slenderness_deg": slenderness,
        "shape": shape,
        "mass_ratio": gamma,
        "linearised": linearised,
        "frequency_ratio": ratio,
    }
    return Line(
        labels,
        block.linear() if linearised else block,
        Pulse(shape, column.uplift_acceleration, ratio * column.frequency_parameter),
    )


def main(case: dict, shard: str) -> pd.DataFrame:
    return solve(lines(case, shard), case)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.wildcards.scatteritem))
