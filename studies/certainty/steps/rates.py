"""Mean annual rate of overturning, and probabilities at stated intensities, of all structures.

The hazard falls as PGV⁻ᵏ within stated ends. Each motion contributes by the ranges of PGV in which
it overturns; no curve is fitted. Intervals are those of motions drawn anew within each earthquake.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.spectrum import progress
from studies.certainty.rated import (
    BARE,
    FIXED,
    FREE,
    PORTAL,
    Subject,
    grid,
    read,
    stated,
    subjects,
    velocities,
)
from topheavy import RockingBlock, judge, overturned_by, reference
from topheavy.fragility.curve import dispersions, fit, medians
from topheavy.fragility.hazard import lognormal_rate, rate_at_levels
from topheavy.fragility.resampling import NEGATIVE, in_words, interval, means_within
from topheavy.fragility.tables import exact_interval
from topheavy.synthetic.ensemble import first_draws

BOTH = "both"
NUDGE = 1e-9  # of a motion: an outcome that this changes is undecided
HALVINGS = 7  # of a step of the grid, in ln PGV: a boundary is then known to 0.1 %
SHARE = 1.0  # of a sampling interval: what half of the step of the grid may change
CLOSE = 0.1  # of a rate: its largest distance from that of a lognormal curve


@dataclass(frozen=True, eq=False)
class Motions:
    """Motions of a family and of an earthquake, or of both, and which PGVs overturn what.

    `outcomes` has the shape (motions, structures, PGVs); `means` those of the motions and of their
    resamples, (1 + resamples, structures, PGVs); `pgv` is that of each motion before scaling.
    """

    labels: dict[str, str]
    outcomes: np.ndarray
    means: np.ndarray
    pgv: np.ndarray


def ensembles(shards: pd.DataFrame, case: dict, ensemble: dict) -> Iterator[Motions]:
    """Yield the motions of each family, of both earthquakes together and of each apart."""
    under, pgvs, boot = subjects(case), velocities(case), case["bootstrap"]
    names = [f"M {one['magnitude']:g}" for one in ensemble["scenarios"]]
    wanted = case["runs"][case["run"]]["motions"] * len(names)
    for family in ensemble["families"]:
        of_family = shards[shards.family == family]
        rows = of_family.sort_values(["scenario", "motion"], kind="stable")
        if len(rows) != wanted * len(under):
            raise ValueError(
                f"{family}: {len(rows)} rows of outcomes; expected {wanted} motions of "
                f"{len(under)} structures: a shard is incomplete, delete it and run again"
            )
        fell = read(rows.outcomes).reshape(wanted, len(under), pgvs.size)
        firsts = rows.iloc[:: len(under)]
        quakes, own = firsts.scenario.to_numpy(), firsts.pgv.to_numpy()
        apart = [(name, quakes == place) for place, name in enumerate(names)]
        for name, chosen in [(BOTH, quakes >= 0), *apart]:
            some, groups = fell[chosen], quakes[chosen].tolist()
            means = means_within(some, groups, boot["resamples"], case["seed"])
            yield Motions({"family": family, "earthquake": name}, some, means, own[chosen])


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


def named(name: str, values: np.ndarray, case: dict) -> dict:
    """Return a value and the ends of its interval, named for a table."""
    found = interval(values, case["bootstrap"]["confidence"])
    return dict(zip((name, f"{name}_low", f"{name}_high"), found, strict=True))


def probabilities(motions: Motions, case: dict) -> pd.DataFrame:
    """Return the probability at each stated intensity, and how much less it is than a column's."""
    under, (measures, levels, pgvs) = subjects(case), zip(*stated(case), strict=True)
    first, parts = grid(case).size, []
    fell = motions.outcomes[..., first:].sum(axis=0)
    low, high = exact_interval(fell, len(motions.outcomes), case["bootstrap"]["confidence"])
    for place, column in pairs(under):
        of, beside = motions.means[:, place, first:], motions.means[:, column, first:]
        less = named("less", beside - of, case)
        words = map(in_words, less["less_low"], less["less_high"])
        parts.append(
            motions.labels
            | under[place].labels
            | {"column": under[column].lowered, "measure": measures, "level": levels, "pgv": pgvs}
            | {"motions": len(motions.outcomes), "overturned": fell[place]}
            | {"probability": of[0], "probability_low": low[place]}
            | {"probability_high": high[place]}
            | less
            | {"interval": list(words)}
        )
    return pd.concat(map(pd.DataFrame, parts))


