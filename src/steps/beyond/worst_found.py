"""The worst motions that a search has found against each general sentence, computed again.

A case is a structure and the lobes of a motion, kept in data/worst_found.yaml; `make refute`
searches for a worse one. Both solvers have the same outcomes beside both minima.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import pandas as pd

from replication.config import read_yaml
from replication.step import check, run, truth
from steps.shared.falls import GRID, STEP, share_that_stays
from steps.shared.lobes import Lobe, record_of
from steps.shared.samples import Cell, check_sample
from steps.shared.sentences import Case, read_sentences
from topheavy import Column

PLACES = 4  # decimals of a fall in data/worst_found.yaml
BEYOND = 1.1  # over the minimum of the lighter structure: no fall of a draw is counted beyond
ASIDE = 2.0 * GRID  # g tan α, of an end of an interval: there the plain solver repeats outcomes


def case_of(entry: Mapping[str, Any], height: float) -> Case:
    """Return a case of the file, on a column of a half-height (m).

    In the file lengths and pauses are over 1/p of the column, amplitudes over g tan α.
    """
    column = Column(height * math.tan(math.radians(entry["slenderness"])), height)
    time, unit = 1.0 / column.frequency_parameter, column.uplift_acceleration
    lobes = [
        Lobe(sign, length * time, amplitude * unit, pause * time)
        for sign, length, amplitude, pause in entry["lobes"]
    ]
    gammas = float(entry["lighter"]), float(entry["heavier"])
    return Case(column, *gammas, record_of(lobes, STEP * time), lobes)


def row_of_case(
    entry: Mapping[str, Any],
    case: Case,
    spec: Mapping[str, Any],
    contacts: Mapping[str, Any],
    height: float,
) -> dict[str, Any]:
    """Return a row of the table: the fall by three counts, widths, contacts and draws."""
    comparison = case.comparison(spec)
    lighter, heavier, fall = comparison
    check(
        round(fall.strict, PLACES) == entry["fall"],
        f"data/worst_found.yaml: {entry['id']} has a fall of {fall.strict:.{PLACES}f}; expected "
        f"{entry['fall']}",
    )
    least, friction = case.premises(comparison, contacts, height)
    highest = min(spec["highest"], BEYOND * lighter.lower)
    terms = (spec[name] for name in ("wide", "draws", "change", "seed"))
    return {
        **{key: entry[key] for key in ("id", "sentence")},
        "slenderness_deg": entry["slenderness"],
        "lighter": case.lighter,
        "lighter_from": lighter.lower,
        "lighter_width": lighter.upper - lighter.lower,
        "heavier": case.heavier,
        "heavier_from": heavier.wide_lower,
        "heavier_width": min(heavier.wide_upper, spec["highest"]) - heavier.wide_lower,
        **fall._asdict(),
        "stays": share_that_stays(case.lobes, *case.blocks(), highest, *terms),
        "least_vertical": least,
        "friction": friction,
        "lobes": len(case.lobes),
        **{key: entry[key] for key in ("evaluations", "seed", "date")},
    }


def sides(case: Case, row: Mapping[str, Any]) -> Iterator[Cell]:
    """Yield outcomes beside both minima, which the plain solver repeats."""
    lighter, heavier = case.blocks()
    for block, amplitude, overturns in (
        (heavier, row["heavier_from"] + ASIDE, True),
        (heavier, row["heavier_from"] - ASIDE, False),
        (lighter, row["heavier_from"] + ASIDE, False),
        (lighter, row["lighter_from"] - ASIDE, False),
    ):
        yield block, case.motion, None, amplitude, overturns


def compute(
    cases: str, spec: Mapping[str, Any], contacts: Mapping[str, Any], column: Mapping[str, float]
) -> dict[str, Any]:
    """Return a row for each case, and the samples of its motion (s, g) of a peak of g tan α."""
    height, rows, samples = column["half_height"], [], []
    for entry in read_yaml(cases):
        case = case_of(entry, height)
        rows.append(row_of_case(entry, case, spec, contacts, height))
        check_sample(sides(case, rows[-1]))
        motion = {"time": case.motion.time, "acceleration": case.motion.acceleration}
        samples.append(pd.DataFrame({"id": entry["id"], **motion}))
    return {"worst": pd.DataFrame(rows), "motions": pd.concat(samples)}


def findings(worst_found: pd.DataFrame) -> dict[str, Any]:
    """Return for each sentence its case that remains in most draws."""
    results = {}
    for name in read_sentences():
        rows = worst_found[worst_found.sentence == name]
        evidence = rows.nlargest(1, ["stays", "strict"]).to_dict("records")[0] if len(rows) else {}
        evidence |= {key: f"{evidence[key]:g}" for key in ("lighter", "heavier") if evidence}
        results[f"steadiest_{name}"] = truth(rows.empty, **evidence)
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
