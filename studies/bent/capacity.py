"""Compute and draw which factors on a record overturn a bent, and one of its columns alone."""

import json
from pathlib import Path

import matplotlib.pyplot as plt
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
    if not factors[0] <= scale <= factors[-1]:
        raise SystemExit(
            f"config.yaml: scale is {scale:g}, and factors are {factors[0]:g} to {factors[-1]:g}: "
            "the study says nothing of other factors; extend start or stop of factors"
        )
    windows = (0.05, 0.025, 0.1, 0.2)  # the text quotes the first, and the range over all
    both = [Capacity(factors, fell) for fell in (bent, column)]
    of_bent, of_column = np.array([[each.over(window) for window in windows] for each in both])
    capacities = {"bent": of_bent, "column": of_column, "gain": of_bent / of_column}
    return {"survives": not bent[factors <= scale].any()} | {
        name: [each[0], min(each), max(each)] if np.isfinite(each).all() else None
        for name, each in capacities.items()
    }


if __name__ == "__main__":
    config = yaml.safe_load(Path("config.yaml").read_text())
    factors, bent, column = table = outcomes(config)
    np.savetxt("results/outcomes.csv", np.transpose(table), header="factor, bent, column")
    Path("results/numbers.json").write_text(json.dumps(numbers(*table, config["scale"])))
    figure, axis = plt.subplots(figsize=(6.3, 1.2), layout="constrained")
    axis.pcolormesh(factors, [0, 1], [column, bent], cmap="Greys", rasterized=True)
    axis.set(xlabel="Factor on the record (–)", yticks=[0, 1], yticklabels=["column", "bent"])
    figure.savefig("results/capacity.svg", metadata={"Date": None}, dpi=600)
