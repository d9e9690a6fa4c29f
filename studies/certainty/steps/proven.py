"""Prove the counterexamples beyond the theorem, and the reversals under unscaled records.

Of the counterexamples, search and checker prove outcome and number of impacts. Under records the
search does, and may leave an outcome undecided.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import as_lines, proven
from studies.certainty.steps.lowest import extreme
from studies.certainty.steps.records import reversals, similar
from topheavy import Column, Record, RockingFrame, read_record
from topheavy.proven import outcome


def beyond_the_theorem(settings: dict) -> tuple[list[dict], list[tuple[str, dict]]]:
    """Return what is proven of the lightest and the heaviest frames, and the certificates."""
    rows, certificates = [], []
    for spec in settings["extremes"]:
        pulse, *frames = extreme(settings, spec)
        for frame in frames:
            name, certificate = proven(frame, pulse)
            rows.append(
                {"record": "extreme", "structure": f"{spec['slenderness']:g}°", "proven": name}
                | {"mass_ratio": frame.mass_ratio}
                | {"impacts": certificate["impacts"] if certificate else -1}
            )
            claim = f"beyond theorem 3: α = {spec['slenderness']:g}°, γ = {frame.mass_ratio:g}"
            certificates += [(claim, certificate)] if certificate else []
    return rows, certificates


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
    """Return whether the counterexamples are proven, and what of the reversals is."""
    table = certainty_proven
    is_extreme = table.record == "extreme"
    extremes = table[is_extreme].sort_values("mass_ratio").groupby("structure", sort=False)
    under = table[~is_extreme]
    undecided = under.proven == "undecided"
    differ = int((~undecided & (under.proven != under.by_solver)).sum())
    return {
        "beyond_the_theorem": truth(
            extremes.ngroups > 0 and all(is_exception(*of.itertuples()) for _, of in extremes),
            motions=extremes.ngroups,
        ),
        "reversals_under_records": truth(
            differ == 0 and not undecided.all(),
            asked=len(under),
            undecided=int(undecided.sum()),
            differ=differ,
        ),
    }


def is_exception(light: Any, heavy: Any) -> bool:
    """Return whether a proof has the heavier frame alone overturn without an impact."""
    later = light.proven == "survives" or (light.proven == "overturns" and light.impacts > 0)
    return (heavy.proven, heavy.impacts) == ("overturns", 0) and later


def main(
    settings: dict, known: pd.DataFrame, columns: Mapping[str, Column], records: list[Record]
) -> tuple[pd.DataFrame, str, dict[str, Finding]]:
    rows, certificates = beyond_the_theorem(settings)
    table = pd.DataFrame([*rows, *under_records(known, columns, records)])
    return table, as_lines(certificates), findings(table)


def work(job: Any) -> tuple:
    given = job.params
    columns = dict(similar(entry, given.structures) for entry in given.columns)
    records = [read_record(path) for path in job.input.records]
    return main(given.settings, pd.read_csv(job.input.known), columns, records)


if __name__ == "__main__":
    run(snakemake, work)
