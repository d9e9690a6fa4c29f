"""How often overturning is without an impact: the reach of the theorems on such overturning.

Under pulses, synthetic motions and measured records, each over a range of intensities.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.spectrum import progress
from topheavy import Column, Pulse, Record, RockingFrame, read_record
from topheavy.ground.synthetic.ensemble import first_draws
from topheavy.outcomes.overturning import outcomes_by
from topheavy.second import reference

SEED = 2014


def motions(
    settings: dict, ensemble: dict, column: Column, records: list[Record]
) -> Iterator[tuple[str, Pulse | Record, np.ndarray]]:
    """Yield each ground motion with its kind and the factors on it."""
    lifts, of_pulses = column.uplift_acceleration, grid(settings["amplitudes"])
    for shape in settings["shapes"]:
        for ratio in grid(settings["frequency_ratios"]):
            yield "pulses", Pulse(shape, lifts, ratio * column.frequency_parameter), of_pulses
    velocities = np.array(settings["velocities"])
    for draw in first_draws(ensemble, settings["motions"]):
        motion = draw.record()
        yield f"{draw.labels['family']} motions", motion, velocities / motion.peak_velocity
    for record in records:
        yield "records", record, np.geomspace(1.0, settings["largest"], settings["points"])


def main(
    settings: dict, ensemble: dict, records: list[Record]
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    column, random = Column(**settings["column"]), np.random.default_rng(SEED)
    asked, rows = list(motions(settings, ensemble, column, records)), []
    for kind, motion, factors in progress(asked, len(asked), "motions"):
        for gamma in settings["mass_ratios"]:
            frame = RockingFrame(column, gamma)
            overturned, impacts = outcomes_by(frame, motion, factors)
            row = {"kind": kind, "mass_ratio": gamma, "histories": len(factors)}
            row |= {"overturned": int(overturned.sum())}
            row |= {"without_impact": int((overturned & (impacts == 0)).sum())}
            if overturned.any() and random.random() < settings["sampled"]:
                at = int(random.choice(np.flatnonzero(overturned)))
                other = reference.judge(frame, motion.scaled(factors[at]))
                same = other.overturned and (other.impacts == 0) == (impacts[at] == 0)
                row |= {"asked": 1, "differ": int(not same)}
            rows.append(row)
    table = pd.DataFrame(rows).fillna(0).groupby(["kind", "mass_ratio"], sort=False).sum()
    table = table.astype(int).reset_index()
    return table, findings(table)


def findings(certainty_reach: pd.DataFrame) -> dict[str, Finding]:
    """Return how many overturnings are without an impact, from the table of counts."""
    table = certainty_reach
    pulses, others = table[table.kind == "pulses"], table[table.kind != "pulses"]
    shares = pulses.without_impact / pulses.overturned
    return {
        "none_in_earthquakes": truth(
            others.overturned.min() > 0
            and not others.without_impact.any()
            and bool(pulses.without_impact.all()),
            overturned=int(others.overturned.sum()),
            without_impact=int(others.without_impact.sum()),
            under_pulses=int(pulses.overturned.sum()),
            least_share=float(shares.min()),
            largest_share=float(shares.max()),
        ),
        "reach_by_scipy": truth(
            table.asked.sum() > 0 and table.differ.sum() == 0, asked=int(table.asked.sum())
        ),
    }


def work(job: Any) -> tuple:
    records = [read_record(path) for path in job.input.records]
    return main(job.params.settings, job.params.ensemble, records)


if __name__ == "__main__":
    run(snakemake, work)
