"""The seeded ensemble of motions, and the structures that are put under it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from topheavy import STANDARD_GRAVITY, Column, Record, RockingFrame
from topheavy.structures import size_ratio
from topheavy.synthetic.motions import Scenario, motion, peak_velocity


@dataclass(frozen=True)
class Draw:
    """One motion of the ensemble, given by family, scenario and number; computed on request.

    Scenarios are numbered from 0 and have seeds of their own.
    """

    family: str
    place: int
    number: int
    seed: int
    scenario: Scenario

    @property
    def labels(self) -> dict[str, Any]:
        return {"family": self.family, "scenario": self.place, "motion": self.number}

    def record(self) -> Record:
        pulse = self.family == "near-fault"
        return motion(self.seed + self.place, self.number, self.scenario, pulse=pulse)


@dataclass(frozen=True)
class Subject:
    """A frame of a named structure; or, with γ = 0, a column `enlarged` to the R̂ of that γ."""

    structure: str
    frame: RockingFrame
    unit: float
    enlarged: float
    share: float

    @property
    def labels(self) -> dict[str, Any]:
        return {
            "structure": self.structure,
            "mass_ratio": self.frame.mass_ratio,
            "as_large_as": self.enlarged,
        }


def draws(case: Mapping[str, Any]) -> list[Draw]:
    """Return all motions of the ensemble, in the order of its tables."""
    return first_draws(case, case["runs"][case["run"]]["motions"])


def first_draws(case: Mapping[str, Any], motions: int) -> list[Draw]:
    """Return the first motions of each family and scenario, in the order of the tables."""
    return [
        Draw(family, place, number, case["seed"], Scenario(**scenario))
        for family in case["families"]
        for place, scenario in enumerate(case["scenarios"])
        for number in range(motions)
    ]


def subjects(case: Mapping[str, Any], structures: Mapping[str, Any]) -> Iterator[Subject]:
    """Yield what is put under the motions: frames, and solitary columns as large as some.

    `unit` is the PGV in m/s at p PGV/(g tan α) = 1, with p of the solitary column for all.
    """
    for entry in case["cases"]:
        name, column = entry["structure"], Column(**structures[entry["structure"]])
        unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
        for gamma in entry["mass_ratios"]:
            yield Subject(name, RockingFrame(column, gamma), unit, 0.0, entry["share"])
        for gamma in case["as_large_as"]:
            ratio = size_ratio(gamma)
            larger = Column(ratio * column.half_width, ratio * column.half_height)
            yield Subject(name, RockingFrame(larger, 0.0), unit, gamma, entry["share"])


def intensities(case: Mapping[str, Any]) -> np.ndarray:
    """Return the levels of p PGV/(g tan α)."""
    spec = case["intensities"]
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def factors(subject: Subject, record: Record, levels: np.ndarray) -> np.ndarray:
    """Return the factors that bring a motion to the levels of p PGV/(g tan α)."""
    return levels * subject.unit / peak_velocity(record)
