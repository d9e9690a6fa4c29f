"""How much depends on the impact law under pulses: √r of frame and column changed, together, apart.

A factor never brings √r above HIGHEST.
"""

import math
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth, value
from steps.shared.spectra_compared import ends_of
from steps.shared.spectrum import progress
from studies.certainty.subjects import changed
from topheavy import (
    Column,
    Pulse,
    RockingBlock,
    RockingFrame,
    minimum_overturning,
    overturning_intervals,
)

RISES = 1e-8  # of a minimum: the rounding of its bracket


def pairs(factors: list[float]) -> dict[tuple[str, float], tuple[float, float]]:
    """Return the factors on √r of the column and of the frame, by way and factor."""
    found = {("both", factor): (factor, factor) for factor in factors}
    found |= {("frame alone", factor): (1.0, factor) for factor in factors}
    return found | {("column alone", factor): (factor, 1.0) for factor in factors}


def spectrum(block: RockingBlock, pulse: Pulse, settings: dict) -> np.ndarray:
    """Return the intervals of amplitude (g tan α) that overturn, shape (n, 2)."""
    amplitudes = settings["amplitudes"]
    found = overturning_intervals(
        block,
        pulse,
        (amplitudes["lowest"], amplitudes["highest"]),
        resolution=amplitudes["resolution"],
        most_impacts=1,
    )
    return ends_of(found, amplitudes["highest"])


def lowest(block: RockingBlock, pulse: Pulse, settings: dict, below: float) -> float:
    """Return the minimum (g tan α) by the finer resolution, at most `below` or the highest."""
    ends = settings["amplitudes"]["lowest"], min(below, settings["amplitudes"]["highest"])
    found = minimum_overturning(block, pulse, ends, resolution=settings["amplitudes"]["finer"])
    return found[1] if found else below


def only_first(first: np.ndarray, second: np.ndarray, levels: np.ndarray) -> float:
    """Return the share of the levels within the intervals of the first and not of the second."""
    inside = [
        ((levels[:, None] >= s[:, 0]) & (levels[:, None] <= s[:, 1])).any(axis=1)
        for s in (first, second)
    ]
    return float((inside[0] & ~inside[1]).mean())


def under_pulses(settings: dict) -> pd.DataFrame:
    """Return, for each change of √r, the shares of the maps saved and lost, and the least rise."""
    amplitudes = settings["amplitudes"]
    levels = np.linspace(amplitudes["lowest"], amplitudes["highest"], settings["levels"])
    ratios = np.linspace(
        *(settings["frequency_ratios"][key] for key in ("lowest", "highest", "points"))
    )
    places = list(product(settings["slendernesses"], settings["shapes"], ratios))
    factors, rows = settings["factors"], []
    for degrees, shape, ratio in progress(places, len(places), "frequencies"):
        alpha = math.radians(degrees)
        column = Column(math.sin(alpha), math.cos(alpha))
        pulse = Pulse(shape, column.uplift_acceleration, ratio * column.frequency_parameter)
        light, heavy = (
            {factor: spectrum(changed(block, factor), pulse, settings) for factor in factors}
            for block in (column.block(), RockingFrame(column, math.inf).block())
        )
        for (way, factor), (of_column, of_frame) in pairs(factors).items():
            one, other = light[of_column], heavy[of_frame]
            minima = [found[0, 0] if len(found) else math.inf for found in (one, other)]
            if minima[1] < minima[0] * (1.0 - RISES):
                # a narrow interval of the column may have been missed below
                minima[0] = lowest(changed(column.block(), of_column), pulse, settings, minima[0])
            rows.append(
                {
                    "way": way,
                    "factor": factor,
                    "helps": only_first(one, other, levels),
                    "harms": only_first(other, one, levels),
                    "compared": min(minima) < math.inf,
                    "falls": minima[1] < minima[0] * (1.0 - RISES),
                    "least": minima[1] / minima[0] if minima[0] < math.inf else math.inf,
                }
            )
    grouped = pd.DataFrame(rows).groupby(["way", "factor"], sort=False, as_index=False)
    return grouped.agg(
        helps=("helps", "mean"),
        harms=("harms", "mean"),
        compared=("compared", "sum"),
        falls=("falls", "sum"),
        least=("least", "min"),
    )


def is_against_the_frame(table: pd.DataFrame) -> pd.Series:
    """Return which changes lower the √r of the column and not that of the frame."""
    return (table.way == "column alone") & (table.factor < 1.0)


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    table, error = under_pulses(settings), 1.0 / settings["levels"]
    drawn = findings(table)
    ranges = {name: drawn.pop(name) for name in ("harms_range", "helps_range")}
    return table, drawn | {
        name: value(found["value"], error, lowest=found["lowest"]) for name, found in ranges.items()
    }


def findings(certainty_restitution: pd.DataFrame) -> dict[str, Any]:
    """Return what is left of the benefit under pulses with other √r.

    The errors of the ranges are those of the levels, which are in the config.
    """
    pulses = certainty_restitution
    together, kept = pulses[pulses.way == "both"], pulses[~is_against_the_frame(pulses)]
    shown = {
        f"{name}_{row.factor:g}": getattr(row, name)
        for row in together.itertuples()
        for name in ("helps", "harms")
    }
    return {
        "lowest_rises_together": truth(
            together.compared.all() and not together.falls.any(),
            compared=int(together.compared.sum()),
            **shown,
        ),
        "lowest_rises_apart": truth(
            pulses.compared.all() and not pulses.falls.any(),
            holds_when=bool(kept.compared.all()) and not kept.falls.any(),
            condition="the column's √r is not lowered alone",
            changes=pulses.to_dict("records"),
        ),
        "harms_range": {"value": together.harms.max(), "lowest": together.harms.min()},
        "helps_range": {"value": together.helps.max(), "lowest": together.helps.min()},
    }


def work(job: Any) -> tuple:
    return main(job.params.settings)


if __name__ == "__main__":
    run(snakemake, work)
