"""The measured records as they are: which overturn bare columns, and which overturn frames.

Every structure is judged under every record, and under the record larger and smaller by NUDGE.
SciPy judges each structure whose columns or frames overturn, and some of the others.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.histories import NUDGE
from steps.shared.spectrum import progress
from topheavy import Column, Record, RockingFrame, judge, read_record
from topheavy.second import reference


def similar(entry: Mapping[str, Any], structures: Mapping[str, Any]) -> tuple[str, Column]:
    """Return name and column of an entry: a named structure, `scaled` times as large."""
    dimensions = structures[entry["structure"]]
    column = Column(*(entry["scaled"] * dimensions[key] for key in ("half_width", "half_height")))
    return f"{2.0 * column.half_height:g} m {entry['structure']}", column


def outcome(record: Record, column: Column, gamma: float) -> dict[str, Any]:
    """Return whether a record overturns the column (γ = 0) or its frame, by each way to judge."""
    frame = RockingFrame(column, gamma)
    found = judge(frame, record)
    return {
        "mass_ratio": gamma,
        "overturned": found.overturned,
        "peak_over_alpha": found.peak / column.slenderness,
        "smaller_record": judge(frame, record.scaled(1.0 - NUDGE)).overturned,
        "larger_record": judge(frame, record.scaled(1.0 + NUDGE)).overturned,
    }


def outcomes(
    records: list[Record], columns: Mapping[str, Column], ratios: list[float]
) -> pd.DataFrame:
    """Return a row for each record, column and γ."""
    runs = [(record, name, gamma) for record in records for name in columns for gamma in ratios]
    return pd.DataFrame(
        {
            "record": record.name,
            "pgv": record.peak_velocity,
            "pga": record.peak_acceleration,
            "structure": name,
        }
        | outcome(record, columns[name], gamma)
        for record, name, gamma in progress(runs, len(runs), "structures under a record")
    )


def by_scipy(
    table: pd.DataFrame, records: list[Record], columns: Mapping[str, Column], count: int
) -> pd.Series:
    """Return the outcomes by SciPy; missing where SciPy does not judge.

    SciPy judges all γ of a column under a record that overturns any of them, and `count` of
    the other histories, in even steps.
    """
    named = {record.name: record for record in records}
    close = table.groupby(["record", "structure"]).overturned.transform("any")
    others = table.index[~close]
    places = np.linspace(0, len(others) - 1, min(count, len(others))).astype(int)
    asked = table[close | table.index.isin(others[places])]
    found = [
        reference.judge(RockingFrame(columns[row.structure], row.mass_ratio), named[row.record])
        for row in progress(asked.itertuples(), len(asked), "histories by SciPy")
    ]
    falls = pd.Series([one.overturned for one in found], asked.index, dtype=object)
    return falls.reindex(table.index)


def groups(table: pd.DataFrame) -> Iterator[dict[str, Any]]:
    """Yield for each record and column which γ overturn and which survive, if any overturns."""
    for (record, structure), rows in table.groupby(["record", "structure"], sort=False):
        if rows.overturned.any():
            yield {
                "record": record,
                "structure": structure,
                "overturned": rows.mass_ratio[rows.overturned].tolist(),
                "survived": rows.mass_ratio[~rows.overturned].tolist(),
            }


def reversals(table: pd.DataFrame) -> pd.DataFrame:
    """Return the pairs of which only the heavier overturns; γ = 0 is the bare column."""
    each = ["record", "structure"]
    falls, stands = table[table.overturned], table[~table.overturned]
    pairs = stands[[*each, "mass_ratio"]].merge(
        falls[[*each, "mass_ratio"]], on=each, suffixes=("_survives", "_overturns")
    )
    return pairs[pairs.mass_ratio_survives < pairs.mass_ratio_overturns]


def main(settings: dict, structures: dict, records: list[Record]) -> tuple[pd.DataFrame, dict]:
    columns = dict(similar(entry, structures) for entry in settings["columns"])
    table = outcomes(records, columns, settings["mass_ratios"])
    table["by_scipy"] = by_scipy(table, records, columns, settings["checked_by_second_route"])
    return table, findings(table)


def findings(certainty_records: pd.DataFrame) -> dict[str, Finding]:
    """Return which frames and columns the records overturn, from the table of outcomes."""
    table = certainty_records
    frames, pairs = table[table.mass_ratio > 0.0], reversals(table)
    beside = pairs.mass_ratio_survives == 0.0
    bare, among = pairs[beside], pairs[~beside]
    asked = table[table.by_scipy.notna()]
    differ = int((asked.by_scipy != asked.overturned).sum())
    nudged = table[["smaller_record", "larger_record"]].ne(table.overturned, axis=0)
    undecided = int(nudged.any(axis=1).sum())
    falls = table.groupby("structure", sort=False).overturned.any()
    tried = {"records": table.record.nunique(), "frames": len(frames)}
    return {
        "records": truth(
            len(frames) > 0 and not frames.overturned.any(),
            overturned=int(frames.overturned.sum()),
            groups=list(groups(table)),
            all_survive=falls.index[~falls].tolist(),
            **tried,
        ),
        "bare_columns_fall_first": truth(
            len(frames) > 0 and bare.empty, counterexamples=bare.to_dict("records"), **tried
        ),
        "lighter_frames_fall_first": truth(
            len(set(frames.mass_ratio)) > 1 and among.empty,
            counterexamples=among.to_dict("records"),
            **tried,
        ),
        "second_route": truth(
            differ == 0 and undecided == 0 and len(asked) > 0,
            histories=len(table),
            asked=len(asked),
            differ=differ,
            undecided=undecided,
            nudge=NUDGE,
        ),
        "napa": value(table.pgv[table.record.str.startswith("napa")].max(), 0.0, "m/s"),
    }


def work(job: Any) -> tuple:
    records = [read_record(path) for path in job.input.records]
    return main(job.params.settings, job.params.structures, records)


if __name__ == "__main__":
    run(snakemake, work)
