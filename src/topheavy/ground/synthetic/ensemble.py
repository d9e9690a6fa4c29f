"""The seeded ensemble of motions."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from topheavy import Record
from topheavy.ground.synthetic.motions import Scenario, motion


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

    def record(self) -> Record:
        pulse = self.family == "near-fault"
        return motion(self.seed + self.place, self.number, self.scenario, pulse=pulse)


def first_draws(case: Mapping[str, Any], motions: int) -> list[Draw]:
    """Return the first motions of each family and scenario, in the order of the tables."""
    return [
        Draw(family, place, number, case["seed"], Scenario(**scenario))
        for family in case["families"]
        for place, scenario in enumerate(case["scenarios"])
        for number in range(motions)
    ]
