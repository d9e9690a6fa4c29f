"""Compare the exact frame and the model of Allen et al. (1986), under a pulse and a record."""

import math

import numpy as np

from replication.workbench import run, truth, value
from topheavy import Column, Pulse, RockingFrame, read_record, reference, simulate
from topheavy.linear import simulate_linear_exact
from topheavy.massless_columns import SIMPLIFICATIONS, simplified


def main(case: dict, record_path: str, solver: dict) -> tuple[list[dict], dict]:
    frame = RockingFrame(Column(**case["column"]), case["mass_ratio"])
    pulse = Pulse(
        case["pulse"]["shape"], case["pulse"]["amplitude"], 2 * math.pi / case["pulse"]["period"]
    )
    motions = {
        "pulse": (pulse, 6.0 * case["pulse"]["period"]),
        "record": (read_record(record_path).scaled(case["record"]["factor"]), 30.0),
    }
    models = {"exact": frame.block()} | {name: simplified(frame, name) for name in SIMPLIFICATIONS}
    alpha = frame.slenderness
    rows, peaks, findings = [], {}, {}
    for motion, (excitation, duration) in motions.items():
        times = np.linspace(0.0, duration, 1501)
        for model, block in models.items():
            response = simulate(block, excitation, samples=times)
            others = (
                simulate(block, excitation, samples=times, tolerance=solver["tightened"]),
                reference.simulate(block, excitation, samples=times),
            )
            peaks[motion, model] = response.peak_rotation / alpha
            findings[f"{motion}_{model.replace(' ', '_')}_peak"] = truth(
                all(other.outcome == response.outcome for other in others),
                outcome=response.outcome,
                peak_over_alpha=None if response.overturned else response.peak_rotation / alpha,
                error_over_alpha=None
                if response.overturned
                else max(abs(other.peak_rotation - response.peak_rotation) for other in others)
                / alpha,
            )
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
        oracle = simulate_linear_exact(models["all"], excitation, samples=times)
        peak = peaks[motion, "all"]
        findings[f"{motion}_exact_solution_of_allen"] = value(
            0.0 if oracle.overturned else oracle.peak_rotation / alpha,
            0.0 if oracle.overturned else abs(oracle.peak_rotation / alpha - peak),
            "α",
        )
    return rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.input.record, job.params.solver))
