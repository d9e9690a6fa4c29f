"""Models of ground motion, the structures that are put under their motions, and what overturns.

`sweep` computes the outcomes of a shard, every n-th motion of each model, and `outcomes` reads
those of all shards. The two sets of synthetic motions also answer the question of rule break_even.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from steps.shared import filtered_noise, synthetic
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    FixedMassColumn,
    Record,
    RockingBlock,
    RockingFrame,
    overturned_by,
)

SETS = ("near-fault", "broadband")
VERTICAL = ", with vertical acceleration"  # appended to the name of a set
FREE_FALL = -1  # outcome of a motion whose vertical acceleration goes beyond −1 g

Settings = Mapping[str, Any]
Outcomes = NDArray[np.int8]


class Motion(NamedTuple):
    """A motion of a model, drawn on request, and one that becomes its vertical component."""

    earthquake: int
    record: Callable[[], Record]
    vertical: Callable[[], Record] | None = None


class Question(NamedTuple):
    """Structures, and the peak ground velocities (m/s) to which each motion is scaled."""

    blocks: list[RockingBlock]
    velocities: NDArray[np.float64]


def models(settings: Settings) -> dict[str, list[Motion]]:
    """Return the motions of each model: the sets, filtered noise, the sets with vertical motion.

    The vertical component of a motion is a later one of the same set and earthquake.
    """
    found: dict[str, list[Motion]] = {}
    noise, seed = settings["noise"], settings["seed"]
    scenarios = [synthetic.Scenario(**scenario) for scenario in settings["scenarios"]]

    def drawn(name: str, place: int, number: int) -> Callable[[], Record]:
        pulse = name == "near-fault"
        return partial(synthetic.motion, seed + place, number, scenarios[place], pulse=pulse)

    numbers = [*product(range(len(scenarios)), range(settings["motions"]))]
    for name in SETS:
        found[name] = [Motion(place, drawn(name, place, number)) for place, number in numbers]
    for place, (soil, corner) in enumerate(product(noise["soils"], noise["corners"])):
        of = filtered_noise.Soil(soil, corner)
        found[f"noise, soil {soil:g} Hz, filter {corner:g} Hz"] = [
            Motion(0, partial(filtered_noise.motion, noise["seed"] + place, number, of))
            for number in range(noise["motions"])
        ]
    later = settings["vertical"]["motions"]
    for name in SETS:
        found[name + VERTICAL] = [
            Motion(place, drawn(name, place, number), drawn(name, place, number + later))
            for place, number in numbers
            if number < later
        ]
    return found


def structures_of(settings: Settings, column: Column) -> list[tuple[str, float, RockingBlock]]:
    """Return name, γ and block of column, column with fixed mass, frame, and frames of other γ."""
    gamma = settings["mass_ratio"]
    return [
        ("column", 0.0, column.block()),
        ("fixed mass", gamma, FixedMassColumn(column, gamma).block()),
        *(
            ("frame", ratio, RockingFrame(column, ratio).block())
            for ratio in [gamma, *settings["other_mass_ratios"]]
        ),
    ]


def question_of(model: str, settings: Settings, column: Column) -> Question:
    """Return the structures and velocities for a model; the last is the stated velocity.

    Frames of other γ are under the two sets only.
    """
    blocks = [block for *_, block in structures_of(settings, column)]
    spec = settings["intensities"]
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter  # m/s
    if model not in SETS:
        blocks, spec, unit = blocks[:3], settings["noise"]["velocities"], 1.0
    grid = unit * np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    return Question(blocks, np.append([] if VERTICAL in model else grid, settings["velocity"]))


def reductions(break_even: Settings) -> NDArray[np.float64]:
    """Return the shares by which √r of the column is lowered, from 0 on."""
    spec = break_even["reductions"]
    return np.round(np.arange(round(spec["highest"] / spec["step"]) + 1) * spec["step"], 9)


def restitution_question(settings: Settings, break_even: Settings, column: Column) -> Question:
    """Return the column with each reduction of √r, then the frame with √r as it is and lowered."""
    frame = RockingFrame(column, settings["mass_ratio"])
    shares = [(column.block(), share) for share in reductions(break_even)]
    shares += [(frame.block(), share) for share in [0.0, *break_even["lowered"]]]
    blocks = [one.with_restitution((1.0 - share) * one.restitution) for one, share in shares]
    return Question(blocks, np.array(break_even["velocities"]))


def components(motion: Motion, settings: Settings) -> tuple[Record, Record | None]:
    """Return a motion and its vertical component, which has a share of its peak acceleration."""
    record = motion.record()
    if motion.vertical is None:
        return record, None
    peak = settings["vertical"]["share"] * record.peak_acceleration
    return record, motion.vertical().scaled_to(pga=peak)


def overturned(question: Question, record: Record, up: Record | None) -> Outcomes:
    """Return which velocities overturn each structure, shape (structures, velocities)."""
    factors = question.velocities / record.peak_velocity
    if up is not None and factors.max() * up.acceleration.min() <= -1.0:
        return np.full((len(question.blocks), factors.size), FREE_FALL, np.int8)
    return overturned_by(question.blocks, record, factors, vertical=up).astype(np.int8)


def sweep(settings: Settings, break_even: Settings, column: Column, shard: str) -> dict[str, Any]:
    """Return the outcomes of a shard, "2-of-8", and the peak velocities (m/s) of its motions."""
    number, of = map(int, shard.split("-of-"))
    found: dict[str, Any] = {}
    for model, motions in models(settings).items():
        questions = {model: question_of(model, settings, column)}
        if model in SETS:
            questions[f"{model}: lowered"] = restitution_question(settings, break_even, column)
        rows, peaks = {name: [] for name in questions}, []
        for each in motions[number - 1 :: of]:
            record, up = components(each, settings)
            peaks.append(record.peak_velocity)
            for name, question in questions.items():
                rows[name].append(overturned(question, record, up))
        found |= {name: np.array(each) for name, each in rows.items()}
        found[f"{model}: peaks"] = np.array(peaks)
        print(f"{len(peaks)} motions, {model}", flush=True)
    return found


def outcomes(shards: Sequence[str], name: str) -> NDArray[Any]:
    """Return the array of a name from the files of all shards, in the order of the motions."""
    parts = {
        int(Path(path).stem.split("_")[-1].split("-")[0]): np.load(path)[name] for path in shards
    }
    whole = np.empty((sum(map(len, parts.values())), *parts[1].shape[1:]), parts[1].dtype)
    for number, part in parts.items():
        whole[number - 1 :: len(parts)] = part
    return whole
