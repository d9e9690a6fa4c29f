"""Compute which factors on a record overturn a bent, and one of its columns alone."""

import json
from pathlib import Path

import numpy as np
import yaml

from topheavy import Capacity, Column, RockingFrame, overturned_by, read_record


def outcomes(config):
    """Return factors on the record, and whether each overturns the bent, and one column alone."""
    column, factors = Column.of_dimensions(**config["column"]), np.geomspace(**config["factors"])
    bent = RockingFrame.of_masses(column, **config["beam"])
    return factors, *overturned_by([bent, column], read_record(**config["record"]), factors)


def numbers(factors, bent, column, scale):
    """Return the numbers of the text; None where too few factors overturn for a capacity."""
    windows = (0.05, 0.025, 0.1, 0.2)  # the text quotes the first, and the range over all
    of_bent = np.array([Capacity(factors, bent).over(window) for window in windows])
    of_column = np.array([Capacity(factors, column).over(window) for window in windows])
    capacities = {"bent": of_bent, "column": of_column, "gain": of_bent / of_column}
    return {"survives": bool(not bent[factors <= scale].any())} | {
        name: [each[0], min(each), max(each)] if np.isfinite(each).all() else None
        for name, each in capacities.items()
    }


if __name__ == "__main__":
    config = yaml.safe_load(Path("config.yaml").read_text())
    table = outcomes(config)
    np.savetxt("results/outcomes.csv", np.transpose(table), header="factor, bent, column")
    Path("results/numbers.json").write_text(json.dumps(numbers(*table, config["scale"])))
