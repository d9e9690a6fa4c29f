"""Which of α, p and √r carries the difference between the fixed mass and the freely carried one.

Each of the three is taken from the frame or from the column with the fixed mass, which gives eight
blocks. The worth of a block is the share of a map of frequency and amplitude that it survives. The
Shapley value of a parameter is what its exchange adds, averaged over the orders of the exchanges;
the three values add up to the difference between the frame and the fixed mass.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np

from replication.workbench import grid
from topheavy import Column, FixedMassColumn, RockingBlock, RockingFrame, overturning_map

PARAMETERS = {"α": "slenderness", "p": "frequency_parameter", "√r": "restitution"}


def subsets() -> Iterator[tuple[str, ...]]:
    """Yield every choice of the three parameters, from none to all."""
    for size in range(len(PARAMETERS) + 1):
        yield from combinations(PARAMETERS, size)


def exchanged(fixed: RockingBlock, free: RockingBlock, of_free: tuple[str, ...]) -> RockingBlock:
    """Return the block of the fixed mass with these parameters from the frame."""
    values = {
        field: getattr(free if name in of_free else fixed, field)
        for name, field in PARAMETERS.items()
    }
    return RockingBlock(**values)


def shapley(worth: Mapping[tuple[str, ...], float]) -> dict[str, float]:
    """Return the Shapley value of each parameter from the worth of every subset."""
    count = len(PARAMETERS)
    values = dict.fromkeys(PARAMETERS, 0.0)
    for subset in worth:
        weight = math.factorial(len(subset)) * math.factorial(count - len(subset) - 1) if (
            len(subset) < count
        ) else 0
        for name in PARAMETERS:
            if name not in subset:
                larger = tuple(one for one in PARAMETERS if one in (*subset, name))
                values[name] += weight / math.factorial(count) * (worth[larger] - worth[subset])
    return values


def survived(block: RockingBlock, column: Column, shape: str, case: dict) -> float:
    """Return the share of the map that a block survives; its axes are those of the column."""
    frequencies = grid(case["frequency_ratios"]) * column.frequency_parameter
    amplitudes = grid(case["amplitudes"]) * column.uplift_acceleration
    found = overturning_map(block, shape, frequencies, amplitudes)
    return float(1.0 - np.mean(found.overturned.to_numpy()))


def shares(column: Column, shapes: list[str], case: dict) -> list[dict]:
    """Return a row for each shape, γ and subset: what it survives; and the Shapley values."""
    rows = []
    for shape in shapes:
        for gamma in case["mass_ratios"]:
            fixed, free = FixedMassColumn(column, gamma).block(), RockingFrame(column, gamma).block()
            worth = {
                subset: survived(exchanged(fixed, free, subset), column, shape, case)
                for subset in subsets()
            }
            values = shapley(worth)
            rows += [
                {
                    "shape": shape,
                    "mass_ratio": gamma,
                    "of_free": " ".join(subset) or "none",
                    "survived": worth[subset],
                    "shapley": values[subset[0]] if len(subset) == 1 else math.nan,
                }
                for subset in worth
            ]
    return rows
