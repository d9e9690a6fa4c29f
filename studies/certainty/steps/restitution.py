"""How much depends on the impact law: √r of frame and column changed, together, apart, at random.

A factor never brings √r above HIGHEST. Pulses are judged by maps of overturning, synthetic motions
by the probability of overturning over the ensemble of study reversals.
"""

import math
from functools import partial
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.second import beside_a_boundary, decided
from steps.shared.spectra_compared import ends_of
from steps.shared.spectrum import progress
from studies.certainty.under import HIGHEST, changed
from topheavy import (
    STANDARD_GRAVITY,
    Column,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    judge,
    minimum_overturning,
    overturned_by,
    overturning_intervals,
    reference,
)
from topheavy.fragility.ensemble import Ensemble
from topheavy.fragility.resampling import in_words
from topheavy.synthetic.ensemble import Draw, first_draws

WAYS = ("both", "frame alone", "column alone")
OF_PULSES = ["way", "factor", "helps", "harms", "compared", "falls", "least"]
OF_MOTIONS = ["family", "way", "factor", "less", "less_low", "less_high", "interval"]
"""The columns of the table under pulses, and of the differences under motions."""

RISES = 1e-8  # of a minimum: the rounding of its bracket


def pairs(factors: list[float]) -> dict[tuple[str, float], tuple[float, float]]:
    """Return the factors on √r of the column and of the frame, by way and factor."""
    found = {("both", factor): (factor, factor) for factor in factors}
    found |= {("frame alone", factor): (1.0, factor) for factor in factors}
    return found | {("column alone", factor): (factor, 1.0) for factor in factors}


def spectrum(block: RockingBlock, pulse: Pulse, settings: dict) -> np.ndarray:
    """Return the intervals of amplitude (g tan α) that overturn, shape (n, 2)."""
    amplitudes = settings["amplitudes"]
    found = overturning_intervals(
        block,
        pulse,
        (amplitudes["lowest"], amplitudes["highest"]),
        resolution=amplitudes["resolution"],
        most_impacts=1,
    )
    return ends_of(found, amplitudes["highest"])


def lowest(block: RockingBlock, pulse: Pulse, settings: dict, below: float) -> float:
    """Return the minimum (g tan α) by the finer resolution, at most `below` or the highest."""
    ends = settings["amplitudes"]["lowest"], min(below, settings["amplitudes"]["highest"])
    found = minimum_overturning(block, pulse, ends, resolution=settings["amplitudes"]["finer"])
    return found[1] if found else below


def only_first(first: np.ndarray, second: np.ndarray, levels: np.ndarray) -> float:
    """Return the share of the levels within the intervals of the first and not of the second."""
    inside = [
        ((levels[:, None] >= s[:, 0]) & (levels[:, None] <= s[:, 1])).any(axis=1)
        for s in (first, second)
    ]
    return float((inside[0] & ~inside[1]).mean())


def under_pulses(settings: dict) -> pd.DataFrame:
    """Return, for each change of √r, the shares of the maps saved and lost, and the least rise."""
    amplitudes = settings["amplitudes"]
    levels = np.linspace(amplitudes["lowest"], amplitudes["highest"], settings["levels"])
    ratios = np.linspace(
        *(settings["frequency_ratios"][key] for key in ("lowest", "highest", "points"))
    )
    places = list(product(settings["slendernesses"], settings["shapes"], ratios))
    factors, rows = settings["factors"], []
    for degrees, shape, ratio in progress(places, len(places), "frequencies"):
        alpha = math.radians(degrees)
        column = Column(math.sin(alpha), math.cos(alpha))
        pulse = Pulse(shape, column.uplift_acceleration, ratio * column.frequency_parameter)
        light, heavy = (
            {factor: spectrum(changed(block, factor), pulse, settings) for factor in factors}
            for block in (column.block(), RockingFrame(column, math.inf).block())
        )
        for (way, factor), (of_column, of_frame) in pairs(factors).items():
            one, other = light[of_column], heavy[of_frame]
            minima = [found[0, 0] if len(found) else math.inf for found in (one, other)]
            if minima[1] < minima[0] * (1.0 - RISES):
                # a narrow interval of the column may have been missed below
                minima[0] = lowest(changed(column.block(), of_column), pulse, settings, minima[0])
            rows.append(
                {
                    "way": way,
                    "factor": factor,
                    "helps": only_first(one, other, levels),
                    "harms": only_first(other, one, levels),
                    "compared": min(minima) < math.inf,
                    "falls": minima[1] < minima[0] * (1.0 - RISES),
                    "least": minima[1] / minima[0] if minima[0] < math.inf else math.inf,
                }
            )
    grouped = pd.DataFrame(rows).groupby(["way", "factor"], sort=False, as_index=False)
    return grouped.agg(
        helps=("helps", "mean"),
        harms=("harms", "mean"),
        compared=("compared", "sum"),
        falls=("falls", "sum"),
        least=("least", "min"),
    )


