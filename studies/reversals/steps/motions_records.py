"""Real records from uplift to collapse: how often the heavier of two frames falls alone.

The components of a few earthquakes are no sample of all: there are counts, and no intervals.
"""

import itertools
import math
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import NUDGE
from steps.shared.outcomes import FALLS, STANDS, UNKNOWN, read, written
from steps.shared.spectrum import progress
from topheavy import Column, Record, RockingFrame, overturned_by, read_record
from topheavy.second import reference


def geometric(spec: dict) -> np.ndarray:
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def column_of(slenderness: float, size: float) -> Column:
    alpha = math.radians(slenderness)
    return Column(size * math.sin(alpha), size * math.cos(alpha))


def row(record: Record, degrees: float, size: float, gamma: float, ratios, tightened) -> dict:
    """Return the outcomes at all factors.

    Outcomes are too sensitive to decide if a relative change of NUDGE in the record, or the
    tightened tolerance, changes them. Factors are over that of uplift, in equal ratios.
    """
    column = column_of(degrees, size)
    frame = RockingFrame(column, gamma)
    factors = ratios * column.uplift_acceleration / np.abs(record.acceleration).max()
    found = overturned_by(frame, record, factors)
    others = [overturned_by(frame, record, factors * (1 + off)) for off in (-NUDGE, NUDGE)]
    others.append(overturned_by(frame, record, factors, tolerance=tightened))
    return {
        "record": record.name,
        "slenderness_deg": degrees,
        "size": size,
        "mass_ratio": gamma,
        "first": ratios[0],
        "last": ratios[-1],
        "outcomes": written(found, decided=np.all(found == others, axis=0)),
    }


def compare(table: pd.DataFrame, ratios: list[float]) -> pd.DataFrame:
    """Return the counts of each record and pair of γ, of the cells where both are decidable."""
    rows = []
    for record, cells in table.groupby("record", sort=False):
        outcomes = {gamma: read(cells[cells.mass_ratio == gamma].outcomes) for gamma in ratios}
        for light, heavy in itertools.combinations(ratios, 2):
            one, other = outcomes[light], outcomes[heavy]
            told = (one != UNKNOWN) & (other != UNKNOWN)
            rows.append(
                {
                    "record": record,
                    "lighter": light,
                    "heavier": heavy,
                    "cells": told.size,
                    "decided": told.sum(),
                    "both": ((one == FALLS) & (other == FALLS)).sum(),
                    "only_lighter": ((one == FALLS) & (other == STANDS)).sum(),
                    "only_heavier": ((one == STANDS) & (other == FALLS)).sum(),
                }
            )
    return pd.DataFrame(rows)


def second_route(table: pd.DataFrame, records: dict[str, Record], ratios, count: int) -> Finding:
    """Judge some of the outcomes next to a change again by SciPy, evenly through the table."""
    found = read(table.outcomes)
    told = found != UNKNOWN
    edges = np.argwhere(told[:, 1:] & told[:, :-1] & (found[:, 1:] != found[:, :-1]))
    differ = 0
    for place, at in edges[np.linspace(0, len(edges) - 1, count).astype(int)]:
        case = table.iloc[place]
        column, record = column_of(case.slenderness_deg, case["size"]), records[case.record]
        factor = ratios[at] * column.uplift_acceleration / np.abs(record.acceleration).max()
        ending = reference.judge(RockingFrame(column, case.mass_ratio), record.scaled(factor))
        differ += ending.overturned != (found[place, at] == FALLS)
    return truth(differ == 0, histories=count, differ=differ)


def main(settings: dict, paths: list[str], tightened: float) -> tuple[pd.DataFrame, ...]:
    records = {record.name: record for record in map(read_record, paths)}
    ratios = geometric(settings["factors"])
    runs = list(
        itertools.product(
            records.values(),
            settings["slendernesses"],
            geometric(settings["sizes"]),
            settings["mass_ratios"],
        )
    )
    found = (row(*run, ratios, tightened) for run in runs)
    table = pd.DataFrame(progress(found, len(runs), "structures under a record"))
    counts = compare(table, settings["mass_ratios"])
    highest = settings["factors"]["highest"]
    checked = second_route(table, records, ratios, settings["checked_by_second_route"])
    drawn = findings(table)
    safer = drawn.pop("heavier_is_safer")
    heavier_is_safer = truth(safer.pop("holds"), highest=highest, **safer)
    return (
        table,
        counts,
        {"heavier_is_safer": heavier_is_safer, **drawn, "second_route": checked},
    )


def findings(reversals_records: pd.DataFrame) -> dict[str, Any]:
    """Return how often the heavier of two frames falls alone, from the table of outcomes."""
    counts = compare(reversals_records, list(reversals_records.mass_ratio.unique()))
    told = read(reversals_records.outcomes) != UNKNOWN
    return {
        "heavier_is_safer": {
            "holds": not counts.only_heavier.any(),
            "compared": int(counts.decided.sum()),
            "only_lighter": int(counts.only_lighter.sum()),
            "only_heavier": int(counts.only_heavier.sum()),
            "records_with_counterexamples": int(
                (counts.groupby("record").only_heavier.sum() > 0).sum()
            ),
        },
        "fewer_reversals": truth((counts.only_heavier < counts.only_lighter).all()),
        "cells_that_are_decided": truth(
            told.all(), histories=told.size, undecided=int((~told).sum())
        ),
    }


def work(job: Any) -> Any:
    return main(job.params.settings, job.input.records, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
