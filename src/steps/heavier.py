"""Apply one pulse to the solitary column and to frames with increasing γ."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy import Column, Pulse, RockingFrame, judge, lowest_overturning, simulate
from topheavy.second import reference

FLOOR, HIGHEST = 1e-3, 12.0  # of the minimum overturning amplitude, over the uplift acceleration


def main(settings: dict, solver: dict) -> tuple[list[dict], list[dict], dict]:
    column = Column(**settings["column"])
    pulse = Pulse(
        settings["pulse"]["shape"],
        settings["pulse"]["amplitude"],
        2 * math.pi / settings["pulse"]["period"],
    )
    times = np.linspace(0.0, 6.0 * settings["pulse"]["period"], 1201)
    histories, summary = [], []
    for gamma in settings["mass_ratios"]:
        frame = RockingFrame(column, gamma)
        response = simulate(frame, pulse, samples=times)
        others = (
            judge(frame, pulse, tolerance=solver["tightened"]),
            reference.judge(frame, pulse),
        )
        uplift = frame.uplift_acceleration
        low, high = lowest_overturning(
            frame,
            pulse.scaled(1.0 / pulse.amplitude),
            (uplift, HIGHEST * uplift),
            floor=FLOOR * uplift,
        ).bracket
        histories += [
            {"mass_ratio": gamma, "time": t, "acceleration": a, "rotation_over_alpha": theta}
            for t, a, theta in zip(
                times,
                pulse.excitation(times),
                response.rotation / frame.slenderness,
                strict=True,
            )
        ]
        summary.append(
            {
                "mass_ratio": gamma,
                "outcome": response.outcome,
                "peak_over_alpha": response.peak_rotation / frame.slenderness,
                "peak_error": max(abs(other.peak - response.peak_rotation) for other in others)
                / frame.slenderness,
                "same_verdict_by_all": all(
                    other.overturned == response.overturned for other in others
                ),
                "lowest_overturning_low": low,
                "lowest_overturning_high": high,
            }
        )
    table = pd.DataFrame(summary)
    drawn = findings(table)
    # narrower than the digits of the table
    width = (table.lowest_overturning_high - table.lowest_overturning_low).max()
    survives = drawn["heavier_survives_more"].with_evidence(width_of_brackets=float(width))
    return histories, summary, drawn | {"heavier_survives_more": survives}


def findings(heavier: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the heavier survive more, from the table of outcomes and brackets."""
    lows, highs = heavier.lowest_overturning_low, heavier.lowest_overturning_high
    return {
        "heavier_survives_more": truth(
            all(high < low for high, low in zip(highs, lows[1:], strict=False))
            and heavier.same_verdict_by_all.all(),
            lowest_overturning_g=lows,
        ),
        "solitary_column_overturns": truth(heavier.outcome.iloc[0] == "overturned"),
        "heaviest_survives": truth(heavier.outcome.iloc[-1] != "overturned"),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.params.solver))
