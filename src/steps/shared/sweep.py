"""Models of ground motion, the structures that are put under their motions, and what overturns.

As a script it computes the outcomes of a shard, every n-th motion of each model; `outcomes` reads
those of all shards. The two sets of synthetic motions also answer the question of rule break_even.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from io import BytesIO
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from replication.step import geometric, run
from steps.shared import filtered_noise, synthetic
from steps.shared.cases import lowered
from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn, Record, RockingBlock, RockingFrame
from topheavy.kernel.taylor import OUTCOME, PEAK
from topheavy.outcomes.search import cases_of, outcomes_of_factors

FAMILIES = ("near-fault", "broadband")
VERTICAL = ", with vertical acceleration"  # appended to the name of the last set
FREE_FALL = -1  # outcome of a motion whose vertical acceleration goes beyond −1 g

Settings = Mapping[str, Any]


class Motion(NamedTuple):
    """A motion of a model, drawn on request, and one that becomes its vertical component."""

    record: Callable[[], Record]
    vertical: Callable[[], Record] | None = None


class Question(NamedTuple):
    """Structures, and the peak ground velocities (m/s) to which each motion is scaled."""

    blocks: list[RockingBlock]
    velocities: NDArray[np.float64]
    of_peaks: bool = False  # asks for peak rotations instead of outcomes

    def factors(self, record: Record) -> NDArray[np.float64]:
        """Return the factors that scale a motion to the velocities."""
        return self.velocities / record.peak_velocity


def sets(settings: Settings) -> list[str]:
    """Return the names of the sets of synthetic motions, one for each family and earthquake."""
    quakes = [f"M {scenario['magnitude']:g}" for scenario in settings["scenarios"]]
    return [f"{family}, {quake}" for family, quake in product(FAMILIES, quakes)]


def models(settings: Settings) -> dict[str, list[Motion]]:
    """Return the motions of each model: the sets, filtered noise, a set with vertical motion.

    The vertical component of a motion is another one of the same set.
    """
    by_model, (count, seed) = {}, (settings["motions"], settings["seed"])
    scenarios = [synthetic.Scenario(**scenario) for scenario in settings["scenarios"]]

    def random_motion(family: str, place: int, number: int) -> Callable[[], Record]:
        quake = (seed + place, number, scenarios[place])
        return partial(synthetic.motion, *quake, pulse=family == FAMILIES[0])

    parts = [*product(FAMILIES, range(len(scenarios)))]
    for name, part in zip(sets(settings), parts, strict=True):
        by_model[name] = [Motion(random_motion(*part, number)) for number in range(count)]
    noise = settings["noise"]
    for place, (soil, corner) in enumerate(product(noise["soils"], noise["corners"])):
        filters = filtered_noise.Soil(soil, corner)
        by_model[f"noise, soil {soil:g} Hz, filter {corner:g} Hz"] = [
            Motion(partial(filtered_noise.motion, noise["seed"] + place, number, filters))
            for number in range(noise["motions"])
        ]
    by_model[sets(settings)[-1] + VERTICAL] = [
        Motion(random_motion(*parts[-1], number), random_motion(*parts[-1], number + count))
        for number in range(count)
    ]
    return by_model


def compared(settings: Settings, column: Column) -> list[RockingBlock]:
    """Return the column, the column with a mass fixed on top, and the frame with the same γ."""
    gamma = settings["mass_ratio"]
    frame, fixed = RockingFrame(column, gamma), FixedMassColumn(column, gamma)
    return [column.block(), fixed.block(), frame.block()]


def stated(settings: Settings, column: Column) -> Question:
    """Return the compared structures, the stated velocity, and a little more than it."""
    velocities = settings["velocity"] * np.array([1.0, 1.0 + settings["change"]])
    return Question(compared(settings, column), velocities)


def frames(settings: Settings, column: Column) -> Question:
    """Return the column (γ = 0) and its frames, and velocities."""
    spec, gammas = settings["intensities"], [0.0, *settings["mass_ratios"]]
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter  # m/s
    grid = unit * geometric(spec)
    return Question([RockingFrame(column, gamma).block() for gamma in gammas], grid)


def reductions(break_even: Settings) -> NDArray[np.float64]:
    """Return the shares by which √r of the column is lowered, from 0 on."""
    spec = break_even["reductions"]
    return np.round(np.arange(round(spec["highest"] / spec["step"]) + 1) * spec["step"], 9)


def restitution_within(frame: RockingFrame, contact: float) -> float:
    """Return √r if the impulses of an impact act within the contacts and not at their edges.

    They act at the share `contact` of the half-width from the axis of a column, at its base and
    its top. This is our form of the idea of Kalliontzis et al. (2016), whose paper we did not see.
    Angular momentum of a column about the point at its base, with the change of momentum of its
    part of the cap beam at the top, gives √r. A contact of 1 is Eq. (25), and 0 loses nothing.
    """
    sine, cosine = math.sin(frame.slenderness) ** 2, math.cos(frame.slenderness) ** 2
    inertia, cap = 1.0 / 3.0 + cosine, 4.0 * frame.mass_ratio
    lost = contact * sine * (1.0 + cap)
    return (inertia + cap * cosine - lost) / (inertia + cap * cosine + lost)


def restitution_question(settings: Settings, break_even: Settings, column: Column) -> Question:
    """Return the column with each reduction of √r, then the frame with √r as it is and lowered.

    The last two are column and frame with impulses within their contacts.
    """
    frame = RockingFrame(column, settings["mass_ratio"])
    shares = [(column.block(), share) for share in reductions(break_even)]
    shares += [(frame.block(), share) for share in [0.0, *break_even["lowered"]]]
    blocks = [lowered(structure, share) for structure, share in shares]
    for structure in (RockingFrame(column, 0.0), frame):
        blocks.append(structure.block(restitution_within(structure, break_even["contact"])))
    return Question(blocks, np.array(break_even["velocities"]))


def components(motion: Motion, settings: Settings) -> tuple[Record, Record | None]:
    """Return a motion and its vertical component, which has a share of its peak acceleration."""
    record = motion.record()
    if motion.vertical is None:
        return record, None
    peak = settings["vertical"]["share"] * record.peak_acceleration
    return record, motion.vertical().scaled_to(pga=peak)


def answers(questions: Sequence[Question], record: Record, up: Record | None) -> list[NDArray[Any]]:
    """Return for each question what overturns, or peaks, shape (structures, velocities).

    A peak is that of |θ|/α, infinite where the structure overturns.
    """
    grids = [np.tile(question.factors(record), (len(question.blocks), 1)) for question in questions]
    factors = np.concatenate([grid.ravel() for grid in grids])
    if up is not None and factors.max() * up.acceleration.min() <= -1.0:
        return [np.full(grid.shape, FREE_FALL, np.int8) for grid in grids]
    blocks = [block for question in questions for block in question.blocks]
    index = np.repeat(np.arange(len(blocks)), [row.size for grid in grids for row in grid])
    cases = cases_of(blocks, record, (factors.min(), factors.max()), up)
    detail = PEAK if any(question.of_peaks for question in questions) else OUTCOME
    peaks, overturned, _ = outcomes_of_factors(cases, index, factors, detail=detail)
    results, ends = [], np.cumsum([grid.size for grid in grids])
    for question, grid, end in zip(questions, grids, ends, strict=True):
        part = slice(end - grid.size, end)
        answer = overturned[part].astype(np.int8)
        if question.of_peaks:
            answer = np.nan_to_num(peaks[part] / question.blocks[0].slenderness, nan=np.inf)
        results.append(answer.reshape(grid.shape))
    return results


def compute(
    settings: Settings, break_even: Settings, structures: Mapping[str, Settings], shard: str
) -> dict[str, bytes]:
    """Return the outcomes of a shard, "2-of-8", and the peak velocities (m/s) of its motions."""
    number, shards = map(int, shard.split("-of-"))
    columns = {name: Column(**structures[name]) for name in settings["structures"]}
    column, spec = columns[settings["structure"]], settings["rotations"]
    tilted = Question(frames(settings, column).blocks, np.array(spec["velocities"]), of_peaks=True)
    by_name = {name: frames(settings, structure) for name, structure in columns.items()}
    fixed = Question([compared(settings, column)[1]], by_name[settings["structure"]].velocities)
    arrays: dict[str, Any] = {}
    for model, motions in models(settings).items():
        count, in_set = len(motions), model in sets(settings)
        fewer = settings["fewer"] if in_set else count
        questions = [(model, stated(settings, column), count)]
        if not model.endswith(VERTICAL):
            questions += [(f"{model}: {name}", item, fewer) for name, item in by_name.items()]
        if in_set:
            lowered = restitution_question(settings, break_even, column)
            questions.append((f"{model}: fixed mass", fixed, fewer))
            questions.append((f"{model}: lowered", lowered, count))
            questions.append((f"{model}: rotations", tilted, spec["motions"]))
        rows: dict[str, list] = {name: [] for name, *_ in questions}
        peaks = rows[f"{model}: peaks"] = []
        for place in range(number - 1, count, shards):
            record, up = components(motions[place], settings)
            peaks.append(record.peak_velocity)
            due = [(name, question) for name, question, most in questions if place < most]
            answered = answers([question for _, question in due], record, up)
            for (name, _), answer in zip(due, answered, strict=True):
                rows[name].append(answer)
        arrays |= {name: np.array(values) for name, values in rows.items()}
        print(f"{len(peaks)} motions, {model}", flush=True)
    content = BytesIO()
    np.savez_compressed(content, **arrays)
    return {"outcomes": content.getvalue()}


def outcomes(shards: Sequence[str], name: str) -> NDArray[Any]:
    """Return the array of a name from the files of all shards, in the order of the motions."""
    parts = {
        int(Path(path).stem.split("_")[-1].split("-")[0]): np.load(path)[name] for path in shards
    }
    whole = np.empty((sum(map(len, parts.values())), *parts[1].shape[1:]), parts[1].dtype)
    for number, part in parts.items():
        whole[number - 1 :: len(parts)] = part
    return whole


if __name__ == "__main__":
    run(snakemake, compute)
