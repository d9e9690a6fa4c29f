"""One shard of the overturning spectra: every n-th of them."""

from itertools import product

import pandas as pd

from replication.step import grid, run
from steps.shared.spectrum import CHANGES, FRAME, line, solve


def compute(settings: dict, shard: str) -> pd.DataFrame:
    """Return the spectra of frames, and of columns with the p̂ or the √r of the heaviest."""
    structures = [(FRAME, gamma) for gamma in settings["mass_ratios"]]
    structures += [(change, max(settings["mass_ratios"])) for change in CHANGES[1:]]
    ratios = [*map(float, grid(settings["frequency_ratios"]))]
    labels = [*product(structures, settings["slendernesses"], settings["shapes"])]
    number, of = map(int, shard.split("-of-"))
    return solve(
        [
            [line(*structure, *rest, ratio) for ratio in ratios]
            for structure, *rest in labels[number - 1 :: of]
        ],
        settings,
    )


if __name__ == "__main__":
    run(snakemake, compute)
