"""One sweep of the ensemble: motions × structures × intensities, judged once and read by all.

A step asks the ensemble a question (`Asked`). A job draws every n-th motion once, and judges
all that the steps of a study ask under it side by side. A step reads the outcomes of its question.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from steps.shared.spectrum import progress, shard_of
from topheavy import Record, RockingBlock
from topheavy.ground.synthetic.ensemble import Draw, first_draws
from topheavy.outcomes.overturning import TOLERANCE, Search, outcomes_of_subjects, subjects_of

PARTS = ("motions", "peaks", "outcomes")  # of an answer: family, scenario, number; and as below
MEASURES = {"pgv": lambda record: record.peak_velocity, "pga": lambda r: r.peak_acceleration}
"""Of a motion: PGV in m/s, and PGA in g."""


@dataclass(frozen=True)
class Subject:
    """A structure that is put under the ensemble, and its names in the tables of a step."""

    labels: Mapping[str, Any]
    block: RockingBlock


@dataclass(frozen=True, eq=False)
class Asked:
    """Structures under the first `motions` of each family and scenario.

    `levels`, of the `measure`, has the shape (levels,), or (structures, levels).
    """

    subjects: Sequence[Subject]
    levels: NDArray[np.float64]
    motions: int
    measure: str = "pgv"


@dataclass(frozen=True, eq=False)
class Swept:
    """The answer: `outcomes` has the shape (motions, structures, levels), true if it overturns.

    `draws` are the motions, in the order of the ensemble; `peaks` the measure before scaling.
    """

    draws: list[Draw]
    peaks: NDArray[np.float64]
    outcomes: NDArray[np.bool_]

    def chosen(self, some: NDArray[np.bool_]) -> "Swept":
        """Return the answer for some of the motions."""
        draws = [draw for draw, wanted in zip(self.draws, some, strict=True) if wanted]
        return replace(self, draws=draws, peaks=self.peaks[some], outcomes=self.outcomes[some])

    def of_family(self, family: str) -> "Swept":
        return self.chosen(np.array([draw.family == family for draw in self.draws]))

    @property
    def scenarios(self) -> NDArray[np.int64]:
        return np.array([draw.place for draw in self.draws])


def overturned_under(record: Record, asked: Iterable[Asked]) -> list[NDArray[np.bool_]]:
    """Return what overturns under one motion, for each question: shape (structures, levels)."""
    asked = list(asked)
    searches, factors = [], []
    for one in asked:
        shape = len(one.subjects), one.levels.shape[-1]
        factors += [*np.broadcast_to(one.levels / MEASURES[one.measure](record), shape)]
        searches += [Search(subject.block, record, (0.0, 1.0)) for subject in one.subjects]
    fell = iter(outcomes_of_subjects(subjects_of(searches), factors, TOLERANCE))
    return [np.array([next(fell)[0] for _ in one.subjects]) for one in asked]


def sweep(questions: Mapping[str, Asked], ensemble: Mapping[str, Any], shard: str) -> dict:
    """Return the arrays of one shard, by question: its motions and what they overturn."""
    most = max(one.motions for one in questions.values())
    mine = shard_of(first_draws(ensemble, most), shard)
    found: dict[str, list[tuple]] = {name: [] for name in questions}
    for draw in progress(mine, len(mine), "motions"):
        here = {name: one for name, one in questions.items() if draw.number < one.motions}
        record = draw.record()
        overturned = overturned_under(record, here.values())
        for (name, one), fell in zip(here.items(), overturned, strict=True):
            place = ensemble["families"].index(draw.family)
            motion = place, draw.place, draw.number
            found[name].append((motion, MEASURES[one.measure](record), fell))
    return {
        f"{name} {part}": np.array([row[number] for row in rows])
        for name, rows in found.items()
        for number, part in enumerate(PARTS)
    }


def answers(
    shards: Iterable[Mapping[str, NDArray]], name: str, ensemble: Mapping[str, Any], motions: int
) -> Swept:
    """Return the outcomes of a question from all shards, in whatever order they are.

    Raises
    ------
    ValueError
        When the shards do not have these motions, each once.
    """
    parts = [[shard[f"{name} {part}"] for part in PARTS] for shard in shards]
    places, peaks, outcomes = (
        np.concatenate([part for part in of if len(part)]) for of in zip(*parts, strict=True)
    )
    draws = first_draws(ensemble, motions)
    order = np.lexsort(places.T[::-1])
    wanted = [(ensemble["families"].index(one.family), one.place, one.number) for one in draws]
    if not np.array_equal(places[order], wanted):
        raise ValueError(
            f"{name}: outcomes of {len(places)} motions; expected {len(draws)}, each once: a shard "
            "is incomplete, delete it and run again"
        )
    return Swept(draws, peaks[order], outcomes[order])


def read_answers(
    paths: Iterable[str], name: str, ensemble: Mapping[str, Any], motions: int
) -> Swept:
    """Return the outcomes of a question from the files of all shards; errors as of `answers`."""
    return answers([np.load(path) for path in paths], name, ensemble, motions)
