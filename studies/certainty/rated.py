"""Structures, intensities and outcomes that steps with a shard for every n-th motion share."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from steps.shared.outcomes import FALLS, read
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    RockingBlock,
    RockingFrame,
)

BARE, FREE, FIXED = "bare", "free", "fixed"
PGV, SCALED = "PGV", "p PGV/(g tan α)"


@dataclass(frozen=True)
class Subject:
    """A structure of the same columns; `lowered` is the share by which its √r is lowered."""

    structure: str
    mass_ratio: float
    lowered: float
    block: RockingBlock

    @property
    def labels(self) -> dict[str, Any]:
        return {
            "structure": self.structure,
            "mass_ratio": self.mass_ratio,
            "lowered": self.lowered,
        }


def subjects(settings: Mapping[str, Any]) -> list[Subject]:
    """Return the bare column, also with a lower √r, and what carries each cap beam."""
    column = Column(**settings["column"])
    own, ratios = column.block(), settings["mass_ratios"]
    found = [
        Subject(BARE, 0.0, share, own.with_restitution((1.0 - share) * own.restitution))
        for share in (0.0, *settings["lowered"])
    ]
    found += [Subject(FREE, g, 0.0, RockingFrame(column, g).block()) for g in ratios]
    return found + [Subject(FIXED, g, 0.0, FixedMassColumn(column, g).block()) for g in ratios]


def grid(settings: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the PGVs, m/s, over which rates are summed: every other one is a grid, too."""
    spec = settings["velocities"]
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def stated(column: Column, settings: Mapping[str, Any]) -> list[tuple[str, float, float]]:
    """Return measure, level and PGV (m/s) at which probabilities are stated."""
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    return [(PGV, level, level) for level in settings["pgv"]] + [
        (SCALED, level, level * unit) for level in settings["scaled"]
    ]


def velocities(settings: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the PGVs of all outcomes: those of the grid, then those that are stated."""
    of_stated = [pgv for *_, pgv in stated(Column(**settings["column"]), settings)]
    return np.concatenate([grid(settings), of_stated])


def fallen(rows: pd.DataFrame, motions: int, structures: int) -> tuple[NDArray[np.bool_], Any]:
    """Return what overturns, (motions, structures, levels), and the first row of each motion.

    The rows are those of one family in all shards, in any order of the motions.

    Raises
    ------
    ValueError
        When rows are missing, or there are more.
    """
    ordered = rows.sort_values(["scenario", "motion"], kind="stable")
    if len(ordered) != motions * structures:
        raise ValueError(
            f"{rows.family.iloc[0]}: {len(ordered)} rows of outcomes; expected {motions} motions "
            f"of {structures} structures: a shard is incomplete, delete it and run again"
        )
    fell = read(ordered.outcomes) == FALLS
    return fell.reshape(motions, structures, -1), ordered.iloc[::structures]
