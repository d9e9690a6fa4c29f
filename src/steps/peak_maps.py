"""Peak rotation of a column and its frames, against frequency and amplitude of a pulse."""

import pandas as pd

from replication.workbench import grid, run
from topheavy import Column, RockingFrame, overturning_map

DIGITS = 3  # of θmax/α, for a picture


def main(settings: dict) -> pd.DataFrame:
    """Return θmax/α (none where overturned): a row for γ and an amplitude, a column for ω/p."""
    column = Column(**settings["column"])
    ratios, amplitudes = grid(settings["frequency_ratios"]), grid(settings["amplitudes"])
    tables = []
    for gamma in settings["mass_ratios"]:
        found = overturning_map(
            RockingFrame(column, gamma),
            settings["shape"],
            ratios * column.frequency_parameter,
            amplitudes * column.uplift_acceleration,
        )
        peaks = (found.peak_rotation.to_numpy().T / column.slenderness).round(DIGITS)
        table = pd.DataFrame(peaks, columns=[f"{ratio:.6g}" for ratio in ratios])
        table.insert(0, "mass_ratio", gamma)
        table.insert(1, "amplitude_over_uplift", amplitudes)
        tables.append(table)
    return pd.concat(tables)


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
