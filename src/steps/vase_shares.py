"""Which of α, p and √r carries the difference between the fixed mass and the freely carried one.

Each of the three is taken from the frame or from the column with the fixed mass, which gives eight
blocks. The worth of a block is the share of a map of frequency and amplitude that it survives, or
its minimum overturning acceleration. The Shapley value of a parameter is the gain by its exchange,
averaged over the orders of the exchanges. The three values add up to the difference between the
frame and the fixed mass.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import combinations, permutations, product

import numpy as np

from replication.workbench import grid
from steps.vase_searches import minimum
from topheavy import Column, FixedMassColumn, Pulse, RockingBlock, RockingFrame, overturning_map

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
    values = dict.fromkeys(PARAMETERS, 0.0)
    for order in permutations(PARAMETERS):
        for place, name in enumerate(order):
            before, after = (
                tuple(one for one in PARAMETERS if one in order[:end]) for end in (place, place + 1)
            )
            values[name] += (worth[after] - worth[before]) / math.factorial(len(PARAMETERS))
    return values


def survived(block: RockingBlock, column: Column, shape: str, settings: dict) -> float:
    """Return the share of the map that a block survives; its axes are those of the column."""
    spec = settings["shares"]
    frequencies = grid(spec["frequency_ratios"]) * column.frequency_parameter
    amplitudes = grid(spec["amplitudes"]) * column.uplift_acceleration
    found = overturning_map(block, shape, frequencies, amplitudes)
    return float(1.0 - np.mean(found.overturned.to_numpy()))


def least(block: RockingBlock, column: Column, shape: str, settings: dict) -> float:
    """Return the minimum overturning acceleration of a block under the pulse of the period, g."""
    pulse = Pulse(shape, 1.0, 2.0 * math.pi / settings["period"])
    highest = settings["spectra"]["highest"] * column.uplift_acceleration
    return minimum(block, pulse, highest, settings["floor"]).acceleration


WORTHS = {"survived share of the map": survived, "minimum overturning acceleration (g)": least}


def shares(column: Column, settings: dict) -> list[dict]:
    """Return a row for each worth, shape, γ and subset, with the Shapley value of single ones."""
    rows = []
    for worth_of, shape, gamma in product(
        WORTHS, settings["shapes"], settings["shares"]["mass_ratios"]
    ):
        fixed, free = FixedMassColumn(column, gamma).block(), RockingFrame(column, gamma).block()
        worth = {
            subset: WORTHS[worth_of](exchanged(fixed, free, subset), column, shape, settings)
            for subset in subsets()
        }
        values, gain = shapley(worth), worth[tuple(PARAMETERS)] - worth[()]
        rows += [
            {
                "worth": worth_of,
                "shape": shape,
                "mass_ratio": gamma,
                "taken_from_the_frame": " ".join(subset) or "none",
                "value": worth[subset],
                "shapley_value": values[subset[0]] if len(subset) == 1 else math.nan,
                "share_of_gain": values[subset[0]] / gain if len(subset) == 1 else math.nan,
            }
            for subset in worth
        ]
    return rows
