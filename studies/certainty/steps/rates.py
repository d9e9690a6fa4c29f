"""Mean annual rate of overturning, and probabilities at stated intensities, of all structures.

The hazard falls as PGV⁻ᵏ within stated ends. Each motion contributes by the ranges of PGV in which
it overturns; no curve is fitted. Intervals are those of motions drawn anew within each earthquake.
"""

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from studies.certainty.rated import (
    BARE,
    FIXED,
    FREE,
    Subject,
    fallen,
    grid,
    stated,
    subjects,
)
from topheavy import Column
from topheavy.fragility.curve import dispersions, fit, medians
from topheavy.fragility.hazard import lognormal_rate, rate_at_levels
from topheavy.fragility.resampling import NEGATIVE, in_words, interval, means_within
from topheavy.fragility.tables import exact_interval

BOTH = "both"
SHARE = 1.0  # of a sampling interval: what half of the step of the grid may change
CLOSE = 0.1  # of a rate: its largest distance from that of a lognormal curve


@dataclass(frozen=True, eq=False)
class Motions:
    """Motions of a family and of an earthquake, or of both, and which PGVs overturn what.

    `outcomes` has the shape (motions, structures, PGVs); `quakes` is the earthquake of each motion,
    and `pgv` its PGV before scaling.
    """

    labels: dict[str, str]
    outcomes: np.ndarray
    quakes: Sequence[Hashable]
    pgv: np.ndarray

    def means(self, values: np.ndarray, settings: dict) -> np.ndarray:
        """Return the mean over motions and those of resamples, shape (1 + resamples, ...)."""
        return means_within(
            values, self.quakes, settings["bootstrap"]["resamples"], settings["seed"]
        )


def ensembles(shards: pd.DataFrame, settings: dict, ensemble: dict) -> Iterator[Motions]:
    """Yield the motions of each family, of both earthquakes together and of each apart."""
    names = [f"M {one['magnitude']:g}" for one in ensemble["scenarios"]]
    wanted = settings["runs"][settings["run"]]["motions"] * len(names)
    for family in ensemble["families"]:
        fell, firsts = fallen(shards[shards.family == family], wanted, len(subjects(settings)))
        quakes, own = firsts.scenario.to_numpy(), firsts.pgv.to_numpy()
        apart = [(name, quakes == place) for place, name in enumerate(names)]
        for name, chosen in [(BOTH, quakes >= 0), *apart]:
            labels = {"family": family, "earthquake": name}
            yield Motions(labels, fell[chosen], quakes[chosen].tolist(), own[chosen])


def pairs(under: list[Subject]) -> list[tuple[int, int]]:
    """Return the places of each structure and of the bare column that it is compared with.

    A frame is compared with every column, also with a lower √r; all others with that as it is.
    """
    columns = [place for place, one in enumerate(under) if one.structure == BARE]
    return [
        (place, column)
        for place, one in enumerate(under)
        for column in (columns if one.structure == FREE else columns[:1])
    ]


def named(name: str, values: np.ndarray, settings: dict) -> dict:
    """Return a value and the ends of its interval, named for a table."""
    found = interval(values, settings["bootstrap"]["confidence"])
    return dict(zip((name, f"{name}_low", f"{name}_high"), found, strict=True))


def probabilities(motions: Motions, settings: dict) -> pd.DataFrame:
    """Return the probability at each stated intensity, and how much less it is than a column's."""
    under, column = subjects(settings), Column(**settings["column"])
    measures, levels, pgvs = zip(*stated(column, settings), strict=True)
    some, found = motions.outcomes[..., grid(settings).size :], []
    means, fell = motions.means(some, settings), some.sum(axis=0)
    low, high = exact_interval(fell, len(motions.outcomes), settings["bootstrap"]["confidence"])
    for place, beside in pairs(under):
        of = means[:, place]
        less = named("less", means[:, beside] - of, settings)
        words = map(in_words, less["less_low"], less["less_high"])
        found.append(
            motions.labels
            | under[place].labels
            | {"column": under[beside].lowered, "measure": measures, "level": levels, "pgv": pgvs}
            | {"motions": len(motions.outcomes), "overturned": fell[place]}
            | {"probability": of[0], "probability_low": low[place]}
            | {"probability_high": high[place]}
            | less
            | {"interval": list(words)}
        )
    return pd.concat(map(pd.DataFrame, found))


