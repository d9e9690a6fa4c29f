"""Measured records, scaled from uplift to overturning: how often only the heavier frame overturns.

The components of a few earthquakes are no sample of all ground motions: there are counts, and no
intervals.
"""

import math
from itertools import combinations, product

import numpy as np

from replication.step import run, truth
from steps.shared.second import NUDGE, check_by_scipy
from topheavy import Column, RockingFrame, overturned_by, read_record


def compute(settings, solver, components):
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
    return rows


def geometric(spec):
    """Return the grid of a config entry, in equal ratios."""
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def overturned(frame, record, factors, tightened):
    """Return 1 for factors that overturn, −1 for those that do not, and 0 where this is not known.

    It is not known if a relative change of NUDGE in the record, or a tighter tolerance, changes it.
    """
    found = overturned_by(frame, record, factors)
    others = [overturned_by(frame, record, factors * (1.0 + by)) for by in (-NUDGE, NUDGE)]
    others.append(overturned_by(frame, record, factors, tolerance=tightened))
    return np.where(np.all(found == others, axis=0), np.where(found, 1, -1), 0)


def findings(records):
    return {
        "heavier_is_safer": truth(
            not records.only_heavier.any(),
            compared=records.compared.sum(),
            decided=records.decided.sum(),
            only_lighter=records.only_lighter.sum(),
            only_heavier=records.only_heavier.sum(),
            records=records.record.nunique(),
        ),
        "fewer_reversals": truth((records.only_heavier < records.only_lighter).all()),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
