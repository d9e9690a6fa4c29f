"""General sentences of the documents, and whether a motion contradicts one: the strict count.

A sentence says that one structure is harder to overturn than another. A motion contradicts it by
a strict fall (see `falls`), and is an example only if both structures keep their contacts.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from replication.config import read_yaml
from steps.beyond.contacts import SIDES, cap_on, row_of
from steps.shared.falls import Fall, Lowest, confirmed, fall, lowest_of, searched_finely
from topheavy import STANDARD_GRAVITY, Column, Record, RockingFrame

SENTENCES = "paper/sentences.yaml"
READINGS = 3  # amplitudes between the two minima at which contacts are computed

Structure = Column | RockingFrame


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


class Comparison(NamedTuple):
    """A weaker and a stronger structure under a motion: their lowest intervals, and the fall."""

    weaker: Lowest
    stronger: Lowest
    fall: Fall


def read_sentences() -> dict[str, Sentence]:
    """Return the sentences by their names."""
    return {row["id"]: Sentence(**row) for row in read_yaml(SENTENCES)}


def structure_of(column: Column, gamma: float) -> Structure:
    """Return the column (γ = 0) or a frame on it."""
    return RockingFrame(column, gamma) if gamma else column


def normalised(record: Record, column: Column) -> Record:
    """Return a motion with a peak acceleration of g tan α."""
    return record.scaled(column.uplift_acceleration / record.peak_acceleration)


def compared(
    column: Column, pair: tuple[float, float], motion: Record, spec: Mapping[str, Any]
) -> Comparison:
    """Return the comparison of two structures; the fine searches run where a coarse one falls."""
    blocks = [structure_of(column, gamma).block() for gamma in pair]
    weaker, stronger = lowest_of(blocks, [motion] * 2, spec["highest"], spec["wide"])
    terms = spec["highest"], spec["wide"]
    if fall(weaker, stronger).strict > 0.0:
        stronger = confirmed(blocks[1], motion, stronger, *terms)
    if fall(weaker, stronger).strict > 0.0:
        weaker = searched_finely(blocks[0], motion, weaker, *terms)
    return Comparison(weaker, stronger, fall(weaker, stronger))


def premises(
    column: Column,
    pair: tuple[float, float],
    motion: Record,
    between: tuple[float, float],
    contacts: Mapping[str, Any],
) -> tuple[float, float]:
    """Return the least vertical force over that at rest, and the largest friction, of both.

    At some amplitudes between two minima, up to |θ| = α.
    """
    least, friction = math.inf, 0.0
    for gamma in pair:
        structure = structure_of(column, gamma)
        cap = cap_on(structure, contacts, column.half_height)
        for amplitude in np.linspace(*between, READINGS + 2)[1:-1]:
            row = row_of(structure, cap, motion.scaled(float(amplitude)))
            least = min(least, *_known(row, "least_vertical"))
            friction = max(friction, *_known(row, "friction"))
    return least, friction


def _known(row: Mapping[str, Any], name: str) -> Iterator[float]:
    """Yield the numbers of a row at base and beam; a column has no beam."""
    numbers = (row[f"{name}_{side}"] for side in SIDES)
    return (number for number in numbers if not math.isnan(number))


def half_range(motion: Record) -> float:
    """Return half the range of the ground velocity, m/s."""
    steps = 0.5 * (motion.acceleration[1:] + motion.acceleration[:-1]) * motion.time_step
    speeds = STANDARD_GRAVITY * np.append(0.0, np.cumsum(steps))
    return float(np.ptp(speeds)) / 2.0
