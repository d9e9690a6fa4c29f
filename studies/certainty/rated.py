"""Structures and intensities that the shards and the tables of the step on rates share."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    MonolithicPortal,
    RockingBlock,
    RockingFrame,
)

BARE, FREE, FIXED, PORTAL = "bare", "free", "fixed", "portal"
PGV, SCALED = "PGV", "p PGV/(g tan α)"
SURVIVES, OVERTURNS = "s", "o"


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


def subjects(case: Mapping[str, Any]) -> list[Subject]:
    """Return the bare column, also with a lower √r, and what carries each cap beam."""
    column = Column(**case["column"])
    own, ratios = column.block(), case["mass_ratios"]
    found = [
        Subject(BARE, 0.0, share, own.with_restitution((1.0 - share) * own.restitution))
        for share in (0.0, *case["lowered"])
    ]
    found += [Subject(FREE, g, 0.0, RockingFrame(column, g).block()) for g in ratios]
    found += [Subject(FIXED, g, 0.0, FixedMassColumn(column, g).block()) for g in ratios]
    portals = [(g, MonolithicPortal(column, g, case["span"])) for g in ratios]
    return found + [Subject(PORTAL, g, 0.0, portal.block()) for g, portal in portals]


def grid(case: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the PGVs, m/s, over which rates are summed: every other one is a grid, too."""
    spec = case["velocities"]
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def stated(case: Mapping[str, Any]) -> list[tuple[str, float, float]]:
    """Return measure, level and PGV (m/s) at which probabilities are stated."""
    column = Column(**case["column"])
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    return [(PGV, level, level) for level in case["pgv"]] + [
        (SCALED, level, level * unit) for level in case["scaled"]
    ]


def velocities(case: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the PGVs of all outcomes: those of the grid, then those that are stated."""
    return np.concatenate([grid(case), [pgv for *_, pgv in stated(case)]])


def written(fell: ArrayLike) -> str:
    """Return a letter for each outcome."""
    return "".join(np.where(fell, OVERTURNS, SURVIVES))


def read(texts: Iterable[str]) -> NDArray[np.bool_]:
    """Return which outcomes overturn, a row for each text."""
    return np.array([list(text) for text in texts]) == OVERTURNS
