"""Compute the minimum overturning amplitude of a pulse for frames with increasing γ."""

import math
from itertools import pairwise

from replication.workbench import run, truth, value
from topheavy import Column, Pulse, RockingFrame, judge, minimum_overturning, reference


def lowest(frame: RockingFrame, pulse: Pulse, amplitudes: dict) -> tuple[float, float]:
    """Bracket the minimum overturning amplitude (g tan α); `pulse` has the amplitude g tan α."""
    found = minimum_overturning(
        frame,
        pulse,
        (amplitudes["lowest"], amplitudes["highest"]),
        resolution=amplitudes["resolution"],
    )
    if found is None:
        raise ValueError(
            f"gain.amplitudes.highest is {amplitudes['highest']}, which leaves the frame of "
            f"γ = {frame.mass_ratio} standing; expected a higher one"
        )
    return found


def main(case: dict, solver: dict) -> tuple[list[dict], dict]:
    column = Column(**case["column"])
    omega = 2 * math.pi / case["pulse"]["period"]
    pulse = Pulse(case["pulse"]["shape"], column.uplift_acceleration, omega)
    rows, confirmed = [], True
    for gamma in case["mass_ratios"]:
        frame = RockingFrame(column, gamma)
        low, high = lowest(frame, pulse, case["amplitudes"])
        for scale, falls in ((low * (1 - 1e-6), False), (high * (1 + 1e-6), True)):
            scaled = pulse.scaled(scale)
            routes = (
                judge(frame, scaled, tolerance=solver["tightened"]),
                reference.judge(frame, scaled),
            )
            confirmed &= all(route.overturned == falls for route in routes)
        rows.append({"mass_ratio": gamma, "lowest_low": low, "lowest_high": high})
    first, last = rows[0], rows[-1]
    findings = {
        "rises": truth(
            confirmed and all(a["lowest_high"] < b["lowest_low"] for a, b in pairwise(rows)),
            confirmed_by_both_routes=confirmed,
        ),
        "gain": value(
            last["lowest_low"] / first["lowest_low"] - 1,
            (last["lowest_high"] - last["lowest_low"] + first["lowest_high"] - first["lowest_low"])
            / first["lowest_low"],
        ),
    }
    return rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.params.solver))
