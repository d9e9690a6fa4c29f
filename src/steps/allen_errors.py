"""Error of the peak rotation in the model of Allen et al. (1986), and in each simplification."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.bodies.massless_columns import SIMPLIFICATIONS, simplified


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    rows = []
    for degrees in grid(settings["slendernesses"]):
        alpha = math.radians(degrees)
        column = Column(math.sin(alpha), math.cos(alpha))
        omega = settings["frequency_ratio"] * column.frequency_parameter
        for gamma in settings["mass_ratios"]:
            frame = RockingFrame(column, gamma)
            for ratio in grid(settings["amplitudes"]):
                pulse = Pulse(settings["shape"], ratio * column.uplift_acceleration, omega)
                exact = judge(frame, pulse)
                for model in SIMPLIFICATIONS:
                    other = judge(simplified(frame, model), pulse)
                    rows.append(
                        {
                            "slenderness_deg": degrees,
                            "mass_ratio": gamma,
                            "amplitude_over_uplift": ratio,
                            "model": model,
                            "exact_peak_over_alpha": exact.peak / alpha,
                            "peak_over_alpha": other.peak / alpha,
                            "relative_error": other.peak / exact.peak - 1.0,
                            "exact_overturned": exact.overturned,
                            "overturned": other.overturned,
                        }
                    )
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(allen_errors: pd.DataFrame) -> dict[str, Finding]:
    """Return the errors of each simplification, from the table of peaks."""
    found = {}
    for model, cells in allen_errors.groupby("model"):
        sound = cells.dropna(subset="relative_error")
        slender = sound[sound.slenderness_deg <= 10.0]
        found[model.replace(" ", "_")] = truth(
            True,
            median_error=np.median(np.abs(sound.relative_error)),
            largest_overestimate=sound.relative_error.max(),
            largest_underestimate=sound.relative_error.min(),
            median_error_up_to_10_deg=np.median(np.abs(slender.relative_error)),
            misjudged=int((cells.exact_overturned != cells.overturned).sum()),
            cells=len(cells),
        )
    return found


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