def rates(motions: Motions, case: dict) -> list[dict]:
    """Return the rate of each structure, over that of a column, by exponent and highest PGV.

    Rates are in units of the rate at which PGV exceeds 1 m/s. `coarser` is the rate with every
    other PGV of the grid, and `over_coarser` that over the column's.
    """
    under, pgvs, rows = subjects(case), grid(case), []
    means, fell = (one[..., : pgvs.size] for one in (motions.means, motions.outcomes))
    terms = fit(pgvs, means[0], skewed=False)
    curves = medians(pgvs, terms), dispersions(terms)
    for exponent, highest in product(case["exponents"], case["ends"]):
        ends = pgvs[0], highest
        at = rate_at_levels(pgvs, exponent, ends)
        found = means @ at
        coarser = means[0, :, ::2] @ rate_at_levels(pgvs[::2], exponent, ends)
        formula = lognormal_rate(*curves, exponent, ends)
        some = fell[..., at > 0.0].any(axis=-1).sum(axis=0)
        for place, column in pairs(under):
            rows.append(
                motions.labels
                | under[place].labels
                | {"column": under[column].lowered, "exponent": exponent, "highest": highest}
                | {"motions": len(fell), "overturning": int(some[place])}
                | named("rate", found[:, place], case)
                | {"coarser": coarser[place], "lognormal": formula[place]}
                | named("over", found[:, place] / found[:, column], case)
                | {"over_coarser": coarser[place] / coarser[column]}
            )
    return rows


def survival(table: pd.DataFrame, case: dict) -> pd.DataFrame:
    """Return the probability of no overturning in some centuries, from the table of rates.

    Overturnings are those of a Poisson process: the structure is restored after each.
    """
    event, parts = case["event"], []
    some = table[(table.column == 0.0) & table.structure.isin([BARE, FREE])]
    annual = event["pgv"] ** some.exponent / event["years"]  # times PGV > 1 m/s
    keys = ["family", "earthquake", "structure", "mass_ratio", "lowered", "exponent", "highest"]
    for centuries in case["centuries"]:
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


def scales(motions: Motions, case: dict) -> list[dict]:
    """Return the median and the 95th percentile of the factors that bring motions to a PGV."""
    return [
        motions.labels
        | {"pgv": pgv, "motions": len(motions.pgv)}
        | dict(zip(("median", "p95"), np.quantile(pgv / motions.pgv, (0.5, 0.95)), strict=True))
        for pgv in case["pgv"]
    ]


