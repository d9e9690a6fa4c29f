"""Deficit of the column's √r at which the minima of column and frame under a pulse are equal.

Lowering √r raises the minimum of the column as far as it overturns after an impact. There is no
such deficit where the column overturns without an impact below the minimum of the frame. SciPy
judges both structures below and above their minima at both ends of the bracket.
"""

import math
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.spectrum import progress
from topheavy import (
    Column,
    Pulse,
    RockingBlock,
    RockingFrame,
    Search,
    minima_together,
    minimum_overturning,
    overturning_intervals,
    reference,
)
from topheavy.structures import Structure

EQUAL, ONCE, RESTED, NOT_ABOVE, BEYOND = (
    "equal",
    "none: without an impact",
    "none: with √r = 0, too",
    "not above with Eq. (25)",
    "frame not overturned",
)
JUMP = 1.01  # of the frame's minimum: the column's passes it without being equal
BESIDE = 1e-6  # of a minimum: how far from it SciPy judges
ROUNDING = 1e-8


def pulses(column: Column, settings: dict, heavier: dict) -> list[Pulse]:
    """Return the pulse of `heavier` and those of the grid, all with the amplitude of uplift."""
    tan, p = column.uplift_acceleration, column.frequency_parameter
    own = Pulse(heavier["shape"], tan, 2.0 * math.pi / heavier["period"])
    ratios = grid(settings["frequency_ratios"])
    return [
        own,
        *(Pulse(shape, tan, ratio * p) for shape, ratio in product(settings["shapes"], ratios)),
    ]


class Minima:
    """Minimum overturning amplitudes (g tan α) under one pulse, in one range."""

    def __init__(self, column: Column, pulse: Pulse, settings: dict):
        self.block, self.pulse, self.step = column.block(), pulse, settings["deficit"]["step"]
        self.range = 1.0, settings["amplitudes"]["highest"]
        self.resolution = settings["amplitudes"]["resolution"]

    def lowered(self, deficit: float) -> RockingBlock:
        """Return the column with √r lowered by a share."""
        return self.block.with_restitution((1.0 - deficit) * self.block.restitution)

    def of(self, structure: Structure) -> float:
        """Return the minimum of a structure; infinite if there is none in the range."""
        found = minimum_overturning(structure, self.pulse, self.range, resolution=self.resolution)
        return found[1] if found else math.inf

    def without_impact(self) -> float:
        """Return the minimum of the column without an impact, whatever its √r."""
        found = overturning_intervals(
            self.block, self.pulse, self.range, resolution=self.resolution, most_impacts=1
        )
        return min((one.lower[1] for one in found if one.impacts == 0), default=math.inf)

    def of_columns(self) -> tuple[np.ndarray, np.ndarray]:
        """Return deficits from 0 to 1 and the minimum of the column with each."""
        deficits = np.linspace(0.0, 1.0, round(1.0 / self.step) + 1)
        searches = [Search(self.lowered(one), self.pulse, self.range) for one in deficits]
        found = minima_together(searches, resolution=self.resolution)
        return deficits, np.array([one[1] if one else math.inf for one in found])

    def crossing(self, low: float, high: float, level: float, width: float) -> tuple[float, float]:
        """Return deficits so close between which the minimum of the column passes a level."""
        while high - low > width:
            middle = 0.5 * (low + high)
            if self.of(self.lowered(middle)) < level:
                low = middle
            else:
                high = middle
        return low, high

    def by_scipy(self, structure: Structure, minimum: float) -> bool:
        """Return whether SciPy overturns a structure just above its minimum and not just below."""
        return [
            reference.judge(structure, self.pulse.scaled(minimum * (1.0 + side))).overturned
            for side in (-BESIDE, BESIDE)
        ] == [False, True]


