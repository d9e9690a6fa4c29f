"""Housner's two scale effects: the larger of two similar columns, the longer of two pulses."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy import Column, Pulse, judge, simulate
from topheavy.second import reference


def main(settings: dict, solver: dict) -> tuple[list[dict], pd.DataFrame, dict]:
    small = Column(**settings["column"])
    times_larger, times_longer = settings["larger"], settings["longer"]
    large = Column(small.half_width * times_larger, small.half_height * times_larger)
    short = Pulse(
        settings["pulse"]["shape"],
        settings["pulse"]["amplitude"],
        2 * math.pi / settings["pulse"]["period"],
    )
    long = replace(short, angular_frequency=short.angular_frequency / times_longer)
    times = np.linspace(0.0, 8.0 * settings["pulse"]["period"], 1201)
    rows, outcomes = [], []
    for column_name, column in (("smaller", small), ("larger", large)):
        for pulse_name, pulse in (("shorter", short), ("longer", long)):
            response = simulate(column, pulse, samples=times)
            others = (
                judge(column, pulse, tolerance=solver["tightened"]),
                reference.judge(column, pulse),
            )
            if any(other.overturned != response.overturned for other in others):
                raise ArithmeticError(f"{column} under {pulse}: the routes disagree")
            outcome = {"column": column_name, "pulse": pulse_name}
            outcomes.append(outcome | {"overturned": response.overturned})
            rows += [
                {
                    "column": column_name,
                    "pulse": pulse_name,
                    "time": t,
                    "acceleration": a,
                    "rotation_over_alpha": theta,
                }
                for t, a, theta in zip(
                    times,
                    pulse.excitation(times),
                    response.rotation / column.slenderness,
                    strict=True,
                )
            ]
    table = pd.DataFrame(outcomes)
    return rows, table, findings(table)


def findings(scale_outcomes: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the larger column survives, and the shorter pulse is survived."""
    overturned = scale_outcomes.set_index(["column", "pulse"]).overturned
    return {
        "larger_column_survives": truth(
            overturned["smaller", "longer"] and not overturned["larger", "longer"]
        ),
        "longer_pulse_overturns": truth(
            overturned["smaller", "longer"] and not overturned["smaller", "shorter"]
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, job.params.solver))
