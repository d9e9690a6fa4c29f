"""The records that overturn anything, a little larger or smaller, and filtered: what is reversed.

At each factor on a record, a column (γ = 0) and its frames overturn or survive. Their order is
reversed if a heavier one overturns and a lighter one survives. Outcomes change at every resolution
of the factor, so that a reversal has no end that could be published; the share of factors within a
width of the own scale at which any pair is reversed does not depend on the resolution.

The Ridgecrest records are uncorrected, but for their offset (data/records/README.md). The filter is
a zero-phase Butterworth high-pass; its pads of zeros are kept.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
from scipy.signal import butter, sosfiltfilt

from replication.workbench import Finding, run, truth
from steps.shared.second import beside_a_boundary, decided
from steps.shared.spectrum import progress
from studies.certainty.steps.records import similar
from topheavy import Column, Record, RockingFrame, judge, overturned_together, read_record
from topheavy.second import reference

SEED = 2014  # of what SciPy judges
PADS = 1.5  # of zeros on each side, over the order and the corner frequency
SAME = 0.02  # by which half the step may move a share


def filtered(record: Record, order: int, corner: float) -> Record:
    """Return a record after the filter of an order and a corner frequency, Hz; as it is for 0.

    The filter runs forward and backward, which doubles its order.
    """
    if order == 0:
        return record
    rate = 1.0 / record.time_step
    pad = np.zeros(round(PADS * order / corner * rate))
    padded = np.concatenate([pad, record.acceleration, pad])
    sections = butter(order, corner, "highpass", fs=rate, output="sos")
    return Record(record.time_step, sosfiltfilt(sections, padded, padlen=0), record.name, unit="g")


def is_reversed(falls: np.ndarray) -> np.ndarray:
    """Return whether a heavier one overturns beside a lighter one that survives.

    `falls` has a row for each γ in ascending order, and a column for each factor.
    """
    lighter_survives = np.logical_or.accumulate(~falls, axis=0)[:-1]
    return (falls[1:] & lighter_survives).any(axis=0)


def rows(
    record: Record, column: Column, gammas: Sequence[float], widths: Sequence[float], points: int
) -> Iterator[dict]:
    """Yield what overturns at the own scale, for each width with the share that is reversed.

    By a grid of factors, and by every second of them (`coarser`).
    """
    frames = [RockingFrame(column, gamma) for gamma in gammas]
    own = overturned_together(frames, record, np.ones(1))
    names = [f"{gamma:g}" for gamma, fell in zip(gammas, own[:, 0], strict=True) if fell]
    row = {"overturned": " ".join(names), "reversed": bool(is_reversed(own)[0])}
    if not widths:
        yield row
    for width in widths:
        factors = 1.0 + width * np.linspace(-1.0, 1.0, points)
        found = is_reversed(overturned_together(frames, record, factors))
        yield row | {"width": width, "share": found.mean(), "coarser": found[::2].mean()}


def second_route(
    cases: Sequence[tuple[Record, Column]], gammas: Sequence[float], spec: Mapping[str, Any]
) -> Finding:
    """Return whether SciPy gives the same outcomes, of a seeded sample, half beside a boundary.

    Outcomes that a billionth of the record changes are not compared.
    """
    random, told, differ = np.random.default_rng(SEED), 0, 0
    for number in progress(range(spec["checked"]), spec["checked"], "checks"):
        record, column = cases[number % len(cases)]
        frame = RockingFrame(column, float(random.choice(gammas)))

        def overturns(factor: float, frame=frame, record=record) -> bool:
            return judge(frame, record.scaled(factor)).overturned

        factor = 1.0 + max(spec["widths"]) * random.uniform(-1.0, 1.0)
        if number % 2:
            factor = beside_a_boundary(overturns, factor)
        fell = decided(overturns, factor)
        if fell is not None:
            told += 1
            differ += reference.judge(frame, record.scaled(factor)).overturned != fell
    return truth(differ == 0 and told > 0, checked=spec["checked"], decided=told, differ=differ)


def main(
    settings: dict, spec: dict, structures: dict, records: list[Record], known: pd.DataFrame
) -> tuple[pd.DataFrame, dict[str, Finding]]:
    columns = dict(similar(entry, structures) for entry in settings["columns"])
    named, gammas = {record.name: record for record in records}, settings["mass_ratios"]
    some = known[known.overturned].groupby(["record", "structure"], sort=False).size().index
    tried = [(0, 0.0), *product(spec["filter"]["orders"], spec["filter"]["corners"])]
    asked = [
        ({"record": name, "structure": structure, "order": order, "corner": corner})
        | {"case": (filtered(named[name], order, corner), columns[structure])}
        | {"widths": [] if order else spec["widths"]}
        for name, structure in some
        for order, corner in tried
    ]
    table = pd.DataFrame(
        {key: one[key] for key in ("record", "structure", "order", "corner")} | row
        for one in progress(asked, len(asked), "records")
        for row in rows(*one["case"], gammas, one["widths"], spec["points"])
    )
    checked = second_route([one["case"] for one in asked], gammas, spec)
    return table, findings(table) | {"rescaled_by_scipy": checked}


def findings(certainty_rescaled: pd.DataFrame) -> dict[str, Finding]:
    """Return how often the order is reversed near the own scale, and what filters change."""
    table = certainty_rescaled.fillna({"overturned": ""})
    own, others = table[table.order == 0], table[table.order > 0]
    moved = (own.coarser - own.share).abs()
    return {
        "shares_hold_at_half_the_step": truth(
            len(own) > 0 and bool((moved < SAME).all()),
            limit=SAME,
            largest=float(moved.max()),
            shares={
                f"{record}, {structure}": {f"{row.width:g}": row.share for row in of.itertuples()}
                for (record, structure), of in own.groupby(["record", "structure"], sort=False)
            },
            filtered=[
                {"record": record, "structure": structure, "corner": corner, "said": said(of)}
                for (record, structure, corner), of in others.groupby(
                    ["record", "structure", "corner"], sort=False
                )
            ],
        )
    }


def said(rows: pd.DataFrame) -> str:
    """Return what filters of all orders with one corner frequency agree on at the own scale."""
    of_orders = rows.drop_duplicates("order")
    if (of_orders.overturned == "").all():
        return "overturns nothing"
    if of_orders.reversed.all():
        return "is reversed"
    if not of_orders.reversed.any():
        return "is not reversed"
    return "depends on the order of the filter"


def work(job) -> tuple:
    records = [read_record(path) for path in job.input.records]
    given, known = job.params, pd.read_csv(job.input.known)
    return main(given.settings, given.spec, given.structures, records, known)


if __name__ == "__main__":
    run(snakemake, work)