def rates(motions: Motions, settings: dict) -> list[dict]:
    """Return the rate of each structure, over that of a column, by exponent and highest PGV.

    Rates are in units of the rate at which PGV exceeds 1 m/s. `coarser` is the rate with every
    other PGV of the grid, and `over_coarser` that over the column's; `over_coarsest` is with every
    fourth. `change` is what the last halving of the step changes, with its interval.
    """
    under, pgvs, rows = subjects(settings), grid(settings), []
    fell = motions.outcomes[..., : pgvs.size]
    means = motions.means(fell, settings)
    terms = fit(pgvs, means[0], skewed=False)
    curves = medians(pgvs, terms), dispersions(terms)
    for exponent, highest in product(settings["exponents"], settings["ends"]):
        ends = pgvs[0], highest
        at = rate_at_levels(pgvs, exponent, ends)
        found, coarser, coarsest = (
            means[..., ::step] @ rate_at_levels(pgvs[::step], exponent, ends) for step in (1, 2, 4)
        )
        formula = lognormal_rate(*curves, exponent, ends)
        some = fell[..., at > 0.0].any(axis=-1).sum(axis=0)
        for place, column in pairs(under):
            over, rough, roughest = (
                rate[:, place] / rate[:, column] for rate in (found, coarser, coarsest)
            )
            rows.append(
                motions.labels
                | under[place].labels
                | {"column": under[column].lowered, "exponent": exponent, "highest": highest}
                | {"motions": len(fell), "overturning": int(some[place])}
                | named("rate", found[:, place], settings)
                | {"coarser": coarser[0, place], "lognormal": formula[place]}
                | named("over", over, settings)
                | {"over_coarser": rough[0], "over_coarsest": roughest[0]}
                | named("change", over - rough, settings)
            )
    return rows


def survival(table: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Return the probability of no overturning in some centuries, from the table of rates.

    Overturnings are those of a Poisson process: the structure is restored after each.
    """
    event, parts = settings["event"], []
    some = table[(table.column == 0.0) & table.structure.isin([BARE, FREE])]
    annual = event["pgv"] ** some.exponent / event["years"]  # times PGV > 1 m/s
    keys = ["family", "earthquake", "structure", "mass_ratio", "lowered", "exponent", "highest"]
    for centuries in settings["centuries"]:
        expected = {key: some[key] * annual * 100.0 * centuries for key in RATE}
        parts.append(
            some[keys].assign(
                centuries=centuries,
                survival=np.exp(-expected["rate"]),
                survival_low=np.exp(-expected["rate_high"]),
                survival_high=np.exp(-expected["rate_low"]),
            )
        )
    return pd.concat(parts)


RATE = ("rate", "rate_low", "rate_high")


def scales(motions: Motions, settings: dict) -> list[dict]:
    """Return the median and the 95th percentile of the factors that bring motions to a PGV."""
    return [
        motions.labels
        | {"pgv": pgv, "motions": len(motions.pgv)}
        | dict(zip(("median", "p95"), np.quantile(pgv / motions.pgv, (0.5, 0.95)), strict=True))
        for pgv in settings["pgv"]
    ]


def main(settings: dict, ensemble: dict, shards: pd.DataFrame) -> tuple:
    stated_ones, summed, scaled = [], [], []
    for motions in ensembles(shards, settings, ensemble):
        stated_ones.append(probabilities(motions, settings))
        summed += rates(motions, settings)
        scaled += scales(motions, settings)
    table, rate_table = pd.concat(stated_ones), pd.DataFrame(summed)
    return (
        table,
        rate_table,
        survival(rate_table, settings),
        pd.DataFrame(scaled),
        findings(table, rate_table),
    )


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
    curved = table[np.isfinite(table.lognormal) & (table.column == 0.0)]
    apart = (curved.lognormal / curved.rate - 1.0).abs()
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
        "lognormal_curve_agrees": truth(
            len(curved) > 0 and (apart < CLOSE).all(),
            limit=CLOSE,
            compared=len(curved),
            largest=float(apart.max()),
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
    shards = pd.concat(map(pd.read_csv, job.input.shards), ignore_index=True)
    return main(job.params.settings, job.params.ensemble, shards)


if __name__ == "__main__":
    run(snakemake, work)