def again(shards: pd.DataFrame, case: dict, ensemble: dict, tightened: float) -> dict[str, Finding]:
    """Judge a seeded sample of cells at a tighter tolerance, and some of them by SciPy.

    Every other cell is within 0.1 % of a boundary. Undecided outcomes are not compared.
    """
    random, spec, pgvs = np.random.default_rng(case["seed"]), case["sample"], velocities(case)
    motions = {
        tuple(draw.labels.values()): draw
        for draw in first_draws(ensemble, case["runs"][case["run"]]["motions"])
    }
    under = {tuple(subject.labels.values()): subject.block for subject in subjects(case)}
    fell, size, rows = read(shards.outcomes), grid(case).size, []
    changing = np.flatnonzero(np.diff(fell[:, :size]).any(axis=1))
    for number in progress(range(spec["points"]), spec["points"], "cells"):
        near = number % 2 == 1
        at = int(random.choice(changing) if near else random.integers(len(shards)))
        row = shards.iloc[at]
        block = under[row.structure, row.mass_ratio, row.lowered]
        record = motions[row.family, row.scenario, row.motion].record()
        if near:
            place = random.choice(np.flatnonzero(np.diff(fell[at, :size])))
            ends = beside(block, record, pgvs[place : place + 2] / row.pgv, fell[at, place])
            side = int(random.integers(2))
            factor, overturns = ends[side], fell[at, place + side]
        else:
            place = random.integers(pgvs.size)
            factor, overturns = pgvs[place] / row.pgv, fell[at, place]
        scaled = record.scaled(factor)
        others = [judge(block, scaled.scaled(1.0 + n)).overturned for n in (-NUDGE, 0.0, NUDGE)]
        if set(others) != {others[1]}:
            continue
        tight = overturned_by(block, record, [factor], tolerance=tightened)[0]
        rows.append({"near": near, "tightened": tight == overturns})
        if number < spec["second_route"]:
            rows[-1]["second_route"] = reference.judge(block, scaled).overturned == overturns
    told = pd.DataFrame(rows)
    found = {}
    for name in ("tightened", "second_route"):
        agrees = told[name].dropna().astype(bool)
        found[f"{name}_agrees"] = truth(
            len(agrees) > 0 and agrees.all(),
            cells=len(agrees),
            differ=int((~agrees).sum()),
            near_a_boundary=int(told.near[agrees.index].sum()),
            undecided=spec["points"] - len(told),
        )
    return found


def beside(block: RockingBlock, record: Any, factors: Any, below: bool) -> tuple[float, float]:
    """Return two factors just below and just above a change of the outcome between two others."""
    low, high = map(float, factors)
    for _ in range(HALVINGS):
        middle = (low * high) ** 0.5
        if overturned_by(block, record, [middle])[0] == below:
            low = middle
        else:
            high = middle
    return low, high


def main(case: dict, ensemble: dict, paths: list[str], tightened: float) -> tuple:
    shards = pd.concat(map(pd.read_csv, paths), ignore_index=True)
    stated_ones, summed, scaled = [], [], []
    for motions in ensembles(shards, case, ensemble):
        stated_ones.append(probabilities(motions, case))
        summed += rates(motions, case)
        scaled += scales(motions, case)
    table, rate_table = pd.concat(stated_ones), pd.DataFrame(summed)
    drawn = findings(table, rate_table)
    checked = again(shards, case, ensemble, tightened)
    return (
        table,
        rate_table,
        survival(rate_table, case),
        pd.DataFrame(scaled),
        drawn | checked,
    )


def findings(certainty_motions: pd.DataFrame, certainty_rates: pd.DataFrame) -> dict[str, Finding]:
    """Return what the tables say of every family and earthquake, exponent and highest PGV."""
    stated_ones, table = certainty_motions, certainty_rates
    of = {name: table[table.structure == name] for name in (FREE, FIXED, PORTAL)}
    as_it_is = {name: rows[rows.column == 0.0] for name, rows in of.items()}
    free, fixed, portal = (as_it_is[name] for name in (FREE, FIXED, PORTAL))
    lowered = of[FREE][of[FREE].column > 0.0]
    probable = stated_ones[(stated_ones.structure == FREE) & (stated_ones.column == 0.0)]
    error = (table.over_coarser - table.over).abs() / (table.over_high - table.over_low)
    curved = table[np.isfinite(table.lognormal) & (table.column == 0.0)]
    apart = (curved.lognormal / curved.rate - 1.0).abs()
    return {
        "cap_lowers_the_rate": truth((free.over_high < 1.0).all(), **ranged(free)),
        "fixed_mass_raises_the_rate": truth((fixed.over_low > 1.0).all(), **ranged(fixed)),
        "portal_has_the_lowest_rate": truth(
            len(portal) > 0 and portal.rate_high.max() < free.rate_low.min(),
            overturning=int(portal.overturning.max()),
            **ranged(portal),
        ),
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
            (error.dropna() < SHARE).all() and error.notna().any(),
            limit=SHARE,
            largest=float(error.max()),
            median=float(error.median()),
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
    case, solver = job.params.case, job.params.solver
    return main(case, job.params.ensemble, job.input.shards, solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
