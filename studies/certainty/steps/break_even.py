"""At which deficit of the column's √r the benefit of the cap beam ends.

The benefit is the probability that the column overturns less that of the frame, under the same
motions. With a lower √r the column overturns less often, and the estimated difference falls, but
for the scatter of a finite number of motions. It ends where its non-increasing (isotonic) fit is 0.
"""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression

from replication.workbench import Finding, run, truth
from steps.shared.second import beside_a_boundary, by_scipy, overturns
from steps.shared.spectrum import progress
from steps.shared.sweep import Subject, Swept, read_answers
from studies.certainty.subjects import columns, deficits, lowered, stated
from topheavy import Column
from topheavy.risk.ensemble import Ensemble

LEAST = 0.05  # of the columns, and
MOST = 0.95  # of the frames, that overturn where a benefit may end
FINE = 0.5  # of the interval of a deficit: what half the step may move it by

Vector = np.ndarray


class Group(NamedTuple):
    """Structures of one size under the motions of one family, and which levels overturn them."""

    family: str
    column: Column
    subjects: Sequence[Subject]
    swept: Swept


def groups(answered: Sequence[Swept], settings: dict, ensemble: dict) -> Iterator[Group]:
    """Yield the outcomes by size and family; there is an answer for each size."""
    for column, swept in zip(columns(settings), answered, strict=True):
        under = lowered(column, settings).subjects
        for family in ensemble["families"]:
            yield Group(family, column, under, swept.of_family(family))


def end_of(deficits: Vector, benefits: Vector) -> float:
    """Return the deficit at which the non-increasing fit of the benefits reaches zero.

    Lines join the centres of its blocks, over which it is constant. Infinite where it is positive
    in the last block.
    """
    fit = isotonic_regression(benefits, increasing=False)
    first, last = fit.blocks[:-1], fit.blocks[1:] - 1
    centres, values = 0.5 * (deficits[first] + deficits[last]), fit.x[first]
    ended = np.flatnonzero(values <= 0.0)
    if not ended.size:
        return math.inf
    place = int(ended[0])
    if place == 0:
        return 0.0
    before, step = place - 1, centres[place] - centres[place - 1]
    return float(centres[before] + step * values[before] / (values[before] - values[place]))


def ends(group: Group, settings: dict, seed: int) -> Iterator[tuple[dict, Vector]]:
    """Yield the labels of each cell, and its ends: of the ensemble, then of its resamples.

    Only of cells in which at no deficit enough columns overturn, and enough frames do not. Motions
    are resampled within each earthquake, the same for all structures and levels.
    """
    shares, swept = deficits(settings["deficits"]), group.swept
    quakes = swept.scenarios.tolist()
    means = Ensemble(swept.outcomes, quakes, seed=seed, **settings["bootstrap"]).means()
    for place, frame in enumerate(group.subjects[shares.size :], start=shares.size):
        for number, (measure, level, pgv) in enumerate(stated(group.column, settings)):
            column, other = means[:, : shares.size, number], means[:, place, number]
            if column[0, 0] < LEAST or other[0] > MOST:
                continue
            benefits = column - other[:, None]
            labels = {"family": group.family, **frame.labels, "measure": measure, "level": level}
            del labels["deficit"]
            labels |= {"pgv": pgv, "column": column[0, 0], "frame": other[0]}
            labels["coarser"] = end_of(shares[::2], benefits[0, ::2])
            yield labels, np.array([end_of(shares, one) for one in benefits])


def bounds(found: Vector, confidence: float) -> dict[str, float]:
    """Return an end and its interval; infinite where it is beyond the last deficit."""
    tail = (1.0 - confidence) / 2.0
    low, high = np.quantile(found[1:], (tail, 1.0 - tail), method="nearest")
    return {"end": found[0], "end_low": low, "end_high": high}


