"""Fragility under synthetic motions: benefit of a heavier cap beam, and counts of reversals.

Intervals are those of motions drawn anew from the ensemble; frames stay paired under each motion.
Families of motions are kept apart.
"""

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.sweep import Subject, Swept, read_answers
from studies.reversals.subjects import frames_and_columns, intensities, unit
from topheavy import Column
from topheavy.bodies.structures import size_ratio
from topheavy.risk.curve import curve, fit, medians, why_no_median
from topheavy.risk.ensemble import Ensemble
from topheavy.risk.gain import mass_ratios_of_gain

TINY = 1e-12  # a share: where no cell differs, none is reversed


@dataclass(frozen=True, eq=False)
class Case:
    """One family of motions on the frames and columns of one structure."""

    family: str
    subjects: Sequence[Subject]
    unit: float  # PGV in m/s at a level of 1
    levels: np.ndarray
    ensemble: Ensemble

    @property
    def labels(self) -> dict:
        return {"family": self.family, "structure": self.subjects[0].labels["structure"]}

    @property
    def motions(self) -> int:
        return len(self.ensemble.outcomes)

    @property
    def frames(self) -> dict[float, int]:
        """The places of the frames, by γ."""
        each = enumerate(one.labels for one in self.subjects)
        return {of["mass_ratio"]: place for place, of in each if not of["as_large_as"]}

    @property
    def columns(self) -> dict[float, int]:
        """The places of the solitary columns, by the γ of the frame that is as large."""
        each = enumerate(one.labels for one in self.subjects)
        return {of["as_large_as"]: place for place, of in each if of["as_large_as"]}


def cases(settings: dict, structures: dict, answered: Mapping[str, Swept]) -> Iterator[Case]:
    """Yield the outcomes by family and structure, in the order of the tables."""
    asked, levels = frames_and_columns(settings, structures), intensities(settings)
    for family in settings["families"]:
        for name, one in asked.items():
            outcomes = answered[name].of_family(family).outcomes
            found = Ensemble(outcomes, None, seed=settings["seed"], **settings["bootstrap"])
            yield Case(family, one.subjects, unit(Column(**structures[name])), levels, found)


def curves(case: Case, means: np.ndarray) -> pd.DataFrame:
    """Return fragility over intensity, and by how much it is below that of the lightest frame."""
    fits = curve(case.levels, fit(case.levels, means[0], skewed=True))
    tables = []
    for place, subject in enumerate(case.subjects):
        tables.append(
            case.labels
            | subject.labels
            | {"intensity": case.levels, "pgv": case.levels * case.unit}
            | case.ensemble.bounds("probability", means[:, place])
            | {"fitted": fits[place]}
            | case.ensemble.bounds("less", means[:, 0] - means[:, place])
        )
    return pd.concat(map(pd.DataFrame, tables))


