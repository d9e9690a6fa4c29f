"""Compute the minimum overturning amplitude of a pulse for frames with increasing γ."""

import math
from itertools import pairwise

import pandas as pd

from replication.workbench import Finding, run, truth, value
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


def main(case: dict, solver: dict) -> tuple[pd.DataFrame, dict[str, Finding]]:
    column = Column(**case["column"])
    omega = 2 * math.pi / case["pulse"]["period"]
    pulse = Pulse(case["pulse"]["shape"], column.uplift_acceleration, omega)
    rows = []
    for gamma in case["mass_ratios"]:
        frame = RockingFrame(column, gamma)
        low, high = lowest(frame, pulse, case["amplitudes"])
        confirmed = True
        for scale, falls in ((low * (1 - 1e-6), False), (high * (1 + 1e-6), True)):
            scaled = pulse.scaled(scale)
            routes = (
                judge(frame, scaled, tolerance=solver["tightened"]),
                reference.judge(frame, scaled),
            )
            confirmed &= all(route.overturned == falls for route in routes)
        row = {"mass_ratio": gamma, "lowest_low": low, "lowest_high": high, "width": high - low}
        rows.append(row | {"confirmed_by_both_routes": confirmed})
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(skeleton_gain: pd.DataFrame) -> dict[str, Finding]:
    """Return whether and how much the amplitude rises; `make check` draws them again from here."""
    table = skeleton_gain
    confirmed = table.confirmed_by_both_routes.all()
    first, last = table.iloc[0], table.iloc[-1]
    return {
        "rises": truth(
            confirmed
            and all(
                a < b
                for (a, _), (_, b) in pairwise(
                    zip(table.lowest_high, table.lowest_low, strict=True)
                )
            ),
            confirmed_by_both_routes=confirmed,
        ),
        "gain": value(
            last.lowest_low / first.lowest_low - 1, (last.width + first.width) / first.lowest_low
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.params.solver))
