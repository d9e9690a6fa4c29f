"""Housner's two scale effects: the larger of two similar columns, the longer of two pulses."""

import math
from dataclasses import replace

import numpy as np

from replication.workbench import run, truth
from topheavy import Column, Pulse, judge, reference, simulate


def main(case: dict, solver: dict) -> tuple[list[dict], dict]:
    small = Column(**case["column"])
    times_larger, times_longer = case["larger"], case["longer"]
    large = Column(small.half_width * times_larger, small.half_height * times_larger)
    short = Pulse(
        case["pulse"]["shape"], case["pulse"]["amplitude"], 2 * math.pi / case["pulse"]["period"]
    )
    long = replace(short, angular_frequency=short.angular_frequency / times_longer)
    times = np.linspace(0.0, 8.0 * case["pulse"]["period"], 1201)
    rows, overturned = [], {}
    for column_name, column in (("smaller", small), ("larger", large)):
        for pulse_name, pulse in (("shorter", short), ("longer", long)):
            response = simulate(column, pulse, samples=times)
            others = (
                judge(column, pulse, tolerance=solver["tightened"]),
                reference.judge(column, pulse),
            )
            if any(other.overturned != response.overturned for other in others):
                raise ArithmeticError(f"{column} under {pulse}: the routes disagree")
            overturned[column_name, pulse_name] = response.overturned
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
    findings = {
        "larger_column_survives": truth(
            overturned["smaller", "longer"] and not overturned["larger", "longer"]
        ),
        "longer_pulse_overturns": truth(
            overturned["smaller", "longer"] and not overturned["smaller", "shorter"]
        ),
    }
    return rows, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, job.params.solver))
