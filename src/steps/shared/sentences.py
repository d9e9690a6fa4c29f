"""General sentences of the documents, and whether a motion contradicts one: the strict count.

A sentence says that one structure is harder to overturn than another. A motion contradicts it by
a strict fall (see `falls`), and is an example only if both structures keep their contacts.
"""

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from replication.config import read_yaml
from steps.beyond.contacts import SIDES, cap_on, row_of, structure_of
from steps.shared.falls import Comparison, compared
from steps.shared.lobes import Lobe
from topheavy import Column, Record, RockingBlock, RockingFrame

SENTENCES = "paper/sentences.yaml"
READINGS = 3  # amplitudes between the two minima at which contacts are computed


class Sentence(NamedTuple):
    """A general sentence: its words, the structures that it compares, and its conditions."""

    id: str
    sentence: str
    weaker: str
    stronger: str
    where: str
    conditions: str

    def pairs(self, gammas: Sequence[float]) -> list[tuple[float, float]]:
        """Return the mass ratios that it compares; γ = 0 is the column."""
        pairs = combinations(sorted({0.0, *gammas}), 2)
        return [pair for pair in pairs if (pair[0] == 0.0) == (self.weaker == "column")]


def read_sentences() -> dict[str, Sentence]:
    """Return the sentences by their names."""
    return {row["id"]: Sentence(**row) for row in read_yaml(SENTENCES)}


class Case(NamedTuple):
    """Two structures on a column, by γ (0 is the column), under a motion with a peak of g tan α."""

    column: Column
    lighter: float
    heavier: float
    motion: Record
    lobes: Sequence[Lobe] = ()

    def structures(self) -> list[Column | RockingFrame]:
        """Return the lighter and the heavier structure."""
        return [structure_of(self.column, gamma) for gamma in (self.lighter, self.heavier)]

    def blocks(self) -> list[RockingBlock]:
        """Return them as blocks."""
        return [structure.block() for structure in self.structures()]

    def comparison(self, spec: Mapping[str, Any]) -> Comparison:
        """Return their lowest intervals that overturn, and the fall."""
        return compared(*self.blocks(), self.motion, spec["highest"], spec["wide"])

    def premises(
        self, comparison: Comparison, contacts: Mapping[str, Any], height: float
    ) -> tuple[float, float]:
        """Return the least vertical force over that at rest, and the largest friction, of both.

        At some amplitudes between the two minima, up to |θ| = α. The cap beam of the config is that
        on columns of a half-height (m).
        """
        lower, upper = comparison.heavier.wide_lower, comparison.heavier.wide_upper
        end = min(comparison.lighter.lower, upper, 2.0 * lower)  # both may be infinite
        rows = [
            row_of(
                structure, cap_on(structure, contacts, height), self.motion.scaled(float(factor))
            )
            for structure in self.structures()
            for factor in np.linspace(lower, end, READINGS + 2)[1:-1]
        ]
        least, friction = (
            np.array([[row[f"{name}_{side}"] for side in SIDES] for row in rows])
            for name in ("least_vertical", "friction")
        )
        return float(np.nanmin(least)), float(np.nanmax(friction))  # a column has no beam: NaN