def compared(column: Column, pulse: Pulse, settings: dict) -> list[dict[str, Any]]:
    """Return a row for each frame: whether, and between which deficits, the minima are equal."""
    minima, rows = Minima(column, pulse, settings), []
    once = minima.without_impact()
    deficits, of_column = minima.of_columns()
    for gamma in settings["mass_ratios"]:
        frame = RockingFrame(column, gamma)
        own = minima.of(frame)
        row = {"shape": pulse.shape, "mass_ratio": gamma, "frame": own, "column": of_column[0]}
        row |= {"frequency_ratio": pulse.angular_frequency / column.frequency_parameter}
        row |= {"without_impact": once, "rested": of_column[-1], "kind": EQUAL}
        level = own * (1.0 - ROUNDING)
        below = of_column < level
        row |= {"changes": int(np.diff(below).sum())}
        ends = [0.0]
        if not below[0]:
            row["kind"] = NOT_ABOVE if own < math.inf else BEYOND
        elif once < level:
            row["kind"], ends = ONCE, [0.0, 1.0]
        elif below.all():
            row["kind"], ends = RESTED, [0.0, 1.0]
        elif own == math.inf:
            row["kind"] = BEYOND
        else:
            at = int(np.argmin(below))
            width = settings["deficit"]["bracket"]
            ends = [*minima.crossing(deficits[at - 1], deficits[at], level, width)]
            row |= dict(zip(("deficit_low", "deficit_high"), ends, strict=True))
        lows = [minima.of(minima.lowered(end)) for end in ends]
        row |= dict(zip(("column_low", "column_high"), lows, strict=False))
        asked = [(minima.lowered(end), low) for end, low in zip(ends, lows, strict=True)]
        asked += [(frame, own)]
        row["by_scipy"] = all(
            minima.by_scipy(one, low) for one, low in asked if 1.0 < low < math.inf
        )
        rows.append(row)
    return rows


def main(settings: dict, heavier: dict, measured: list[float]) -> tuple[pd.DataFrame, dict]:
    column = Column(**settings["column"])
    every = pulses(column, settings, heavier)
    found = progress((compared(column, one, settings) for one in every), len(every), "pulses")
    table = pd.DataFrame(row for rows in found for row in rows)
    return table, findings(table, pd.DataFrame([{"largest": max(measured)}]))


def findings(
    certainty_break_even_pulses: pd.DataFrame, certainty_measured: pd.DataFrame
) -> dict[str, Finding]:
    """Return whether a deficit makes the minima equal, from the tables of pulses and deficits."""
    table = certainty_break_even_pulses
    some = table[table.kind != BEYOND]
    equal = some[some.kind == EQUAL]
    own = equal[equal.index < table.mass_ratio.nunique()]  # the first pulse is that of `heavier`
    return {
        "deficit_exceeds_measured": beyond(table, float(certainty_measured.largest[0])),
        "deficit_exists": truth(
            len(some) > 0 and (some.kind == EQUAL).all(),
            holds_when=len(equal) > 0 and (some[some.rested >= some.frame].kind == EQUAL).all(),
            condition="with √r = 0, the column's minimum is not below that of the frame",
            compared=len(some),
            equal=len(equal),
            counts=some.kind.value_counts().to_dict(),
            least=float(equal.deficit_low.min()),
            largest=float(equal.deficit_high.max()),
            heavier=[float(own.deficit_low.min()), float(own.deficit_high.max())],
            jumps=int((equal.column_high > equal.frame * JUMP).sum()),
            several=int((some.changes > 1).sum()),
            bracket=float((equal.deficit_high - equal.deficit_low).max()),
        ),
        "minima_by_scipy": truth(len(some) > 0 and bool(some.by_scipy.all()), compared=len(some)),
    }


def beyond(table: pd.DataFrame, deficit: float) -> Finding:
    """Return whether the minima of all pulses become equal beyond a deficit, if they do at all."""
    some = table[table.kind != BEYOND]
    within = (some.deficit_low <= deficit) | (some.kind == NOT_ABOVE)
    return truth(
        len(some) > 0 and not within.any(),
        deficit=deficit,
        within=int(within.sum()),
        compared=len(some),
    )


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.pulse, job.params.measured)


if __name__ == "__main__":
    run(snakemake, work)
