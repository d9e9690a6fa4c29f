"""Prove the counterexample beyond the theorem, and the reversals under unscaled records.

Of the counterexample, search and checker prove outcome and number of impacts. Under records the
search does, and may leave an outcome undecided.
"""

import json
from collections.abc import Iterator, Mapping
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import proven
from studies.certainty.steps.lowest import extreme
from studies.certainty.steps.records import reversals, similar
from topheavy import Column, Record, RockingFrame, read_record
from topheavy.proven import outcome


def beyond_the_theorem(settings: dict) -> tuple[list[dict], list[dict]]:
    """Return what is proven of the lightest and the heaviest frame, and the certificates."""
    pulse, *frames = extreme(settings)
    found = [proven(frame, pulse) for frame in frames]
    rows = [
        {"record": "extreme", "mass_ratio": frame.mass_ratio, "proven": name}
        | {"impacts": certificate["impacts"] if certificate else -1}
        for frame, (name, certificate) in zip(frames, found, strict=True)
    ]
    return rows, [certificate for _, certificate in found if certificate]


def under_records(
    known: pd.DataFrame, columns: Mapping[str, Column], records: list[Record]
) -> Iterator[dict]:
    """Yield what is proven of a pair that each record reverses: the lightest one of each."""
    named = {record.name: record for record in records}
    for (name, structure), rows in reversals(known).groupby(["record", "structure"]):
        light, heavy = rows.iloc[0][["mass_ratio_survives", "mass_ratio_overturns"]]
        for gamma, expected in ((light, "survives"), (heavy, "overturns")):
            found = outcome(RockingFrame(columns[structure], gamma), named[name])
            row = {"record": name, "structure": structure, "mass_ratio": gamma}
            row |= {"by_solver": expected, "proven": found.outcome, "impacts": found.impacts}
            yield row


def findings(certainty_proven: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the counterexample is proven, and what of the reversals is."""
    table = certainty_proven
    is_extreme = table.record == "extreme"
    light, heavy = table[is_extreme].sort_values("mass_ratio").itertuples()
    under = table[~is_extreme]
    undecided = under.proven == "undecided"
    differ = int((~undecided & (under.proven != under.by_solver)).sum())
    return {
        "beyond_the_theorem": truth(
            (heavy.proven, heavy.impacts) == ("overturns", 0)
            and (light.proven == "survives" or (light.proven == "overturns" and light.impacts > 0)),
            lighter=light.proven,
            impacts=[int(light.impacts), int(heavy.impacts)],
        ),
        "reversals_under_records": truth(
            differ == 0 and not undecided.all(),
            asked=len(under),
            undecided=int(undecided.sum()),
            differ=differ,
        ),
    }


def main(
    settings: dict, known: pd.DataFrame, columns: Mapping[str, Column], records: list[Record]
) -> tuple[pd.DataFrame, str, dict[str, Finding]]:
    rows, certificates = beyond_the_theorem(settings)
    table = pd.DataFrame([*rows, *under_records(known, columns, records)])
    lines = "".join(f"{json.dumps(each)}\n" for each in certificates)
    return table, lines, findings(table)


def work(job: Any) -> tuple:
    given = job.params
    columns = dict(similar(entry, given.structures) for entry in given.columns)
    records = [read_record(path) for path in job.input.records]
    return main(given.settings, pd.read_csv(job.input.known), columns, records)


if __name__ == "__main__":
    run(snakemake, work)
