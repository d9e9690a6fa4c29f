"""Bare column, fixed mass and frame under the ensemble: what overturns first, and how often.

The intensity is p PGV/(g tan α) with p and α of the bare column, for all three. The lowest
intensity that overturns is one of levels in equal ratios. Intervals are those of motions drawn
anew; the three structures stay paired under each motion.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.histories import NUDGE
from steps.shared.spectrum import progress
from steps.vase_searches import rivals
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    Record,
    overturned_by,
    overturned_together,
    reference,
)
from topheavy.fragility.resampling import interval, means, resampled
from topheavy.structures import Structure
from topheavy.synthetic.ensemble import first_draws
from topheavy.synthetic.motions import peak_velocity

LEAST = 0.5  # of the motions: a structure that comes last under more of them is not the weakest


def geometric(spec: Mapping[str, float]) -> np.ndarray:
    """Return the levels of p PGV/(g tan α)."""
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def factors(column: Column, record: Record, levels: np.ndarray) -> np.ndarray:
    """Return the factors that bring a motion to the levels of p PGV/(g tan α)."""
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    return levels * unit / peak_velocity(record)


def first(outcomes: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Return the lowest level, of the last axis, that overturns; infinite where none does."""
    falls = outcomes.any(axis=-1)
    return np.where(falls, levels[np.argmax(outcomes, axis=-1)], np.inf)


def told(structure: Structure, record: Record, scales: np.ndarray, tightened: float) -> bool:
    """Whether the outcomes at all factors bear a nudge of the record and a tighter tolerance."""
    found = overturned_by(structure, record, scales)
    others = [overturned_by(structure, record, scales * (1.0 + off)) for off in (-NUDGE, NUDGE)]
    others.append(overturned_by(structure, record, scales, tolerance=tightened))
    return all(np.array_equal(found, other) for other in others)


def capacity_ratio(levels: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the ratio of geometric means of the overturning intensity, other over one.

    The mean of ln s is the area above the fragility curve over ln s, so that curves need no shape.
    The last axis of the probabilities has the levels, whose range counts, and no more.
    """
    steps = np.gradient(np.log(levels))
    return np.exp(((one - other) * steps).sum(axis=-1))


def curves(
    family: str, under: list, outcomes: np.ndarray, levels: np.ndarray, settings: dict
) -> tuple[pd.DataFrame, list[dict]]:
    """Return the fragility of each structure, and how it ranks beside the bare column."""
    boot = settings["bootstrap"]
    weights = resampled(len(outcomes), boot["resamples"], boot["seed"])

    def bounds(name: str, values: np.ndarray) -> dict:
        found = interval(values, boot["confidence"])
        return dict(zip((name, f"{name}_low", f"{name}_high"), found, strict=True))

    shares = means(weights, outcomes)
    at = first(outcomes, levels)
    tables, ranks = [], []
    for place, (name, gamma, _) in enumerate(under):
        labels = {"family": family, "structure": name, "mass_ratio": gamma}
        tables.append(
            pd.DataFrame(
                labels
                | {"intensity": levels}
                | bounds("probability", shares[:, place])
                | bounds("less", shares[:, 0] - shares[:, place])
            )
        )
        if name == "bare":
            continue
        sooner, later = at[:, place] < at[:, 0], at[:, place] > at[:, 0]
        apart = capacity_ratio(levels, shares[:, 0], shares[:, place])
        ranks.append(
            labels
            | {"motions": len(outcomes)}
            | bounds("sooner", means(weights, sooner))
            | bounds("later", means(weights, later))
            | bounds("over_bare", apart)
        )
    return pd.concat(tables), ranks


def second_route(
    cells: list[tuple[Structure, Record, float]], found: list[bool], tightened: float
) -> Finding:
    """Judge cells again by SciPy, those that a nudge or a tighter tolerance does not change."""
    differ = compared = 0
    for (structure, record, factor), fell in zip(cells, found, strict=True):
        if told(structure, record, np.array([factor]), tightened):
            compared += 1
            differ += reference.judge(structure, record.scaled(factor)).overturned != fell
    return truth(differ == 0 and compared > 0, cells=compared, differ=differ)


def main(settings: dict, ensemble: dict, tightened: float) -> tuple:
    column = Column(**settings["column"])
    under, levels = (
        list(rivals(column, settings["mass_ratios"])),
        geometric(settings["intensities"]),
    )
    chosen = first_draws(ensemble, settings["motions"])
    outcomes, cells, random = [], [], np.random.default_rng(ensemble["seed"])
    wanted = set(random.permutation(len(chosen))[: settings["checked_by_second_route"]].tolist())
    for number, draw in enumerate(progress(chosen, len(chosen), "motions")):
        record = draw.record()
        scales = factors(column, record, levels)
        outcomes.append(overturned_together([one for *_, one in under], record, scales))
        if number in wanted:  # just below the lowest intensity that overturns, and at it
            place = random.integers(len(under))
            at = max(1, int(np.argmax(outcomes[-1][place])))
            for level in (at - 1, at):
                fell = bool(outcomes[-1][place][level])
                cells.append(((under[place][2], record, scales[level]), fell))
    fell, families = np.array(outcomes), np.array([draw.family for draw in chosen])
    tables, ranks = [], []
    for family in ensemble["families"]:
        table, rank = curves(family, under, fell[families == family], levels, settings)
        tables.append(table)
        ranks += rank
    ranking = pd.DataFrame(ranks)
    drawn = findings(ranking)
    lowers = "fixed_mass_lowers_the_capacity"
    drawn[lowers] = drawn[lowers].with_evidence(motions=int(fell.shape[0]))
    checked = second_route(*zip(*cells, strict=True), tightened)
    return pd.concat(tables), ranking, drawn | {"vase_second_route": checked}


def findings(reversals_vase_ranks: pd.DataFrame) -> dict[str, Finding]:
    """Return how the capacities of fixed mass and frame rank, from the table of ranks."""
    ranking = reversals_vase_ranks
    fixed, free = (ranking[ranking.structure == name] for name in ("fixed", "free"))
    return {
        "fixed_mass_lowers_the_capacity": truth(
            (fixed.over_bare_high < 1.0).all(),
            largest=fixed.over_bare.max(),
            least=fixed.over_bare.min(),
        ),
        "free_mass_raises_the_capacity": truth(
            (free.over_bare_low > 1.0).all(),
            largest=free.over_bare.max(),
            least=free.over_bare.min(),
        ),
        "every_motion": truth(
            not (fixed.later.any() or free.sooner.any()),
            holds_when=(fixed.later_high < LEAST).all() and (free.sooner_high < LEAST).all(),
            condition="of most motions; a few change the order",
            fixed_later=fixed.later.max(),
            free_sooner=free.sooner.max(),
        ),
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
