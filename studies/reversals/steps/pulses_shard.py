"""One shard of the spectra of this study: every n-th of their lines.

Each frame is taken whole, and with only its p̂ or only its √r put in place of the column's.
"""

from itertools import product

import pandas as pd

from replication.workbench import grid, run
from steps.shared.spectrum import Line, line, shard_of, solve
from topheavy import RockingBlock

CHANGES = ("both", "size", "restitution")
"""What of the column's p and √r a heavier cap changes; both in truth."""


def lines(settings: dict, shard: str = "1-of-1") -> list[Line]:
    """Return the lines of all spectra, or of a shard: frames, then the separated of some γ."""
    frames = [("both", gamma) for gamma in settings["mass_ratios"]]
    frames += product(CHANGES[1:], settings["separated"])
    ratios = map(float, grid(settings["frequency_ratios"]))
    labels = product(frames, settings["slendernesses"], settings["shapes"], ratios)
    return [
        changed_line(*spectrum, change, gamma, ratio)
        for (change, gamma), *spectrum, ratio in shard_of([*labels], shard)
    ]


def changed_line(slenderness: float, shape: str, change: str, gamma: float, ratio: float) -> Line:
    """Return the line of a frame, of which only the p̂ or the √r may be taken."""
    whole = line(slenderness, shape, gamma, False, ratio)
    column = line(slenderness, shape, 0.0, False, ratio).block
    block = changed(column, whole.block, change)
    return Line({"change": change} | whole.labels, block, whole.pulse)


def changed(column: RockingBlock, frame: RockingBlock, change: str) -> RockingBlock:
    """Return the frame; or the column of its size; or the column with its √r."""
    match change:
        case "both":
            return frame
        case "size":
            return frame.with_restitution(column.restitution)
        case "restitution":
            return column.with_restitution(frame.restitution)
    raise ValueError(f"change is {change!r}; expected one of {', '.join(CHANGES)}")


def main(settings: dict, shard: str) -> pd.DataFrame:
    return solve(lines(settings, shard), settings)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.wildcards.scatteritem))
