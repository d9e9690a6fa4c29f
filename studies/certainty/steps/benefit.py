"""What is left of the benefit of a free cap beam if √r is lower, of frame and column or of one.

Frame and column, with √r of Eq. (25) and with a factor on it, under all synthetic motions of study
reversals, each scaled to a stated peak ground velocity.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import by_scipy
from steps.shared.spectrum import progress
from steps.shared.sweep import Swept, read_answers
from studies.certainty.subjects import factored, named
from topheavy.risk.ensemble import Ensemble
from topheavy.risk.resampling import NEGATIVE, POSITIVE, in_words

BOTH, COLUMN_ALONE, FRAME_ALONE = "both", "column alone", "frame alone"


def names_of(settings: dict) -> list[str]:
    """Return the names of the structures, in the order of their outcomes."""
    return [subject.labels["structure"] for subject in factored(settings).subjects]


def compared(factors: list[float]) -> dict[tuple[str, float], tuple[str, str]]:
    """Return the column and the frame of each comparison, by the way and the factor.

    One of them alone is changed if the factor is lower than 1.
    """
    found = {(BOTH, f): (named("column", f), named("frame", f)) for f in factors}
    lowered = [factor for factor in factors if factor < 1.0]
    found |= {(COLUMN_ALONE, f): (named("column", f), "frame") for f in lowered}
    return found | {(FRAME_ALONE, f): ("column", named("frame", f)) for f in lowered}


def differences(settings: dict, of_family: dict[str, Ensemble]) -> pd.DataFrame:
    """Return for each family and change the probabilities of column and frame, compared.

    The first less the second, and the second over the first, with intervals of the same resamples.
    """
    names, rows = names_of(settings), []
    for family, ensemble in of_family.items():
        fell, shares = ensemble.outcomes[..., 0].T, ensemble.means()[..., 0].T
        for (way, factor), pair in compared(settings["factors"]).items():
            column, frame = map(names.index, pair)
            less = ensemble.bounds("less", shares[column] - shares[frame])
            rows.append(
                {"family": family, "way": way, "factor": factor, "motions": len(fell[0])}
                | {"column": fell[column].sum(), "frame": fell[frame].sum()}
                | {"only_column": (fell[column] & ~fell[frame]).sum()}
                | {"only_frame": (fell[frame] & ~fell[column]).sum()}
                | less
                | {"interval": in_words(less["less_low"], less["less_high"])}
                | ensemble.bounds("over", over(shares[frame], shares[column]))
            )
    return pd.DataFrame(rows)


def over(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the ratio of two shares in each resample, NaN where the second is zero."""
    return first / np.where(second > 0.0, second, np.nan)


def sampled(settings: dict, swept: Swept) -> Iterator[tuple]:
    """Yield a seeded sample of the motions that overturn one of frame and column, for SciPy.

    Of every change in turn.
    """
    random, names = np.random.default_rng(settings["seed"]), names_of(settings)
    blocks = [subject.block for subject in factored(settings).subjects]
    pairs, fell = list(compared(settings["factors"]).values()), swept.outcomes[..., 0]
    chosen = set()
    for number in range(settings["checked"]):
        column, frame = map(names.index, pairs[number % len(pairs)])
        at = int(random.choice(np.flatnonzero(fell[:, column] != fell[:, frame])))
        chosen |= {(at, column), (at, frame)}
    for at, place in progress(sorted(chosen), len(chosen), "checks"):
        factor = settings["pgv"] / swept.peaks[at]
        yield blocks[place], swept.draws[at].record(), factor, bool(fell[at, place])


def main(settings: dict, ensemble: dict, swept: Swept) -> tuple[pd.DataFrame, dict]:
    of_family = {
        family: Ensemble(
            swept.of_family(family).outcomes, None, seed=settings["seed"], **settings["bootstrap"]
        )
        for family in ensemble["families"]
    }
    table, agreed = differences(settings, of_family), by_scipy(sampled(settings, swept))
    confirmed = truth(agreed["differ"] == 0 and agreed["decided"] > 0, **agreed)
    return table, findings(table) | {"second_route": confirmed}


def findings(certainty_benefit: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the frame stays the safer one, from the table of differences."""
    table = certainty_benefit
    both, alone = (table[table.way == way] for way in (BOTH, COLUMN_ALONE))
    lowest = alone[alone.factor == alone.factor.min()]
    return {
        "frame_is_safer": truth(
            (both.interval == POSITIVE).all(), shrinks=shrinks(both), **said(both)
        ),
        "remains": truth((alone.interval == POSITIVE).all(), **said(alone)),
        "reverses": truth((lowest.interval == NEGATIVE).all(), **said(lowest)),
    }


def shrinks(both: pd.DataFrame) -> bool:
    """Return whether the difference of each family is smaller the lower the common factor is.

    The intervals for the lowest factor have to lie below those of Eq. (25).
    """
    of = both.set_index(["factor", "family"])
    lowest, unchanged = of.loc[both.factor.min()], of.loc[1.0]
    return bool((lowest.less_high < unchanged.less_low).all())


def said(rows: pd.DataFrame) -> dict:
    """Return the evidence: the compared rows, and how many there are."""
    return {"compared": len(rows), "changes": rows.to_dict("records")}


def work(job: Any) -> tuple:
    settings, ensemble = job.params.settings, job.params.ensemble
    swept = read_answers(job.input.shards, "benefit", ensemble, settings["motions"])
    return main(settings, ensemble, swept)


if __name__ == "__main__":
    run(snakemake, work)
