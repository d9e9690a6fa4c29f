"""The measured records a little larger or smaller: where the order of γ changes.

At each factor on a record, a column (γ = 0) and its frames overturn or survive. Their order is
reversed if a heavier one overturns and a lighter one survives. The reversals at the record's own
scale are followed to the first factors at which they end; SciPy judges the factors on both sides.
Near an end, outcomes may change many times within a step of the factor.
"""

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.steps.records import similar
from topheavy import Column, Record, RockingFrame, overturned_together, read_record, reference


def reversed_pair(gammas: list[float], falls: np.ndarray) -> tuple[float, float] | None:
    """Return the lightest that survives beside a heavier that overturns, and this one; or None."""
    for place, gamma in enumerate(gammas):
        heavier = [other for other, fell in zip(gammas[place:], falls[place:], strict=True) if fell]
        if not falls[place] and heavier:
            return gamma, heavier[0]
    return None


def by_scipy(
    record: Record, column: Column, pair: tuple[float, float], inside: float, outside: float
) -> bool:
    """Return whether SciPy finds a pair reversed at one factor and not at the other."""
    return [
        [reference.judge(RockingFrame(column, g), record.scaled(factor)).overturned for g in pair]
        == [False, True]
        for factor in (inside, outside)
    ] == [True, False]


def rows(
    record: Record, name: str, column: Column, gammas: list[float], factors: np.ndarray
) -> Iterator[dict]:
    """Yield a row for each factor, and with the ends of a reversal at the record's own scale."""
    falls = overturned_together([RockingFrame(column, g) for g in gammas], record, factors)
    own = int(np.argmin(np.abs(factors - 1.0)))
    pair = reversed_pair(gammas, falls[:, own])
    ends: dict[int, int] = {}  # the first factor that is not reversed, and the last that is
    if pair:
        light, heavy = (gammas.index(gamma) for gamma in pair)
        apart = ~(~falls[light] & falls[heavy])
        for way in (-1, 1):
            beyond = np.flatnonzero(apart[own::way])
            if beyond.size:
                at = own + way * int(beyond[0])
                ends[at] = at - way
    for place, factor in enumerate(factors):
        row = {"record": record.name, "structure": name, "factor": factor}
        row["overturned"] = " ".join(
            f"{g:g}" for g, f in zip(gammas, falls[:, place], strict=True) if f
        )
        row["reversed"] = reversed_pair(gammas, falls[:, place]) is not None
        if place in ends and pair:
            row |= {"survives": pair[0], "overturns": pair[1], "end": factor}
            row["by_scipy"] = by_scipy(record, column, pair, float(factors[ends[place]]), factor)
        yield row


def main(
    settings: dict, spec: dict, structures: dict, records: list[Record]
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    columns: Mapping[str, Column] = dict(
        similar(entry, structures) for entry in settings["columns"]
    )
    steps = round(spec["widest"] / spec["step"])
    factors = 1.0 + spec["step"] * np.arange(-steps, steps + 1)
    asked = [(record, name) for record in records for name in columns]
    table = pd.DataFrame(
        row
        for record, name in progress(asked, len(asked), "columns under a record")
        for row in rows(record, name, columns[name], settings["mass_ratios"], factors)
    )
    return table, findings(table)


def findings(certainty_rescaled: pd.DataFrame) -> dict[str, Finding]:
    """Return how often a rescaling changes the order, and which ends reversals, from the table."""
    table = certainty_rescaled.fillna({"overturned": ""})
    each = ["record", "structure"]
    own = table[(table.factor - 1.0).abs() < 1e-9].set_index(each)
    beside = table.join(own.reversed.rename("own"), on=each)
    within = {}
    for width in (0.01, 0.02, 0.05):
        near = beside[(beside.factor - 1.0).abs() < width + 1e-9]
        of = near.groupby(each)
        within[f"{width:g}"] = {
            "changed": int((of.reversed.any() & ~of.reversed.all()).sum()),
            "reversed": int(of.reversed.any().sum()),
        }
    ends = table[table.end.notna()]
    return {
        "reversals_end": truth(
            bool(own.reversed.any())
            and set(ends.groupby(each).size()) == {2}
            and len(ends) == 2 * int(own.reversed.sum())
            and bool(((ends.end - 1.0).abs() <= 0.01).all()),
            own=int(own.reversed.sum()),
            groups=len(own),
            within=within,
            largest=float((ends.end - 1.0).abs().max()),
            ends=ends[[*each, "survives", "overturns", "end"]].to_dict("records"),
        ),
        "ends_by_scipy": truth(len(ends) > 0 and bool(ends.by_scipy.all()), ends=len(ends)),
    }


def work(job) -> tuple:
    records = [read_record(path) for path in job.input.records]
    return main(job.params.settings, job.params.spec, job.params.structures, records)


if __name__ == "__main__":
    run(snakemake, work)
