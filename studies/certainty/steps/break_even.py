"""At which deficit of the column's √r the benefit of the cap beam ends.

The benefit is the probability that the column overturns less that of the frame, under the same
motions. With a lower √r the column overturns less often, and the estimated difference falls, but
for the scatter of a finite number of motions. It ends where its non-increasing (isotonic) fit is 0.
"""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.changed import Subject, columns, shares, subjects
from studies.certainty.rated import fallen, stated
from studies.certainty.second import beside_a_boundary, decided
from topheavy import Column, judge, reference
from topheavy.fragility.resampling import means_within
from topheavy.synthetic.ensemble import first_draws

LEAST = 0.05  # of the columns, and
MOST = 0.95  # of the frames, that overturn where a benefit may end
FINE = 0.1  # of the interval of a deficit: what half the step may move it by

Vector = np.ndarray


class Group(NamedTuple):
    """Structures of one size under the motions of one family, and which levels overturn them.

    `fell` has the shape (motions, structures, levels); `motions` a row for each motion.
    """

    family: str
    column: Column
    under: list[Subject]
    fell: np.ndarray
    motions: pd.DataFrame


def groups(shards: pd.DataFrame, settings: dict, ensemble: dict) -> Iterator[Group]:
    """Yield the outcomes in all shards, by size and family."""
    motions = settings["runs"][settings["run"]]["motions"] * len(ensemble["scenarios"])
    for column in columns(settings):
        under = subjects(column, settings)
        here = shards[np.isclose(shards.height, under[0].height)]
        for family in ensemble["families"]:
            fell, firsts = fallen(here[here.family == family], motions, len(under))
            yield Group(family, column, under, fell, firsts)


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
    deficits, under = shares(settings["deficits"]), group.under
    quakes, resamples = group.motions.scenario.tolist(), settings["bootstrap"]["resamples"]
    means = means_within(group.fell, quakes, resamples, seed)
    for place, frame in enumerate(under[deficits.size :], start=deficits.size):
        for number, (measure, level, pgv) in enumerate(stated(group.column, settings)):
            column, other = means[:, : deficits.size, number], means[:, place, number]
            if column[0, 0] < LEAST or other[0] > MOST:
                continue
            benefits = column - other[:, None]
            labels = {"family": group.family, "height": frame.height}
            labels |= {"mass_ratio": frame.mass_ratio, "measure": measure, "level": level}
            labels |= {"pgv": pgv, "column": column[0, 0], "frame": other[0]}
            labels["coarser"] = end_of(deficits[::2], benefits[0, ::2])
            yield labels, np.array([end_of(deficits, one) for one in benefits])


def bounds(found: Vector, confidence: float) -> dict[str, float]:
    """Return an end and its interval; infinite where it is beyond the last deficit."""
    tail = (1.0 - confidence) / 2.0
    low, high = np.quantile(found[1:], (tail, 1.0 - tail), method="nearest")
    return {"end": found[0], "end_low": low, "end_high": high}


def confirmed(sampled: list[Group], settings: dict, ensemble: dict) -> Finding:
    """Return whether SciPy finds the same outcomes, of a seeded sample, half beside a boundary.

    Outcomes that a billionth of the motion changes are not compared.
    """
    random, told, differ = np.random.default_rng(settings["seed"]), 0, 0
    every = first_draws(ensemble, settings["runs"][settings["run"]]["motions"])
    draws = {tuple(draw.labels.values()): draw for draw in every}
    count = settings["checked"]
    for number in progress(range(count), count, "checks"):
        group = sampled[number % len(sampled)]
        motion, place = (int(random.integers(size)) for size in group.fell.shape[:2])
        level = int(random.integers(group.fell.shape[2]))
        row, block = group.motions.iloc[motion], group.under[place].block
        record = draws[row.family, row.scenario, row.motion].record()
        *_, pgv = stated(group.column, settings)[level]
        factor = pgv / record.peak_velocity

        def overturns(by: float, block=block, record=record) -> bool:
            return judge(block, record.scaled(by)).overturned

        fell = bool(group.fell[motion, place, level])
        if number % 2:
            factor = beside_a_boundary(overturns, factor)
        if decided(overturns, factor) is not None:
            told += 1
            differ += reference.judge(block, record.scaled(factor)).overturned != fell
    return truth(
        differ == 0 and told > 0,
        checked=settings["checked"],
        near_a_boundary=settings["checked"] // 2,
        told=told,
        differ=differ,
    )


def main(settings: dict, ensemble: dict, shards: pd.DataFrame) -> tuple:
    found = list(groups(shards, settings, ensemble))
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
    largest = float(shares(settings["deficits"])[-1])
    drawn = findings(table, median, measured)
    drawn["benefit_ends"] = drawn["benefit_ends"].with_evidence(largest=largest)
    by_scipy = confirmed(found, settings, ensemble)
    return table, median, measured, drawn | {"break_even_by_scipy": by_scipy}


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
            median=told(median["end"]),
            median_low=told(median["end_low"]),
            median_high=told(median["end_high"]),
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


def told(end: float) -> float | None:
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
    shards = pd.concat(map(pd.read_csv, job.input.shards), ignore_index=True)
    return main(job.params.settings, job.params.ensemble, shards)


if __name__ == "__main__":
    run(snakemake, work)
