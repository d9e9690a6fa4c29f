"""Outcome of the trilith against displacement amplitude and frequency of the shake table."""

from replication.workbench import grid, run
from topheavy import Column, RockingFrame, simulate
from topheavy.shaking_table import table_acceleration, table_motion


def main(case: dict) -> list[dict]:
    frame = RockingFrame(Column(**case["column"]), case["mass_ratio"])
    rows = []
    for frequency in grid(case["frequencies"]):
        for amplitude in grid(case["amplitudes"]):
            response = simulate(
                frame,
                table_motion(amplitude, frequency),
                duration=case["cycles"] / frequency,
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
    return rows


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case))
