"""Rocking spectra of measured records: peak rotation of similar columns and frames of every size.

Each impact amplifies the difference of two motions. Under a long record with hundreds of impacts,
some outcomes are too sensitive to decide: a relative change of 1e-9 in the record changes them. We
mark such histories and do not count them.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import NUDGE
from steps.shared.spectrum import progress
from topheavy import Column, Record, RockingFrame, judge, read_record
from topheavy.second import reference

CHANGED = 0.01  # of α: a change of the peak that is not small


def spectrum(record: Record, columns: list[Column], gamma: float, tightened: float) -> list[dict]:
    """Return the rows of one record and γ: θmax/α over R, and whether NUDGE changes it."""
    rows = []
    nudged = [record.scaled(1.0 - NUDGE), record.scaled(1.0 + NUDGE)]
    for column in columns:
        frame = RockingFrame(column, gamma)
        ending = judge(frame, record)
        others = [judge(frame, record, tolerance=tightened)]
        others += [judge(frame, other) for other in nudged]
        change = max(abs(other.peak - ending.peak) for other in others) / column.slenderness
        same = all(other.overturned == ending.overturned for other in others)
        rows.append(
            {
                "record": record.name,
                "mass_ratio": gamma,
                "size": column.size,
                "overturned": ending.overturned,
                "peak_over_alpha": ending.peak / column.slenderness,
                "decided": same and (ending.overturned or change < CHANGED),
                "change": change,
            }
        )
    return rows


def second_route(table: pd.DataFrame, records: dict[str, Record], columns, count: int) -> Finding:
    """Judge some of the decidable histories again by SciPy, in even steps."""
    differ, largest = 0, 0.0
    sizes = {round(column.size, 9): column for column in columns}
    table = table[table.decided]
    for row in table.iloc[np.linspace(0, len(table) - 1, count).astype(int)].itertuples():
        column = sizes[round(row.size, 9)]
        ending = reference.judge(RockingFrame(column, row.mass_ratio), records[row.record])
        peak = ending.peak / column.slenderness
        if ending.overturned != row.overturned:
            differ += 1
        elif not ending.overturned:
            largest = max(largest, abs(peak - row.peak_over_alpha))
    return truth(differ == 0 and largest < CHANGED, histories=count, largest_difference=largest)


def main(settings: dict, paths: list[str], tightened: float) -> tuple[pd.DataFrame, dict]:
    similar = Column(**settings["column"])
    spec = settings["sizes"]
    sizes = np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    columns = [
        Column(*(size / similar.size * half for half in (similar.half_width, similar.half_height)))
        for size in sizes
    ]
    records = {record.name: record for record in map(read_record, paths)}
    runs = [(record, gamma) for record in records.values() for gamma in settings["mass_ratios"]]
    found = (spectrum(record, columns, gamma, tightened) for record, gamma in runs)
    table = pd.DataFrame([row for rows in progress(found, len(runs), "spectra") for row in rows])
    largest = table.change[table.decided & ~table.overturned].max()
    drawn = findings(table)
    told = drawn["every_history_is_decided"].with_evidence(largest_change_of_decided=float(largest))
    second = second_route(table, records, columns, settings["checked_by_second_route"])
    more = {"every_history_is_decided": told, "second_route": second}
    return table.drop(columns="change"), drawn | more


def findings(rocking_spectra: pd.DataFrame) -> dict[str, Finding]:
    """Return how often the larger or heavier overturns alone, from the table of histories."""
    table, mass_ratios = rocking_spectra, sorted(rocking_spectra.mass_ratio.unique().tolist())
    both = {"index": ["record", "size"], "columns": "mass_ratio", "aggfunc": "first"}
    falls = table.pivot_table(values="overturned", **both).astype(bool)
    falls = falls[table.pivot_table(values="decided", **both).astype(bool).all(axis=1)]

    def reversals(gamma: float) -> int:
        """Neighbouring sizes of which the smaller survives and the larger overturns."""
        runs = (fallen.to_numpy() for _, fallen in falls[gamma].groupby("record"))
        return sum(int(np.sum(~fallen[:-1] & fallen[1:])) for fallen in runs)

    return {
        "larger_is_safer_under_every_record": truth(
            not any(map(reversals, mass_ratios)),
            reversals=[reversals(gamma) for gamma in mass_ratios],
        ),
        "heavier_is_safer_under_every_record": truth(
            not any((falls[heavy] & ~falls[light]).any() for light, heavy in pairwise(mass_ratios)),
            pairs=[
                {
                    "lighter": light,
                    "heavier": heavy if math.isfinite(heavy) else "infinite",
                    "only_lighter_overturns": int((falls[light] & ~falls[heavy]).sum()),
                    "only_heavier_overturns": int((falls[heavy] & ~falls[light]).sum()),
                }
                for light, heavy in pairwise(mass_ratios)
            ],
            compared=len(falls),
            overturned=[int(falls[gamma].sum()) for gamma in mass_ratios],
        ),
        "every_history_is_decided": truth(
            table.decided.all(),
            undecided=int((~table.decided).sum()),
            histories=len(table),
            nudge=NUDGE,
        ),
    }


def work(job: Any) -> Any:
    return main(job.params.settings, job.input.records, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