def levels_of(settings: dict) -> np.ndarray:
    """Return the PGVs in m/s at which the motions are judged."""
    column, spec = Column(**settings["column"]), settings["intensities"]
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    return unit * np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def scattered(settings: dict, draw: Draw, restitution: float, low: float) -> np.ndarray:
    """Return √r of each impact of a motion at each level, shape (levels, impacts).

    The same draws for all structures: the impacts of a motion are equally bad for each.
    """
    seed = [settings["seed"], draw.place, draw.number]
    shape = settings["intensities"]["points"], settings["impacts"]
    lots = np.random.default_rng(seed).uniform(size=shape)
    factors = low + (settings["scatter_highest"] - low) * lots
    return np.minimum(HIGHEST, restitution * factors)


def overturns(frame: RockingFrame, motion: Record, factor: float, ratios: np.ndarray) -> bool:
    """Return whether a frame overturns that has these √r at its impacts."""
    return judge(frame, motion.scaled(factor), restitutions=ratios).overturned


def outcomes(settings: dict, ensemble: dict) -> tuple[list[tuple], dict[str, np.ndarray]]:
    """Return the variants, and for each family which of its motions overturn each, at each level.

    A variant is (γ, kind, number): kind "factor" with its factor, or "scatter" with its range.
    """
    column, levels = Column(**settings["column"]), levels_of(settings)
    variants = [(g, "factor", f) for g in settings["mass_ratios"] for f in settings["factors"]]
    variants += [
        (g, "scatter", low) for g in settings["mass_ratios"] for low in settings["scatter"]
    ]
    found: dict[str, list] = {family: [] for family in ensemble["families"]}
    chosen = first_draws(ensemble, settings["motions"])
    for draw in progress(chosen, len(chosen), "motions"):
        motion = draw.record()
        scales, fell = levels / motion.peak_velocity, []
        for gamma, kind, number in variants:
            frame = RockingFrame(column, gamma)
            if kind == "factor":
                fell.append(overturned_by(changed(frame.block(), number), motion, scales))
            else:
                rows = scattered(settings, draw, frame.restitution, number)
                fell.append(
                    [overturns(frame, motion, *one) for one in zip(scales, rows, strict=True)]
                )
        found[draw.family].append(fell)
    return variants, {family: np.array(rows) for family, rows in found.items()}


def under_motions(settings: dict, ensemble: dict) -> tuple[pd.DataFrame, list[dict]]:
    """Return the mean probability of overturning of each variant, and its fall with γ."""
    variants, found = outcomes(settings, ensemble)
    rows, falls = [], []
    for family, fell in found.items():
        motions = Ensemble(fell, None, seed=settings["seed"], **settings["bootstrap"])
        shares = motions.means(fell.mean(axis=2))
        place = {variant: number for number, variant in enumerate(variants)}
        for variant, number in place.items():
            gamma, kind, factor = variant
            labels = {"family": family, "mass_ratio": gamma, "kind": kind, "factor": factor}
            rows.append(labels | motions.bounds("probability", shares[:, number]))
        light, heavy = settings["mass_ratios"][0], settings["mass_ratios"][-1]
        for (way, factor), (of_column, of_frame) in pairs(settings["factors"]).items():
            less = (
                shares[:, place[light, "factor", of_column]]
                - shares[:, place[heavy, "factor", of_frame]]
            )
            labels = {"family": family, "way": way, "factor": factor}
            falls.append(labels | difference(motions, less))
        for low in settings["scatter"]:
            less = shares[:, place[light, "scatter", low]] - shares[:, place[heavy, "scatter", low]]
            labels = {"family": family, "way": "scatter", "factor": low}
            falls.append(labels | difference(motions, less))
    return pd.DataFrame(rows), falls


def is_against_the_frame(table: pd.DataFrame) -> pd.Series:
    """Return which changes lower the √r of the column and not that of the frame."""
    return (table.way == "column alone") & (table.factor < 1.0)


