"""Mean annual rate of overturning, and probabilities at stated intensities, of all structures.

The hazard falls as PGV⁻ᵏ within stated ends. Each motion contributes by the ranges of PGV in which
it overturns; no curve is fitted. Intervals are those of motions drawn anew within each earthquake.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.sweep import Subject, Swept, read_answers
from studies.certainty.subjects import BARE, FIXED, FREE, grid, rated, stated
from topheavy import Column
from topheavy.risk.ensemble import Ensemble
from topheavy.risk.hazard import rate_at_levels
from topheavy.risk.resampling import NEGATIVE, in_words
from topheavy.risk.tables import exact_interval

BOTH = "both"
SHARE = 1.0  # of a sampling interval: what half of the step of the grid may change


def ensembles(
    swept: Swept, settings: dict, ensemble: dict
) -> Iterator[tuple[dict[str, str], Swept, Ensemble]]:
    """Yield labels, motions and outcomes of each family: of both earthquakes, and of each apart."""
    names = [f"M {one['magnitude']:g}" for one in ensemble["scenarios"]]
    for family in ensemble["families"]:
        of = swept.of_family(family)
        apart = [(name, of.scenarios == place) for place, name in enumerate(names)]
        for name, some in [(BOTH, of.scenarios >= 0), *apart]:
            these = of.chosen(some)
            found = Ensemble(
                these.outcomes,
                these.scenarios.tolist(),
                seed=settings["seed"],
                **settings["bootstrap"],
            )
            yield {"family": family, "earthquake": name}, these, found


def pairs(under: Sequence[Subject]) -> list[tuple[int, int]]:
    """Return the places of each structure and of the bare column that it is compared with.

    A frame is compared with every column, also with a lower √r; all others with that as it is.
    """
    kinds = [one.labels["structure"] for one in under]
    columns = [place for place, kind in enumerate(kinds) if kind == BARE]
    return [
        (place, column)
        for place, kind in enumerate(kinds)
        for column in (columns if kind == FREE else columns[:1])
    ]


def probabilities(labels: dict, ensemble: Ensemble, settings: dict) -> pd.DataFrame:
    """Return the probability at each stated intensity, and how much less it is than a column's."""
    under, column = rated(settings).subjects, Column(**settings["column"])
    measures, levels, pgvs = zip(*stated(column, settings), strict=True)
    some, found = ensemble.outcomes[..., grid(settings).size :], []
    means, fell, motions = ensemble.means(some), some.sum(axis=0), len(some)
    low, high = exact_interval(fell, motions, ensemble.confidence)
    for place, beside in pairs(under):
        of = means[:, place]
        less = ensemble.bounds("less", means[:, beside] - of)
        words = map(in_words, less["less_low"], less["less_high"])
        found.append(
            labels
            | under[place].labels
            | {"column": under[beside].labels["lowered"]}
            | {"measure": measures, "level": levels, "pgv": pgvs}
            | {"motions": motions, "overturned": fell[place]}
            | {"probability": of[0], "probability_low": low[place]}
            | {"probability_high": high[place]}
            | less
            | {"interval": list(words)}
        )
    return pd.concat(map(pd.DataFrame, found))


def rates(labels: dict, ensemble: Ensemble, settings: dict) -> list[dict]:
    """Return the rate of each structure, over that of a column, by exponent and highest PGV.

    Rates are in units of the rate at which PGV exceeds 1 m/s. `coarser` is the rate with every
    other PGV of the grid, and `over_coarser` that over the column's; `over_coarsest` is with every
    fourth. `change` is what the last halving of the step changes, with its interval.
    """
    under, pgvs, rows = rated(settings).subjects, grid(settings), []
    fell = ensemble.outcomes[..., : pgvs.size]
    means = ensemble.means(fell)
    for exponent, highest in product(settings["exponents"], settings["ends"]):
        ends = pgvs[0], highest
        at = rate_at_levels(pgvs, exponent, ends)
        found, coarser, coarsest = (
            means[..., ::step] @ rate_at_levels(pgvs[::step], exponent, ends) for step in (1, 2, 4)
        )
        some = fell[..., at > 0.0].any(axis=-1).sum(axis=0)
        for place, column in pairs(under):
            over, rough, roughest = (
                rate[:, place] / rate[:, column] for rate in (found, coarser, coarsest)
            )
            rows.append(
                labels
                | under[place].labels
                | {"column": under[column].labels["lowered"]}
                | {"exponent": exponent, "highest": highest}
                | {"motions": len(fell), "overturning": int(some[place])}
                | ensemble.bounds("rate", found[:, place])
                | {"coarser": coarser[0, place]}
                | ensemble.bounds("over", over)
                | {"over_coarser": rough[0], "over_coarsest": roughest[0]}
                | ensemble.bounds("change", over - rough)
            )
    return rows


