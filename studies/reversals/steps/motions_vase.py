"""Bare column, fixed mass and frame under the ensemble: what overturns first, and how often.

The intensity is p PGV/(g tan α) with p and α of the bare column, for all three. The lowest
intensity that overturns is one of levels in equal ratios. Intervals are those of motions drawn
anew; the three structures stay paired under each motion.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import by_scipy
from steps.shared.sweep import Swept, read_answers
from studies.reversals.subjects import VASE, intensities, vase_and_frame
from topheavy.risk.ensemble import Ensemble

LEAST = 0.5  # of the motions: a structure that comes last under more of them is not the weakest


def first(outcomes: np.ndarray, levels: np.ndarray) -> np.ndarray:
    """Return the lowest level, of the last axis, that overturns; infinite where none does."""
    falls = outcomes.any(axis=-1)
    return np.where(falls, levels[np.argmax(outcomes, axis=-1)], np.inf)


def capacity_ratio(levels: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the ratio of geometric means of the overturning intensity, other over one.

    The mean of ln s is the area above the fragility curve over ln s, so that curves need no shape.
    The last axis of the probabilities has the levels, whose range counts, and no more.
    """
    steps = np.gradient(np.log(levels))
    return np.exp(((one - other) * steps).sum(axis=-1))


def curves(
    family: str, ensemble: Ensemble, settings: dict
) -> tuple[pd.DataFrame, list[dict[str, Any]]]:
    """Return the fragility of each structure, and how it ranks beside the bare column."""
    levels, shares = intensities(settings), ensemble.means()
    at = first(ensemble.outcomes, levels)
    tables, ranks = [], []
    for place, subject in enumerate(vase_and_frame(settings).subjects):
        labels = {"family": family, **subject.labels}
        tables.append(
            pd.DataFrame(
                labels
                | {"intensity": levels}
                | ensemble.bounds("probability", shares[:, place])
                | ensemble.bounds("less", shares[:, 0] - shares[:, place])
            )
        )
        if place == 0:
            continue
        sooner, later = at[:, place] < at[:, 0], at[:, place] > at[:, 0]
        apart = capacity_ratio(levels, shares[:, 0], shares[:, place])
        ranks.append(
            labels
            | {"motions": len(at)}
            | ensemble.bounds("sooner", ensemble.means(sooner))
            | ensemble.bounds("later", ensemble.means(later))
            | ensemble.bounds("over_bare", apart)
        )
    return pd.concat(tables), ranks


def sampled(settings: dict, swept: Swept, seed: int) -> Iterator[tuple]:
    """Yield cells just below the lowest intensity that overturns, and at it, for SciPy.

    Of a seeded sample of the motions, each on one of the structures.
    """
    random, asked = np.random.default_rng(seed), vase_and_frame(settings)
    chosen = random.permutation(len(swept.draws))[: settings["checked_by_second_route"]]
    for motion in sorted(chosen.tolist()):
        place = int(random.integers(len(asked.subjects)))
        record, block = swept.draws[motion].record(), asked.subjects[place].block
        fell = swept.outcomes[motion, place]
        at = max(1, int(np.argmax(fell)))
        for level in (at - 1, at):
            yield block, record, asked.levels[level] / swept.peaks[motion], bool(fell[level])


def main(settings: dict, ensemble: dict, swept: Swept) -> tuple:
    tables, ranks = [], []
    for family in ensemble["families"]:
        outcomes = swept.of_family(family).outcomes
        table, rank = curves(family, Ensemble(outcomes, None, **settings["bootstrap"]), settings)
        tables.append(table)
        ranks += rank
    ranking = pd.DataFrame(ranks)
    drawn = findings(ranking)
    lowers = "fixed_mass_lowers_the_capacity"
    drawn[lowers] = drawn[lowers].with_evidence(motions=len(swept.draws))
    agreed = by_scipy(sampled(settings, swept, ensemble["seed"]))
    checked = truth(
        agreed["differ"] == 0 and agreed["decided"] > 0,
        cells=agreed["decided"],
        differ=agreed["differ"],
    )
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
    settings, ensemble = job.params.settings, job.params.ensemble
    swept = read_answers(job.input.shards, VASE, ensemble, settings["motions"])
    return main(settings, ensemble, swept)


if __name__ == "__main__":
    run(snakemake, work)