def difference(ensemble: Ensemble, less: np.ndarray) -> dict:
    """Return by how much a probability is lower, with its interval in numbers and in words."""
    ends = ensemble.bounds("less", less)
    return ends | {"interval": in_words(ends["less_low"], ends["less_high"])}


def scatter_agrees(settings: dict, ensemble: dict) -> Finding:
    """Return whether SciPy gives the same outcomes, of a seeded sample of those with scattered √r.

    Every second one is brought beside a boundary. Those that are not `decided` are not compared.
    """
    column, random = Column(**settings["column"]), np.random.default_rng(settings["seed"])
    chosen, levels = first_draws(ensemble, settings["motions"]), levels_of(settings)
    differ, told, overturned, count = 0, 0, 0, settings["scatter_checked"]
    for number in progress(range(count), count, "checks"):
        draw = chosen[random.integers(len(chosen))]
        frame = RockingFrame(column, float(random.choice(settings["mass_ratios"])))
        low, level = float(random.choice(settings["scatter"])), random.integers(levels.size)
        motion = draw.record()
        ratios = scattered(settings, draw, frame.restitution, low)[level]
        factor = levels[level] / motion.peak_velocity
        falls = partial(overturns, frame, motion, ratios=ratios)
        if number % 2:
            factor = beside_a_boundary(falls, factor)
        fell = decided(falls, factor)
        if fell is not None:
            other = reference.judge(frame, motion.scaled(factor), restitutions=ratios)
            told, overturned = told + 1, overturned + other.overturned
            differ += other.overturned != fell
    return truth(
        differ == 0 and 0 < overturned < told,
        compared=told,
        of=count,
        near_a_boundary=count // 2,
        differ=differ,
        overturned=overturned,
    )


def main(settings: dict, ensemble: dict) -> tuple[pd.DataFrame, dict]:
    pulses = under_pulses(settings)
    table, falls = under_motions(settings, ensemble)
    less = pd.DataFrame(falls)
    whole = pd.concat(
        [
            table.assign(under="motions"),
            pulses.assign(under="pulses"),
            less.assign(under="difference"),
        ]
    )
    drawn, error = findings(whole), 1.0 / settings["levels"]
    ranges = {name: drawn.pop(name) for name in ("harms_range", "helps_range")}
    return whole, {
        **drawn,
        **{
            name: value(found["value"], error, lowest=found["lowest"])
            for name, found in ranges.items()
        },
        "scatter_agrees": scatter_agrees(settings, ensemble),
    }


def findings(certainty_restitution: pd.DataFrame) -> dict[str, Any]:
    """Return what is left of the benefit with other √r, from the table under pulses and motions.

    The errors of the ranges are those of the levels, which are in the config.
    """
    rows = certainty_restitution.groupby("under")
    pulses = rows.get_group("pulses")[OF_PULSES].astype({"compared": int, "falls": int})
    less = rows.get_group("difference")[OF_MOTIONS]
    joint, apart = less[less.way.isin(["both", "scatter"])], less[less.way.isin(WAYS[1:])]
    together = pulses[pulses.way == "both"]
    kept, fewer = (of[~is_against_the_frame(of)] for of in (pulses, apart))
    shown = {
        f"{name}_{row.factor:g}": getattr(row, name)
        for row in together.itertuples()
        for name in ("helps", "harms")
    }
    return {
        "lowest_rises_together": truth(
            together.compared.all() and not together.falls.any(),
            compared=int(together.compared.sum()),
            **shown,
        ),
        "lowest_rises_apart": truth(
            pulses.compared.all() and not pulses.falls.any(),
            holds_when=bool(kept.compared.all()) and not kept.falls.any(),
            condition="the column's √r is not lowered alone",
            changes=pulses.to_dict("records"),
        ),
        "probability_falls_together": truth(
            (joint.less_low > 0.0).all(),
            compared=len(joint),
            least=float(joint.less_low.min()),
            changes=joint.to_dict("records"),
        ),
        "probability_falls_apart": truth(
            (apart.less_low > 0.0).all(),
            holds_when=(fewer.less_low > 0.0).all(),
            condition="the column's √r is not lowered alone",
            compared=len(apart),
            least=float(apart.less_low.min()),
            changes=apart.to_dict("records"),
        ),
        "harms_range": {"value": together.harms.max(), "lowest": together.harms.min()},
        "helps_range": {"value": together.helps.max(), "lowest": together.helps.min()},
    }


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
