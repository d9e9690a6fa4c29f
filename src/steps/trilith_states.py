"""The outcome of a trilith that already rocks, on a shake table in steady motion.

A start is a rotation and a velocity of the frame, at a phase of the shake table.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy import Column, Pulse, Response, RockingFrame, simulate
from topheavy.ground.excitation import Segment
from topheavy.ground.shaking_table import table_motion
from topheavy.second import reference

SEED = 2014  # of the starts that SciPy judges again
STEP = 0.01  # s, between the samples of the second half of a history
SETTLED = 1e-3  # of α: what the last quarter of a history may differ from the one before
ALIKE = 1e-6  # of α: what the steady rotations of two solvers may differ by
BESIDE = 0.01  # of α: how close two starts of different outcome are to each other
OUTCOMES = {"no uplift": "rests"}  # a frame that starts upright and at rest


class Start(NamedTuple):
    """The quarter cycles of the table that have passed, θ over α, and θ̇ over α p̂."""

    quarters: int
    rotation: float
    velocity: float


class Course(NamedTuple):
    """An outcome; if it is rocking, max|θ|/α in the third and the last quarter of the history."""

    outcome: str
    before: float
    steady: float


@dataclass(frozen=True)
class Later:
    """A pulse of which a time `since` (s) has passed: an excitation for SciPy."""

    motion: Pulse
    since: float

    @property
    def duration(self) -> float:
        """How long it still lasts, s."""
        return self.motion.duration - self.since

    def excitation(self, t: Any) -> Any:
        """Return the ground acceleration in g at the time(s) t in s."""
        return self.motion.excitation(np.asarray(t) + self.since)

    def segments(self, until: float) -> list[Segment]:
        """Return the segments of the pulse that are not over, earlier by `since`."""
        return [
            Segment(
                max(0.0, one.start - self.since),
                one.stop - self.since,
                lambda t, wave=one.acceleration: wave(t + self.since),
            )
            for one in self.motion.segments(until + self.since)
            if one.stop > self.since
        ]


def by_taylor(frame: RockingFrame, motion: Pulse, start: Start, duration: float) -> Course:
    """Return the outcome of a start on a harmonic shake table, by the library.

    The harmonic is a sine. After an odd number of quarter cycles it is a cosine at first; the frame
    is followed under a cosine pulse to the next zero, where the sine takes over.
    """
    rotation, velocity = _state(frame, start)
    half, odd = divmod(start.quarters, 2)
    motion, lead = motion.scaled((-1.0) ** half), 0.0
    if odd:
        lead = 1.5 * math.pi / motion.angular_frequency
        cosine = Pulse("one-cosine", motion.amplitude, motion.angular_frequency)
        first = simulate(
            frame, cosine, rotation=rotation, velocity=velocity, duration=lead, samples=[0.0, lead]
        )
        rotation, velocity = first.rotation[-1], first.velocity[-1]
        if math.isnan(rotation):  # flat on the ground
            return Course("overturned", math.nan, math.nan)
    return _followed(simulate, frame, motion, rotation, velocity, duration, lead)


def by_scipy(frame: RockingFrame, motion: Pulse, start: Start, duration: float) -> Course:
    """Return the same by SciPy, without a change of the pulse."""
    since = start.quarters * 0.5 * math.pi / motion.angular_frequency
    return _followed(
        reference.simulate, frame, Later(motion, since), *_state(frame, start), duration
    )


def _state(frame: RockingFrame, start: Start) -> tuple[float, float]:
    """Return θ (rad) and θ̇ (rad/s)."""
    alpha = frame.slenderness
    return start.rotation * alpha, start.velocity * alpha * frame.frequency_parameter


def _followed(
    route: Callable[..., Response],
    frame: RockingFrame,
    motion: Any,
    rotation: float,
    velocity: float,
    duration: float,
    lead: float = 0.0,
) -> Course:
    """Return the course of a history of which a time `lead` (s) has passed."""
    late, lasting = np.arange(0.5 * duration, duration, STEP) - lead, duration - lead
    found = route(
        frame, motion, rotation=rotation, velocity=velocity, duration=lasting, samples=late
    )
    if found.outcome != "rocking":
        return Course(OUTCOMES.get(found.outcome, found.outcome), math.nan, math.nan)
    size = np.abs(found.rotation) / frame.slenderness
    return Course("rocking", *(float(half.max()) for half in np.array_split(size, 2)))


def starts(spec: dict) -> Iterator[Start]:
    """Yield every start of the config: a grid about upright and at rest, at each phase."""
    for quarters in spec["quarters"]:
        for rotation in _symmetric(spec["rotations"]):
            for velocity in _symmetric(spec["velocities"]):
                yield Start(quarters, rotation, velocity)


def _symmetric(axis: dict) -> list[float]:
    """Return so many numbers from −largest to largest, each with its opposite."""
    places = np.arange(axis["points"]) * 2 - (axis["points"] - 1)
    return [float(axis["largest"] * place / (axis["points"] - 1)) for place in places]


def outcomes(frame: RockingFrame, motion: Pulse, spec: dict) -> pd.DataFrame:
    """Return a row for each start: its outcome, and the rotation in the last quarters, over α."""
    rows = [
        start._asdict() | by_taylor(frame, motion, start, spec["duration"])._asdict()
        for start in starts(spec)
    ]
    return pd.DataFrame(rows)


def counts(table: pd.DataFrame) -> dict[str, int]:
    """Return how many starts keep rocking, come to rest and overturn."""
    return {
        "starts": len(table),
        **{
            name: int((table.outcome == outcome).sum())
            for name, outcome in (
                ("keep_rocking", "rocking"),
                ("come_to_rest", "rests"),
                ("overturn", "overturned"),
            )
        },
    }


def beside_a_boundary(
    frame: RockingFrame, motion: Pulse, table: pd.DataFrame, spec: dict, number: int
) -> list[tuple[Start, Course]]:
    """Return pairs of starts of different outcome that are closer than BESIDE, by the library.

    Each lies between two neighbours of the grid, chosen at random among those that differ.
    """
    random, found = np.random.default_rng(SEED), []
    rows = list(table.itertuples(index=False))
    apart = len(_symmetric(spec["velocities"]))  # rows from one rotation to the next
    pairs = [
        (low, high)
        for low, high in zip(rows, rows[apart:], strict=False)
        if low.quarters == high.quarters and low.outcome != high.outcome
    ]
    for place in random.permutation(len(pairs))[:number]:
        ends = [_judged(row) for row in pairs[place]]
        while abs(ends[1][0].rotation - ends[0][0].rotation) > BESIDE:
            half = 0.5 * (ends[0][0].rotation + ends[1][0].rotation)
            middle = ends[0][0]._replace(rotation=half)
            course = by_taylor(frame, motion, middle, spec["duration"])
            ends[int(course.outcome != ends[0][1].outcome)] = (middle, course)
        found += ends
    return found


def _judged(row: Any) -> tuple[Start, Course]:
    """Return the start and the course of a row of the table."""
    return Start(*row[:3]), Course(*row[3:])


def second_route(
    frame: RockingFrame, motion: Pulse, table: pd.DataFrame, spec: dict
) -> pd.DataFrame:
    """Judge a sample of starts by SciPy: some of all, and some on both sides of a boundary."""
    random = np.random.default_rng(SEED)
    chosen = table.iloc[random.permutation(len(table))[: spec["sample"]["points"]]]
    tried = [_judged(row) for row in chosen.itertuples(index=False)]
    near = beside_a_boundary(frame, motion, table, spec, spec["checked_by_second_route"])
    rows = []
    for place, (start, ours) in enumerate(tried + near):
        other = by_scipy(frame, motion, start, spec["duration"])
        rock = ours.outcome == other.outcome == "rocking"
        rows.append(
            start._asdict()
            | {
                "beside_a_boundary": place >= len(tried),
                "outcome": ours.outcome,
                "by_scipy": other.outcome,
                "apart": abs(ours.steady - other.steady) if rock else 0.0,
            }
        )
    return pd.DataFrame(rows)


def _agreement(sample: pd.DataFrame) -> Finding:
    """Return whether SciPy finds the same, from the table of the sample."""
    near = int(sample.beside_a_boundary.sum())
    tried, differ = len(sample) - near, int((sample.outcome != sample.by_scipy).sum())
    return truth(
        bool(tried) and bool(near) and differ == 0 and sample.apart.max() < ALIKE,
        starts=tried,
        beside_a_boundary=near,
        outcomes_that_differ=differ,
        largest_apart_over_alpha=sample.apart.max(),
    )


def main(settings: dict, spec: dict) -> tuple[pd.DataFrame, pd.DataFrame, dict[str, Finding]]:
    """Return the outcome of every start, a sample of them by SciPy, and the findings."""
    frame = RockingFrame(Column(**settings["column"]), settings["mass_ratio"])
    motion = table_motion(settings["table_amplitude"], settings["table_frequency"])
    table = outcomes(frame, motion, spec)
    sample = second_route(frame, motion, table, spec)
    drawn, (difference, change) = findings(table, sample), unsettled(table)
    drawn["one_steady_rotation"] = drawn["one_steady_rotation"].with_evidence(
        largest_difference=difference, largest_change_to_the_last_quarter=change
    )
    return table, sample, drawn


def unsettled(table: pd.DataFrame) -> tuple[float, float]:
    """Return how far steady rotations are apart, and change by the last quarter, over α.

    They have fewer digits in the table as it is published.
    """
    kept = table[table.outcome == "rocking"]
    change = (kept.steady - kept.before).abs().max()
    return float(kept.steady.max() - kept.steady.min()), float(change)


def findings(trilith_states: pd.DataFrame, trilith_sample: pd.DataFrame) -> dict[str, Finding]:
    """Return what most starts come to, from the tables of outcomes and of the sample."""
    table = trilith_states
    every, kept = counts(table), table[table.outcome == "rocking"]
    return {
        "most_starts_keep_rocking": truth(
            every["keep_rocking"] > every["starts"] / 2
            and every["come_to_rest"] > 0
            and every["overturn"] > 0,
            **every,
            by_quarter_cycles={
                f"{quarters}": counts(rows) for quarters, rows in table.groupby("quarters")
            },
        ),
        "one_steady_rotation": truth(
            len(kept) > 0 and max(unsettled(table)) < SETTLED,
            starts=len(kept),
            steady_over_alpha=float(kept.steady.median()),
        ),
        "second_route": _agreement(trilith_sample),
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.states)


if __name__ == "__main__":
    run(snakemake, work)
