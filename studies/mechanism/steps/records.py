"""Friction and compression under real ground motions, as they were recorded."""

import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.histories import history
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.setting import cap_of
from topheavy import Cap, Column, Record, RockingFrame, read_record


def main(
    settings: dict, structures: dict, caps: dict[str, Cap], records: list[Record]
) -> tuple[pd.DataFrame, dict]:
    rows = []
    for name, ratios in settings["frames"].items():
        column = Column(**structures[name])
        for frame in (RockingFrame(column, gamma) for gamma in ratios):
            for record in records:
                found = demand(frame, caps[name], history(frame, record, settings["samples"]))
                rows.append(
                    {
                        "structure": name,
                        "mass_ratio": frame.mass_ratio,
                        "record": record.name,
                        "tan": frame.uplift_acceleration,
                        "outcome": found.outcome,
                        "demand": found.whole,
                        "demand_error": found.friction_error,
                        "pulls": found.pulls,
                        "impacts": found.impacts,
                    }
                )
    table = pd.DataFrame(rows)
    return table.replace(math.inf, np.nan), findings(table)


def findings(mechanism_records: pd.DataFrame) -> dict[str, Finding]:
    """Return what the records ask of the contacts, from the table of histories."""
    table = mechanism_records
    rocked = table[np.isfinite(table.demand)]
    stood = rocked[rocked.outcome != "overturned"]
    largest = stood.loc[stood.demand.idxmax()] if len(stood) else None
    return {
        "stays_on_its_seats": truth(not stood.pulls.any(), histories=len(stood)),
        "largest_demand": value(
            largest.demand,
            stood.demand_error.max(),
            least=stood.demand.min(),
            over_tan=largest.demand / largest.tan,
            structure=largest.structure,
        ),
    }


def work(job: Any) -> tuple:
    return main(
        job.params.settings,
        job.params.structures,
        {name: cap_of(entry) for name, entry in job.params.caps.items()},
        [read_record(path) for path in job.input.records],
    )


if __name__ == "__main__":
    run(snakemake, work)