def sampled(some: list[Group], settings: dict) -> Iterator[tuple]:
    """Yield a seeded sample of the outcomes, half of them beside a boundary, for SciPy."""
    random, count = np.random.default_rng(settings["seed"]), settings["checked"]
    for number in progress(range(count), count, "checks"):
        group = some[number % len(some)]
        outcomes = group.swept.outcomes
        motion, place = (int(random.integers(size)) for size in outcomes.shape[:2])
        level = int(random.integers(outcomes.shape[2]))
        block, record = group.subjects[place].block, group.swept.draws[motion].record()
        *_, pgv = stated(group.column, settings)[level]
        factor = pgv / group.swept.peaks[motion]
        if number % 2:
            factor = beside_a_boundary(partial(overturns, block, record), factor)
        yield block, record, factor, bool(outcomes[motion, place, level])


def main(settings: dict, ensemble: dict, answered: Sequence[Swept]) -> tuple:
    found = list(groups(answered, settings, ensemble))
    confidence = settings["bootstrap"]["confidence"]
    rows, every = [], []
    for group in found:
        seed = settings["seed"] + ensemble["families"].index(group.family)
        for labels, of in ends(group, settings, seed):
            rows.append(labels | bounds(of, confidence))
            every.append(of)
    table = pd.DataFrame(rows)
    middle = np.median(every, axis=0)
    coarser = {"coarser": np.median(table.coarser)}
    median = pd.DataFrame([coarser | bounds(middle, confidence)])
    least, most = settings["measured"]
    measured = pd.DataFrame([{"least": least, "largest": most}])
    largest = float(deficits(settings["deficits"])[-1])
    drawn = findings(table, median, measured)
    drawn["benefit_ends"] = drawn["benefit_ends"].with_evidence(largest=largest)
    agreed, checked = by_scipy(sampled(found, settings)), settings["checked"]
    confirmed = truth(
        agreed["differ"] == 0 and agreed["decided"] > 0,
        checked=checked,
        near_a_boundary=checked // 2,
        **agreed,
    )
    return table, median, measured, drawn | {"break_even_by_scipy": confirmed}


def findings(
    certainty_break_even: pd.DataFrame,
    certainty_break_even_median: pd.DataFrame,
    certainty_measured: pd.DataFrame,
) -> dict[str, Finding]:
    """Return where the benefit ends, from the tables of cells, their median and measured ends."""
    table, (median,) = certainty_break_even, certainty_break_even_median.to_dict("records")
    known = table[np.isfinite(table.end)]
    quoted = [median, table.loc[known.end.idxmin()], table.loc[known.end.idxmax()]]
    moved = moves(pd.DataFrame(quoted))
    return {
        "benefit_ends": truth(
            len(table) > 0 and len(known) == len(table),
            compared=len(table),
            beyond=len(table) - len(known),
            least=float(table.end.min()),
            most=float(known.end.max()),
            lowest_end=float(table.end_low.min()),
            median=finite_or_none(median["end"]),
            median_low=finite_or_none(median["end_low"]),
            median_high=finite_or_none(median["end_high"]),
        ),
        "step_is_fine_enough": truth(
            bool((moved < FINE).all()),
            limit=FINE,
            largest=float(moved.max()),
            cells_beyond=int((moves(table) >= FINE).sum()),
        ),
        "remains_at_measured": remains(table, float(certainty_measured.largest[0])),
    }


def moves(rows: pd.DataFrame) -> pd.Series:
    """Return by how much of its interval half the step moves an end."""
    return (rows.coarser - rows.end).abs() / (rows.end_high - rows.end_low)


def finite_or_none(end: float) -> float | None:
    """Return an end, None if it is beyond the last deficit: JSON has no infinity."""
    return float(end) if math.isfinite(end) else None


def remains(table: pd.DataFrame, deficit: float) -> Finding:
    """Return whether the benefit ends beyond a deficit, in each cell."""
    kept = table.end > deficit
    return truth(
        len(table) > 0 and bool(kept.all()),
        deficit=deficit,
        compared=len(table),
        kept=int(kept.sum()),
    )


def work(job: Any) -> tuple:
    settings, ensemble = job.params.settings, job.params.ensemble
    answered = [
        read_answers(job.input.shards, f"break_even_{place}", ensemble, settings["motions"])
        for place in range(len(settings["sizes"]))
    ]
    return main(settings, ensemble, answered)


if __name__ == "__main__":
    run(snakemake, work)