def middles(levels: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Return the median capacities, shape (...), of shares that overturn, shape (..., n).

    A study publishes every value that it computes, so that a median which is NaN is an error.
    """
    terms = fit(levels, shares, skewed=True)
    found = medians(levels, terms)
    for place in np.argwhere(np.isnan(found))[:1]:
        one = tuple(place)
        reason = why_no_median(levels, shares[one], terms[one], skewed=True)
        raise ValueError(f"a fragility curve has no median; expected one for each: {reason}")
    return found


def capacities(case: Case, middle: np.ndarray) -> pd.DataFrame:
    """Return the median capacity of each, and by how much it is above that of the lightest."""
    rows = []
    for place, subject in enumerate(case.subjects):
        gamma = subject.labels["as_large_as"] or subject.labels["mass_ratio"]
        gain = middle[:, place] / middle[:, 0] - 1.0
        rows.append(
            case.labels
            | subject.labels
            | {"motions": case.motions, "size_gain": size_ratio(gamma) - 1.0}
            | {"expected_gain": math.sqrt(size_ratio(gamma)) - 1.0}
            | case.ensemble.bounds("median", middle[:, place])
            | {"median_pgv": middle[0, place] * case.unit}
            | case.ensemble.bounds("gain", gain)
        )
    return pd.DataFrame(rows)


def differing(case: Case, outcomes: np.ndarray) -> list[np.ndarray]:
    """Return for each pair of frames the cells in which only the lighter, only the heavier falls.

    The outcomes have the shape (motions, subjects, levels).
    """
    found = []
    for i, j in itertools.combinations(case.frames.values(), 2):
        one, other = outcomes[:, i], outcomes[:, j]
        found += [one & ~other, other & ~one]
    return found


def over_levels(shares: np.ndarray) -> np.ndarray:
    """Return the mean of shares of shape (..., levels) over the logarithm of the intensity.

    By the trapezoidal rule, so that more levels in the same range give nearly the same mean.
    """
    weights = np.ones(shares.shape[-1])
    weights[[0, -1]] = 0.5
    return shares @ (weights / weights.sum())


def pairs(case: Case, means: list[np.ndarray]) -> pd.DataFrame:
    """Return for each pair of frames the shares of cells, motions at levels, that differ.

    `means` are those of `differing`; the shares are means over the levels. `reversed` is the share
    of these in which the heavier falls.
    """
    rows = []
    cells = case.motions * case.levels.size
    of_pairs = itertools.combinations(case.frames, 2)
    both = zip(means[::2], means[1::2], strict=True)
    for (light, heavy), shares in zip(of_pairs, both, strict=True):
        bought, lost = map(over_levels, shares)
        rows.append(
            case.labels
            | {"lighter": light, "heavier": heavy, "cells": cells}
            | case.ensemble.bounds("only_lighter", bought)
            | case.ensemble.bounds("only_heavier", lost)
            | case.ensemble.bounds("reversed", lost / (bought + lost + TINY))
        )
    return pd.DataFrame(rows)


def falls(case: Case, means: np.ndarray) -> pd.DataFrame:
    """Return by how much each frame's fragility is below that of every lighter one.

    Small rises from frame to frame could add up; comparing neighbours would not show it.
    """
    light, heavy = np.transpose([*itertools.combinations(case.frames.values(), 2)])
    less = means[:, light] - means[:, heavy]
    return pd.DataFrame(
        {key: np.ravel(found) for key, found in case.ensemble.bounds("less", less).items()}
    )


def beyond_size(case: Case, middle: np.ndarray) -> list[dict]:
    """Return by how much medians of frames exceed those of solitary columns as large."""
    bounds = case.ensemble.bounds
    return [
        case.labels
        | {"mass_ratio": gamma}
        | plain(bounds("excess", middle[:, case.frames[gamma]] / middle[:, place] - 1.0))
        for gamma, place in case.columns.items()
    ]


def shares_of_gain(case: Case, middle: np.ndarray, shares: list[float]) -> list[dict]:
    """Return the γ that bring shares of the gain, where frames go up to γ = ∞."""
    frames = case.frames
    if math.inf not in frames:
        return []
    found = mass_ratios_of_gain(list(frames), middle[:, list(frames.values())], shares)
    return [
        case.labels | {"share": share} | plain(case.ensemble.bounds("mass_ratio", values))
        for share, values in zip(shares, found.T, strict=True)
    ]


def never_rises(less: pd.DataFrame, margin: float) -> Finding:
    """Does every interval of the falls in probability exclude a rise by the margin?

    That a rise is not seen is not enough: an interval that is too wide does not exclude it.
    `words` is the predicate of "the intervals" in a text.
    """
    excluded = bool((less.less_low > -margin).all())
    return truth(
        excluded,
        margin=margin,
        words="exclude" if excluded else "do not exclude",
        compared=len(less),
        largest_rise_not_excluded=-float(less.less_low.min()),
        rises=int((less.less_high < 0.0).sum()),
        falls=int((less.less_low > 0.0).sum()),
    )


def plain(bounds: dict) -> dict:
    return {key: float(number) for key, number in bounds.items()}


def main(
    settings: dict, structures: dict, answered: Mapping[str, Swept]
) -> tuple[dict[str, pd.DataFrame], dict]:
    tables, order, beyond, shares = {"fragility": [], "medians": [], "pairs": []}, [], [], []
    for case in cases(settings, structures, answered):
        means = case.ensemble.means()
        of_pairs = case.ensemble.means_of(differing(case, case.ensemble.outcomes))
        middle = middles(case.levels, means)
        tables["fragility"].append(curves(case, means))
        tables["medians"].append(capacities(case, middle))
        tables["pairs"].append(pairs(case, of_pairs))
        order.append(falls(case, means))
        beyond += beyond_size(case, middle)
        shares += shares_of_gain(case, middle, settings["shares_of_gain"])
        print(case.labels, case.motions, "motions", flush=True)
    tables = {name: pd.concat(parts) for name, parts in tables.items()}
    drawn = findings(tables["pairs"], tables["fragility"])
    safer = drawn["heavier_is_safer"]
    return tables, {
        "fragility_never_rises": never_rises(pd.concat(order), settings["largest_rise"]),
        "heavier_is_safer": truth(
            safer.pop("holds"), levels=settings["intensities"]["points"], **safer
        ),
        "probability_is_lower": drawn["probability_is_lower"],
        "gain_is_that_of_size": truth(
            all(row["excess_low"] <= 0.0 <= row["excess_high"] for row in beyond), beyond=beyond
        ),
        "misfit": drawn["misfit"],
        "half_by_one": truth(
            all(row["mass_ratio_high"] < 1.0 for row in shares if row["share"] == 0.5),
            shares=shares,
        ),
    }


def findings(reversals_pairs: pd.DataFrame, reversals_fragility: pd.DataFrame) -> dict:
    """Return what the tables say of pairs and curves; other intervals are of resamples."""
    pair, curve = reversals_pairs, reversals_fragility
    return {
        "heavier_is_safer": {
            "holds": not pair.only_heavier.any(),
            "cells": int(pair.cells.sum()),
            "least_reversed": float(pair.reversed.min()),
            "most_reversed": float(pair.reversed.max()),
        },
        "probability_is_lower": truth(
            (pair.reversed_high < 0.5).all(), largest_upper_end=float(pair.reversed_high.max())
        ),
        "misfit": value((curve.probability - curve.fitted).abs().max(), 0.0),
    }


def work(job: Any) -> tuple:
    settings, structures = job.params.settings, job.params.structures
    answered = {
        name: read_answers(job.input.shards, name, settings, asked.motions)
        for name, asked in frames_and_columns(settings, structures).items()
    }
    tables, findings = main(settings, structures, answered)
    return tables["fragility"], tables["pairs"], tables["medians"], findings


if __name__ == "__main__":
    run(snakemake, work)
