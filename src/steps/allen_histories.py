"""Compare the exact frame and the model of Allen et al. (1986), under a pulse and a record."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy import Column, Pulse, RockingFrame, read_record, simulate
from topheavy.bodies.massless_columns import SIMPLIFICATIONS, simplified
from topheavy.second import reference
from topheavy.second.linear import simulate_linear_exact

CLOSE = 1e-8  # of α: how close the model is to its solution in closed form


def main(settings: dict, record_path: str, solver: dict) -> tuple[list[dict], pd.DataFrame, dict]:
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    pulse = Pulse(
        settings["pulse"]["shape"],
        settings["pulse"]["amplitude"],
        2 * math.pi / settings["pulse"]["period"],
    )
    motions = {
        "pulse": (pulse, 6.0 * settings["pulse"]["period"]),
        "record": (read_record(record_path).scaled(settings["record"]["factor"]), 30.0),
    }
    models = {"exact": frame.block()} | {name: simplified(frame, name) for name in SIMPLIFICATIONS}
    alpha = frame.slenderness
    rows, peaks = [], []
    for motion, (excitation, duration) in motions.items():
        times = np.linspace(0.0, duration, 1501)
        for model, block in models.items():
            response = simulate(block, excitation, samples=times)
            others = (
                simulate(block, excitation, samples=times, tolerance=solver["tightened"]),
                reference.simulate(block, excitation, samples=times),
            )
            apart = max(abs(other.peak_rotation - response.peak_rotation) for other in others)
            peak = {
                "motion": motion,
                "model": model,
                "outcome": response.outcome,
                "same_outcome_by_all": all(o.outcome == response.outcome for o in others),
                "peak_over_alpha": response.peak_rotation / alpha,
                "error_over_alpha": apart / alpha,
            }
            if model == "all":  # the linearised equation, which has a solution in closed form
                oracle = simulate_linear_exact(block, excitation, samples=times)
                solved = oracle.peak_rotation / alpha
                found = (0.0, 0.0)
                if not oracle.overturned:
                    found = (solved, abs(solved - response.peak_rotation / alpha))
                peak |= dict(zip(("solved_over_alpha", "solved_apart"), found, strict=True))
            peaks.append(peak)
            rows += [
                {
                    "motion": motion,
                    "model": model,
                    "time": t,
                    "acceleration": a,
                    "rotation_over_alpha": theta / alpha,
                }
                for t, a, theta in zip(
                    times, excitation.excitation(times), response.rotation, strict=True
                )
            ]
    table = pd.DataFrame(peaks)
    return rows, table, findings(table)


def findings(allen_peaks: pd.DataFrame) -> dict[str, Finding]:
    """Return the peak of each model under each motion, from the table of peaks."""
    apart = float(allen_peaks.solved_apart.max())
    stands = allen_peaks[allen_peaks.outcome != "overturned"]
    peaks = {
        motion: dict(zip(rows.model.str.replace(" ", "_"), rows.peak_over_alpha, strict=True))
        for motion, rows in stands.groupby("motion", sort=False)
    }
    return {
        "peaks_over_alpha": truth(
            allen_peaks.same_outcome_by_all.all() and apart < CLOSE,
            **peaks,
            largest_error=float(stands.error_over_alpha.max()),
            exact_solution_apart=apart,
        )
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.input.record, job.params.solver))
