"""Outcome of the trilith against displacement amplitude and frequency of the shake table."""

import numpy as np

from replication.workbench import grid, run
from topheavy import Column, RockingFrame, simulate
from topheavy.ground.shaking_table import amplitude_to_uplift, table_acceleration, table_motion

CURVE = 361  # points of the curve of uplift, and those of the map


def main(settings: dict) -> tuple[list[dict], list[dict]]:
    """Return the outcomes, and the amplitudes that uplift the trilith over finer frequencies."""
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    rows = []
    frequencies = grid(settings["frequencies"])
    for frequency in frequencies:
        for amplitude in grid(settings["amplitudes"]):
            response = simulate(
                frame,
                table_motion(amplitude, frequency),
                duration=settings["cycles"] / frequency,
                samples=2,
            )
            rows.append(
                {
                    "frequency_hz": frequency,
                    "amplitude_mm": 1e3 * amplitude,
                    "acceleration_g": table_acceleration(amplitude, frequency),
                    "outcome": response.outcome,
                    "peak_over_alpha": response.peak_rotation / frame.slenderness,
                }
            )
    fine = np.union1d(frequencies, np.linspace(frequencies[0], frequencies[-1], CURVE))
    uplift = [
        {"frequency_hz": f, "amplitude_to_uplift_mm": 1e3 * amplitude_to_uplift(frame, f)}
        for f in fine
    ]
    return rows, uplift


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