def scales(labels: dict, peaks: np.ndarray, settings: dict) -> list[dict]:
    """Return the median and the 95th percentile of the factors that bring motions to a PGV."""
    return [
        labels
        | {"pgv": pgv, "motions": len(peaks)}
        | dict(zip(("median", "p95"), np.quantile(pgv / peaks, (0.5, 0.95)), strict=True))
        for pgv in settings["pgv"]
    ]


def main(settings: dict, ensemble: dict, swept: Swept) -> tuple:
    stated_ones, summed, scaled = [], [], []
    for labels, motions, outcomes in ensembles(swept, settings, ensemble):
        stated_ones.append(probabilities(labels, outcomes, settings))
        summed += rates(labels, outcomes, settings)
        scaled += scales(labels, motions.peaks, settings)
    table, rate_table = pd.concat(stated_ones), pd.DataFrame(summed)
    return table, rate_table, pd.DataFrame(scaled), findings(table, rate_table)


def findings(certainty_motions: pd.DataFrame, certainty_rates: pd.DataFrame) -> dict[str, Finding]:
    """Return what the tables say of every family and earthquake, exponent and highest PGV."""
    stated_ones, table = certainty_motions, certainty_rates
    of = {name: table[table.structure == name] for name in (FREE, FIXED)}
    free, fixed = (rows[rows.column == 0.0] for rows in of.values())
    lowered = of[FREE][of[FREE].column > 0.0]
    probable = stated_ones[(stated_ones.structure == FREE) & (stated_ones.column == 0.0)]
    some = table[table.over_high > table.over_low]
    width = some.over_high - some.over_low
    error = (some.over_coarser - some.over).abs() / width
    before = (some.over_coarsest - some.over_coarser).abs() / width
    return {
        "cap_lowers_the_rate": truth((free.over_high < 1.0).all(), **ranged(free)),
        "fixed_mass_raises_the_rate": truth((fixed.over_low > 1.0).all(), **ranged(fixed)),
        "lower_column_keeps_the_order": truth(
            (lowered.over_high < 1.0).all(),
            by_share={
                f"{share:g}": ranged(rows)
                | {
                    "below": int((rows.over_high < 1.0).sum()),
                    "above": int((rows.over_low > 1.0).sum()),
                }
                for share, rows in lowered.groupby("column")
            },
        ),
        "cap_never_raises_the_probability": truth(
            len(probable) > 0 and (probable.interval != NEGATIVE).all(),
            compared=len(probable),
            lower=int((probable.less_low > 0.0).sum()),
        ),
        "sum_is_fine_enough": truth(
            len(error) > 0 and (error < SHARE).all(),
            limit=SHARE,
            compared=len(error),
            largest=float(error.max()),
            median=float(error.median()),
            median_before=float(before.median()),
            scatter=float(((some.change_low <= 0.0) & (some.change_high >= 0.0)).mean()),
        ),
    }


def ranged(rows: pd.DataFrame) -> dict[str, Any]:
    """Return the evidence: how many rates over the column's there are, and their range."""
    return {
        "compared": len(rows),
        "least": float(rows.over.min()),
        "most": float(rows.over.max()),
        "lowest_end": float(rows.over_low.min()),
        "highest_end": float(rows.over_high.max()),
    }


def work(job: Any) -> tuple:
    settings, ensemble = job.params.settings, job.params.ensemble
    swept = read_answers(job.input.shards, "rates", ensemble, settings["motions"])
    return main(settings, ensemble, swept)


if __name__ == "__main__":
    run(snakemake, work)
