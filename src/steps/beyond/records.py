"""Measured records, scaled from uplift to overturning: outcomes of frames, and their capacity.

The components of a few earthquakes are no sample of all ground motions: there are counts, and no
intervals.
"""

import math
from dataclasses import replace
from itertools import combinations, product

import numpy as np

from replication.step import check, geometric, run, truth
from steps.shared.cases import column_of
from steps.shared.samples import NUDGE, check_sample
from topheavy import Column, RockingFrame, capacity, overturned_by, read_record

BESIDE = 3  # factors on either side of a change of the outcome that are computed again


def compute(settings, solver, structures, components):
    tightened, spec = solver["tightened"], settings["by_structure"]
    cases = product(settings["slendernesses"], geometric(settings["sizes"]))
    pool, factors = [column_of(*case) for case in cases], settings["factors"]
    coarse, fine = geometric(factors), geometric(factors | {"points": spec["factors"]})
    records = [*map(read_record, components)]
    rows, edges, counts = [], [], []
    for record in records:
        outcomes, changes = scaled(pool, settings, coarse, record, tightened)
        rows += [{"record": record.name} | row for row in compared(outcomes)]
        edges += changes
        for name in spec["names"]:
            column = Column(**structures[name])
            outcomes, _ = scaled([column], settings, fine, record, tightened)
            labels = {"structure": name, "record": record.name}
            counts += [labels | row for row in compared(outcomes)]
    sample = np.linspace(0, len(edges) - 1, settings["sample"]).astype(int)
    check_sample(edges[number] for number in sample)
    spec = settings["capacity"]
    column = Column(**structures[spec["structure"]])
    capacity_rows = [*capacities(spec, column, records, tightened)]
    return {"table": rows, "structures": counts, "capacity": capacity_rows}


def scaled(columns, settings, ratios, record, tightened):
    """Return for each γ the outcomes of its frames on columns, and the changes between factors.

    `ratios` are those of the peak acceleration to the uplift acceleration of each column.
    """
    outcomes, changes = {}, []
    for gamma in settings["mass_ratios"]:
        rows = []
        for frame in (RockingFrame(column, gamma) for column in columns):
            factors = ratios * frame.uplift_acceleration / record.peak_acceleration
            row = overturned(frame, record, factors, tightened)
            edges = np.flatnonzero(row[:-1] * row[1:] == -1)
            changes += [(frame.block(), record, None, factors[k], row[k] == 1) for k in edges]
            rows.append(row)
        outcomes[gamma] = np.array(rows)
    return outcomes, changes


def compared(outcomes):
    """Yield for each pair of γ how often only the lighter frame, or only the heavier, overturns."""
    for light, heavy in combinations(outcomes, 2):
        lighter, heavier = outcomes[light], outcomes[heavy]
        yield (
            {"lighter": light, "heavier": heavy}
            | {"only_lighter": ((lighter == 1) & (heavier == -1)).sum()}
            | {"only_heavier": ((lighter == -1) & (heavier == 1)).sum()}
        )


def capacities(spec, column, records, tightened):
    """Yield the capacities of the column (γ = 0) and its frames under each record, in g, by window.

    A capacity is a threshold on a count of outcomes, which one outcome can move far. The outcomes
    from the first factor that overturns to the end of the last window are computed again, under the
    record times 1 + NUDGE and at the tightened tolerance. If they change the capacity, it is NaN.
    """
    for record, gamma in product(records, spec["mass_ratios"]):
        frame = RockingFrame(column, gamma)
        first = replace(capacity(frame, record), share=spec["share"])
        ends = [(1.0 + window) * first.over(window) for window in spec["windows"]]
        check(np.isfinite(ends).all(), f"{record.name}: capacities in windows end at {ends}")
        begin = first.overturned.argmax()
        part = slice(begin, np.searchsorted(first.factors, max(ends)) + 1)
        fell, nudged = first.overturned.copy(), (1.0 + NUDGE) * first.factors[part]
        fell[part] = overturned_by(frame, record, nudged, tolerance=tightened)
        second = replace(first, overturned=fell)
        for window in spec["windows"]:
            factor = first.over(window)
            is_decided = factor == second.over(window)
            yield (
                {"record": record.name, "mass_ratio": gamma, "window": window}
                | {"capacity": record.peak_acceleration * factor if is_decided else math.nan}
            )


def overturned(frame, record, factors, tightened):
    """Return 1 for factors that overturn, −1 for those that do not, and 0 where this is not known.

    An outcome is not known if a relative change of NUDGE in the record, or a tighter tolerance,
    changes it. Only factors within BESIDE steps of a change of the outcome are tested. Others may
    be as sensitive; their outcomes count as known.
    """
    fell = overturned_by(frame, record, factors)
    changes, steps = np.flatnonzero(fell[1:] != fell[:-1]), np.arange(1 - BESIDE, 1 + BESIDE)
    tested = np.unique(np.clip(np.add.outer(changes, steps), 0, fell.size - 1))
    outcomes, near = np.where(fell, 1, -1), factors[tested]
    if tested.size:
        repeated = [
            overturned_by(frame, record, near * (1.0 - NUDGE)),
            overturned_by(frame, record, near * (1.0 + NUDGE)),
            overturned_by(frame, record, near, tolerance=tightened),
        ]
        outcomes[tested[(repeated != fell[tested]).any(axis=0)]] = 0
    return outcomes


def findings(records, records_structures, records_capacity, settings):
    by_mass = records_capacity.pivot(
        index=["window", "record"], columns="mass_ratio", values="capacity"
    )
    gains, undecided = by_mass.div(by_mass[0.0], axis=0) - 1.0, by_mass.isna()
    middles, stated = gains.groupby("window").median(), settings["capacity"]["windows"][0]
    labels, cases = ["structure", "lighter", "heavier"], ["only_lighter", "only_heavier"]
    return (
        {
            "heavier_is_safer": truth(
                not records.only_heavier.any(),
                only_lighter=records.only_lighter.sum(),
                only_heavier=records.only_heavier.sum(),
                records=records.record.nunique(),
            ),
            "fewer_reversals": truth((records.only_heavier < records.only_lighter).all()),
            "capacities_are_decided": truth(
                not undecided.any(axis=None),
                rows=undecided.size,
                undecided=undecided.to_numpy().sum(),
                undecided_at_the_stated_window=undecided.loc[stated].to_numpy().sum(),
            ),
        }
        | {
            f"{name}_{light:g}_{heavy:g}": truth(row.only_heavier < row.only_lighter, **row)
            for table in (records.assign(structure="pair"), records_structures)
            for (name, light, heavy), row in table.groupby(labels)[cases].sum().iterrows()
        }
        | {
            f"gain_{gamma:g}": truth(
                (gains[gamma].dropna() > 0.0).all(),
                median=middles[gamma][stated],
                lowest_median=middles[gamma].min(),
                highest_median=middles[gamma].max(),
                least=gains[gamma].min(),
                most=gains[gamma].max(),
            )
            for gamma in gains.columns[1:]
        }
    )


if __name__ == "__main__":
    run(snakemake, compute, findings)
