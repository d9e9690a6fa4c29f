"""Measured records, scaled from uplift to overturning: outcomes of frames, and their capacity.

The components of a few earthquakes are no sample of all ground motions: there are counts, and no
intervals.
"""

import math
from itertools import combinations, product

import numpy as np

from replication.step import check, geometric, run, truth
from steps.shared.second import NUDGE, check_by_scipy
from topheavy import Column, RockingFrame, capacity, overturned_by, read_record


def compute(settings, solver, structures, components):
    ratios, sizes = geometric(settings["factors"]), geometric(settings["sizes"])
    gammas, rows, edges = settings["mass_ratios"], [], []
    for path in components:
        record, outcomes = read_record(path), {gamma: [] for gamma in gammas}
        for degrees, size, gamma in product(settings["slendernesses"], sizes, gammas):
            alpha = math.radians(degrees)
            frame = RockingFrame(Column(size * math.sin(alpha), size * math.cos(alpha)), gamma)
            factors = ratios * frame.uplift_acceleration / record.peak_acceleration
            found = overturned(frame, record, factors, solver["tightened"])
            outcomes[gamma].append(found)
            changes = np.flatnonzero(found[:-1] * found[1:] == -1)
            edges += [(frame.block(), record, None, factors[at], found[at] == 1) for at in changes]
        for light, heavy in combinations(gammas, 2):
            one, other = np.array(outcomes[light]), np.array(outcomes[heavy])
            rows.append(
                {"record": record.name, "lighter": light, "heavier": heavy, "compared": one.size}
                | {"decided": (one * other != 0).sum(), "both": ((one == 1) & (other == 1)).sum()}
                | {"only_lighter": ((one == 1) & (other == -1)).sum()}
                | {"only_heavier": ((one == -1) & (other == 1)).sum()}
            )
    at = np.linspace(0, len(edges) - 1, settings["checked"]).astype(int)
    check_by_scipy(edges[place] for place in at)
    spec, column = settings["capacity"], Column(**structures[settings["capacity"]["structure"]])
    return {"table": rows, "capacity": [*capacities(spec, column, map(read_record, components))]}


def capacities(spec, column, records):
    """Yield the capacities of the column (γ = 0) and its frames under each record, in g.

    It is stated for the first window, with the range over all.
    """
    ratios = (1.0 + spec["step"]) ** np.arange(math.log(spec["highest"]) / math.log1p(spec["step"]))
    for record, gamma in product(records, spec["mass_ratios"]):
        factors = ratios * column.uplift_acceleration / record.peak_acceleration
        one = capacity(RockingFrame(column, gamma), record, factors, share=spec["share"])
        peaks = [record.peak_acceleration * one.over(window) for window in spec["windows"]]
        check(np.isfinite(peaks).all(), f"{record.name}: no capacity: raise capacity.highest")
        yield (
            {"record": record.name, "mass_ratio": gamma, "capacity": peaks[0]}
            | {"least": min(peaks), "most": max(peaks)}
        )


def overturned(frame, record, factors, tightened):
    """Return 1 for factors that overturn, −1 for those that do not, and 0 where this is not known.

    It is not known if a relative change of NUDGE in the record, or a tighter tolerance, changes it.
    """
    found = overturned_by(frame, record, factors)
    others = [overturned_by(frame, record, factors * (1.0 + by)) for by in (-NUDGE, NUDGE)]
    others.append(overturned_by(frame, record, factors, tolerance=tightened))
    return np.where(np.all(found == others, axis=0), np.where(found, 1, -1), 0)


def findings(records, records_capacity):
    by_mass = records_capacity.pivot(index="record", columns="mass_ratio", values="capacity")
    gains = by_mass.div(by_mass[0.0], axis=0) - 1.0
    return {
        "heavier_is_safer": truth(
            not records.only_heavier.any(),
            only_lighter=records.only_lighter.sum(),
            only_heavier=records.only_heavier.sum(),
            records=records.record.nunique(),
        ),
        "fewer_reversals": truth((records.only_heavier < records.only_lighter).all()),
    } | {
        f"gain_{gamma:g}": truth(
            (gains[gamma] > 0.0).all(), least=gains[gamma].min(), most=gains[gamma].max()
        )
        for gamma in gains.columns[1:]
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
