"""Moment–rotation, the area that it encloses between impacts, and the period against amplitude."""

import math

import numpy as np

from replication.workbench import run, truth
from topheavy import Column, RockingBlock, RockingFrame, simulate
from topheavy.free_rocking import energy_drift, quarter_period
from topheavy.moment_rotation import restoring_moment


def quarter_periods(case: dict) -> list[dict]:
    """Quarter periods by quadrature of the energy integral and by simulation, both times p."""
    rows = []
    for degrees in case["quarter_period_slendernesses"]:
        exact = RockingBlock(1.0, math.radians(degrees), 1.0)
        for block in (exact, exact.linear()):
            for fraction in case["start_fractions"]:
                start = fraction * block.slenderness
                by_energy, _ = quarter_period(block, start)
                simulated = simulate(block, rotation=start, duration=10.0, samples=2).impacts[0]
                rows.append(
                    {
                        "slenderness_deg": degrees,
                        "linearised": block.linearised,
                        "start_fraction": fraction,
                        "quarter_period": by_energy,
                        "difference_of_routes": abs(simulated - by_energy),
                    }
                )
    return rows


def main(case: dict) -> tuple[dict, list[dict], dict]:
    column = Column(**case["column"])
    alpha = column.slenderness
    fractions = np.linspace(-1.0, 1.0, 2 * case["points"] - 1)
    fractions = np.sort(np.append(fractions, -1e-12))  # the jump at θ = 0, from both sides
    moments = [
        {
            "mass_ratio": gamma,
            "rotation_fraction": fraction,
            "moment": moment,
        }
        for gamma in case["mass_ratios"]
        for fraction, moment in zip(
            fractions,
            restoring_moment(RockingFrame(column, gamma), fractions * alpha),
            strict=True,
        )
    ]
    rows = quarter_periods(case)
    blocks = [RockingFrame(column, gamma).block() for gamma in case["mass_ratios"]]
    drift = max(
        energy_drift(block, simulate(block, rotation=0.6 * alpha, samples=4000), flights=5)
        for block in blocks
    )
    positive = np.linspace(0.0, alpha, case["points"])
    solitary = restoring_moment(column, positive)
    periods = [row["quarter_period"] for row in rows if not row["linearised"]]
    slenderness = {row["slenderness_deg"] for row in rows}
    findings = {
        "moment_at_uplift": truth(solitary[0] == math.sin(alpha), moment=solitary[0]),
        "moment_decreases_to_zero": truth(
            np.all(np.diff(solitary) < 0.0) and abs(solitary[-1]) < 1e-15, at_alpha=solitary[-1]
        ),
        "no_area_enclosed": truth(drift < 1e-8, largest_relative_drift=drift),
        "period_depends_on_amplitude": truth(
            all(
                np.all(
                    np.diff(
                        [
                            row["quarter_period"]
                            for row in rows
                            if row["slenderness_deg"] == degrees and not row["linearised"]
                        ]
                    )
                    > 0.0
                )
                for degrees in slenderness
            ),
            least=min(periods),
            largest=max(periods),
            difference_of_routes=max(row["difference_of_routes"] for row in rows),
        ),
    }
    return moments, rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case))
