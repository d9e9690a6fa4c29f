"""Factors on a record that overturn a bent, and one of its columns alone."""

import numpy as np

from replication.step import check, run, truth, value
from replication.study import motion, structure
from topheavy import Capacity, overturned_by


def compute(structures, records, lowest, highest, step):
    bent, record = structure(structures["bent"]), motion(records["motion"])
    factors = lowest * (1 + step) ** np.arange(np.log(highest / lowest) / np.log(1 + step))
    bodies = {"bent": bent, "column": bent.column}
    return {"factor": factors} | {
        name: overturned_by(b, record, factors) for name, b in bodies.items()
    }


def capacities(factors, overturned, windows, share):
    """Return the capacity over each window."""
    capacity = Capacity(factors, overturned, share=share)
    over_windows = np.array([capacity.over(window) for window in windows])
    reached = np.isfinite(over_windows).all()
    check(reached, f"no capacity up to a factor of {factors.max():g}: raise highest")
    return over_windows


def findings(example_capacity, scale, windows, share):
    factors, bent, column = (example_capacity[name] for name in ("factor", "bent", "column"))
    of_bent, of_column = (capacities(factors, body, windows, share) for body in (bent, column))
    results = {
        "capacity": of_bent,
        "capacity_of_column": of_column,
        "gain": of_bent / of_column - 1,
    }
    return {
        name: value(
            each[0], np.ptp(each), least=each.min(), most=each.max(), window=windows[0], share=share
        )
        for name, each in results.items()
    } | {
        "survives": truth(
            not bent[factors <= scale].any(), lowest_that_overturns=factors[bent].min()
        ),
        "deck_helps": truth((of_bent > of_column).all()),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
