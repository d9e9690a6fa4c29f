"""The worst motions that a search has found against each general sentence, computed again.

A case is a structure and the lobes of a motion, kept in data/worst_found.yaml; `make refute`
searches for a worse one. Both solvers have the same outcomes beside both minima.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.config import read_yaml
from replication.step import check, run, truth
from steps.shared.falls import GRID, STEP, share_that_stays
from steps.shared.lobes import Lobe, record_of
from steps.shared.samples import Cell, check_sample
from steps.shared.sentences import (
    compared,
    half_range,
    premises,
    read_sentences,
    structure_of,
)
from topheavy import Column, Record

PLACES = 4  # decimals of a fall in data/worst_found.yaml
ASIDE = 2.0 * GRID  # g tan α, of an end of an interval: there the plain solver repeats outcomes


def read_cases(path: str) -> list[dict[str, Any]]:
    """Return the cases of a file."""
    return list(read_yaml(path))


def column_and_lobes(case: Mapping[str, Any], height: float) -> tuple[Column, list[Lobe]]:
    """Return the column of a case with a half-height (m), and its lobes in s and g.

    In the file lengths and pauses are over 1/p of the column, amplitudes over g tan α.
    """
    column = Column(height * math.tan(math.radians(case["slenderness"])), height)
    time, unit = 1.0 / column.frequency_parameter, column.uplift_acceleration
    lobes = [
        Lobe(math.copysign(1.0, push), length * time, abs(push) * unit, pause * time)
        for length, push, pause in case["lobes"]
    ]
    return column, lobes


def motion_of(column: Column, lobes: list[Lobe]) -> Record:
    """Return the motion of lobes by its samples, in steps of `falls.STEP` over p."""
    return record_of(lobes, STEP / column.frequency_parameter)


def row_of_case(
    case: Mapping[str, Any], height: float, spec: Mapping[str, Any], contacts: Mapping[str, Any]
) -> dict[str, Any]:
    """Return a row of the table: the fall by three counts, widths, contacts and draws."""
    column, lobes = column_and_lobes(case, height)
    motion, pair = motion_of(column, lobes), (float(case["lighter"]), float(case["heavier"]))
    weaker, stronger, fall = compared(column, pair, motion, spec)
    check(
        round(fall.strict, PLACES) == case["fall"],
        f"data/worst_found.yaml: {case['id']} has a fall of {fall.strict:.{PLACES}f}; expected "
        f"{case['fall']}",
    )
    blocks = [structure_of(column, gamma).block() for gamma in pair]
    ends = stronger.wide_lower, min(weaker.lower, stronger.wide_upper)
    least, friction = premises(column, pair, motion, ends, contacts)
    terms = (spec[name] for name in ("highest", "wide", "draws", "change", "seed"))
    return {
        "id": case["id"],
        "sentence": case["sentence"],
        "slenderness_deg": case["slenderness"],
        "lighter": pair[0],
        "lighter_from": weaker.lower,
        "lighter_width": weaker.upper - weaker.lower,
        "heavier": pair[1],
        "heavier_from": stronger.wide_lower,
        "heavier_width": min(stronger.wide_upper, spec["highest"]) - stronger.wide_lower,
        **fall._asdict(),
        "stays": share_that_stays(lobes, *blocks, *terms),
        "least_vertical": least,
        "friction": friction,
        "half_range": stronger.wide_lower * half_range(motion),
        "lobes": len(lobes),
        "evaluations": case["evaluations"],
        "seed": case["seed"],
        "date": str(case["date"]),
    }


def sides(case: Mapping[str, Any], row: Mapping[str, Any], height: float) -> Iterator[Cell]:
    """Yield outcomes beside both minima, which the plain solver repeats."""
    column, lobes = column_and_lobes(case, height)
    motion = motion_of(column, lobes)
    for gamma, amplitude, fell in (
        (row["heavier"], row["heavier_from"] + ASIDE, True),
        (row["heavier"], row["heavier_from"] - ASIDE, False),
        (row["lighter"], row["heavier_from"] + ASIDE, False),
        (row["lighter"], row["lighter_from"] - ASIDE, False),
    ):
        yield structure_of(column, gamma).block(), motion, None, amplitude, fell


def compute(
    cases: str, spec: Mapping[str, Any], contacts: Mapping[str, Any], column: Mapping[str, float]
) -> dict[str, Any]:
    """Return a row for each case, and the samples of its motion (s, g) of a peak of g tan α."""
    height, rows, samples = column["half_height"], [], []
    for case in read_cases(cases):
        rows.append(row_of_case(case, height, spec, contacts))
        check_sample(sides(case, rows[-1], height))
        motion = motion_of(*column_and_lobes(case, height))
        times = motion.time_step * np.arange(motion.acceleration.size)
        part = {"id": case["id"], "time": times, "acceleration": motion.acceleration}
        samples.append(pd.DataFrame(part))
    return {"worst": pd.DataFrame(rows), "motions": pd.concat(samples)}


def findings(worst_found: pd.DataFrame, contacts: Mapping[str, Any]) -> dict[str, Any]:
    """Return for each sentence its worst case, and the one that remains in most draws."""
    has_contacts = (worst_found.least_vertical > 0.0) & (
        worst_found.friction <= contacts["sufficient"]
    )
    found = {"contacts_are_kept": truth(has_contacts.all(), cases=len(worst_found))}
    for name in read_sentences():
        rows = worst_found[worst_found.sentence == name]
        for label, column in (("worst", "strict"), ("steadiest", "stays")):
            evidence = rows.nlargest(1, column).to_dict("records")[0] if len(rows) else {}
            evidence |= {key: f"{evidence[key]:g}" for key in ("lighter", "heavier") if evidence}
            found[f"{label}_{name}"] = truth(rows.empty, **evidence)
    return found


if __name__ == "__main__":
    run(snakemake, compute, findings)
