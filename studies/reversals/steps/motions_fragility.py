"""Fragility under synthetic motions: benefit of a heavier cap beam, and counts of reversals.

Intervals are those of motions drawn anew from the ensemble; frames stay paired under each motion.
Families of motions are kept apart.
"""

import csv
import heapq
import itertools
import math
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.outcomes import FALLS, read
from topheavy.fragility import resampling
from topheavy.fragility.curve import curve, fit, medians, why_no_median
from topheavy.fragility.gain import mass_ratios_of_gain
from topheavy.structures import size_ratio
from topheavy.synthetic.ensemble import Subject, intensities, subjects

SUBJECT = ["mass_ratio", "as_large_as"]
TINY = 1e-12  # a share: where no cell differs, none is reversed


@dataclass(frozen=True, eq=False)
class Ensemble:
    """One family of motions on the frames and columns of one structure."""

    family: str
    subjects: list[Subject]
    motions: int
    levels: np.ndarray
    confidence: float

    @property
    def labels(self) -> dict:
        return {"family": self.family, "structure": self.subjects[0].structure}

    @property
    def frames(self) -> dict[float, int]:
        """The places of the frames, by γ."""
        return {s.frame.mass_ratio: i for i, s in enumerate(self.subjects) if not s.enlarged}

    def place(self, as_large_as: float) -> int:
        """The place of the solitary column that is as large as R̂ of this γ."""
        return [subject.enlarged for subject in self.subjects].index(as_large_as)

    def bounds(self, name: str, values: np.ndarray) -> dict:
        """Return a value of resamples and its interval, named for a table."""
        keys = (name, f"{name}_low", f"{name}_high")
        return dict(zip(keys, resampling.interval(values, self.confidence), strict=True))


def ensembles(settings: dict, structures: dict) -> dict[tuple[str, str], Ensemble]:
    """Return the ensembles by family and structure, in the order of the tables."""
    under, levels = list(subjects(settings, structures)), intensities(settings)
    each, confidence = (
        settings["runs"][settings["run"]]["motions"],
        settings["bootstrap"]["confidence"],
    )
    found = {}
    for family in settings["families"]:
        for entry in settings["cases"]:
            mine = [subject for subject in under if subject.structure == entry["structure"]]
            motions = len(settings["scenarios"]) * math.ceil(entry["share"] * each)
            found[family, entry["structure"]] = Ensemble(family, mine, motions, levels, confidence)
    return found


def gathered(
    paths: list[str], settings: dict, structures: dict
) -> Iterator[tuple[Ensemble, list[np.ndarray]]]:
    """Yield each ensemble with its means: of the outcomes, then of `differing`.

    Outcomes of `resampling.BLOCK` motions are in memory, however many there are.
    """
    found, boot = ensembles(settings, structures), settings["bootstrap"]
    sums = {
        key: resampling.ResampledMeans(ensemble.motions, boot["resamples"], settings["seed"])
        for key, ensemble in found.items()
    }
    waiting: dict[tuple[str, str], list] = {key: [] for key in found}

    def add(key: tuple[str, str]) -> None:
        texts = [text for motion in waiting[key] for text in motion]
        ensemble = found[key]
        fell = read(texts).reshape(-1, len(ensemble.subjects), ensemble.levels.size) == FALLS
        sums[key].add([fell, *differing(ensemble, fell)])
        waiting[key].clear()

    labels = {
        key: [(s.enlarged, s.frame.mass_ratio) for s in ensemble.subjects]
        for key, ensemble in found.items()
    }
    for key, cells in motions(paths, settings["families"]):
        waiting[key].append([cells[one] for one in labels[key]])
        if len(waiting[key]) == resampling.BLOCK:
            add(key)
    for key, ensemble in found.items():
        if waiting[key]:
            add(key)
        yield ensemble, sums[key].means()


def motions(paths: list[str], families: list[str]) -> Iterator[tuple[tuple[str, str], dict]]:
    """Yield family and structure of every motion, and its outcomes by (as_large_as, mass_ratio).

    They come in the order of the ensemble, which every shard has, whatever shards there are.
    """

    def number(row: dict) -> tuple[int, int, int]:
        return families.index(row["family"]), int(row["scenario"]), int(row["motion"])

    with ExitStack() as stack:
        files = [stack.enter_context(open(path, encoding="utf-8", newline="")) for path in paths]
        rows = heapq.merge(*map(csv.DictReader, files), key=number)
        for (family, structure, *_), cells in itertools.groupby(
            rows, itemgetter("family", "structure", "scenario", "motion")
        ):
            outcomes = {
                (float(c["as_large_as"]), float(c["mass_ratio"])): c["outcomes"] for c in cells
            }
            yield (family, structure), outcomes


def curves(ensemble: Ensemble, means: np.ndarray) -> pd.DataFrame:
    """Return fragility over intensity, and by how much it is below that of the lightest frame."""
    fits = curve(ensemble.levels, fit(ensemble.levels, means[0], skewed=True))
    tables = []
    for place, subject in enumerate(ensemble.subjects):
        tables.append(
            ensemble.labels
            | {key: subject.labels[key] for key in SUBJECT}
            | {"intensity": ensemble.levels, "pgv": ensemble.levels * subject.unit}
            | ensemble.bounds("probability", means[:, place])
            | {"fitted": fits[place]}
            | ensemble.bounds("less", means[:, 0] - means[:, place])
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


def capacities(ensemble: Ensemble, middle: np.ndarray) -> pd.DataFrame:
    """Return the median capacity of each, and by how much it is above that of the lightest."""
    rows = []
    for place, subject in enumerate(ensemble.subjects):
        gamma = subject.enlarged or subject.frame.mass_ratio
        gain = middle[:, place] / middle[:, 0] - 1.0
        rows.append(
            ensemble.labels
            | {key: subject.labels[key] for key in SUBJECT}
            | {"motions": ensemble.motions, "size_gain": size_ratio(gamma) - 1.0}
            | {"expected_gain": math.sqrt(size_ratio(gamma)) - 1.0}
            | ensemble.bounds("median", middle[:, place])
            | {"median_pgv": middle[0, place] * subject.unit}
            | ensemble.bounds("gain", gain)
        )
    return pd.DataFrame(rows)


def differing(ensemble: Ensemble, outcomes: np.ndarray) -> list[np.ndarray]:
    """Return for each pair of frames the cells in which only the lighter, only the heavier falls.

    The outcomes have the shape (motions, subjects, levels).
    """
    found = []
    for i, j in itertools.combinations(ensemble.frames.values(), 2):
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


def pairs(ensemble: Ensemble, means: list[np.ndarray]) -> pd.DataFrame:
    """Return for each pair of frames the shares of cells, motions at levels, that differ.

    `means` are those of `differing`; the shares are means over the levels. `reversed` is the share
    of these in which the heavier falls.
    """
    rows = []
    cells = ensemble.motions * ensemble.levels.size
    of_pairs = itertools.combinations(ensemble.frames, 2)
    both = zip(means[::2], means[1::2], strict=True)
    for (light, heavy), shares in zip(of_pairs, both, strict=True):
        bought, lost = map(over_levels, shares)
        rows.append(
            ensemble.labels
            | {"lighter": light, "heavier": heavy, "cells": cells}
            | ensemble.bounds("only_lighter", bought)
            | ensemble.bounds("only_heavier", lost)
            | ensemble.bounds("reversed", lost / (bought + lost + TINY))
        )
    return pd.DataFrame(rows)


def falls(ensemble: Ensemble, means: np.ndarray) -> pd.DataFrame:
    """Return by how much each frame's fragility is below that of every lighter one.

    Small rises from frame to frame could add up; comparing neighbours would not show it.
    """
    light, heavy = np.transpose([*itertools.combinations(ensemble.frames.values(), 2)])
    less = means[:, light] - means[:, heavy]
    return pd.DataFrame(
        {key: np.ravel(found) for key, found in ensemble.bounds("less", less).items()}
    )


def beyond_size(ensemble: Ensemble, middle: np.ndarray) -> list[dict]:
    """Return by how much medians of frames exceed those of solitary columns as large."""
    return [
        ensemble.labels
        | {"mass_ratio": subject.enlarged}
        | plain(
            ensemble.bounds(
                "excess", middle[:, ensemble.frames[subject.enlarged]] / middle[:, place] - 1.0
            )
        )
        for place, subject in enumerate(ensemble.subjects)
        if subject.enlarged
    ]


def shares_of_gain(ensemble: Ensemble, middle: np.ndarray, shares: list[float]) -> list[dict]:
    """Return the γ that bring shares of the gain, where frames go up to γ = ∞."""
    frames = ensemble.frames
    if math.inf not in frames:
        return []
    found = mass_ratios_of_gain(list(frames), middle[:, list(frames.values())], shares)
    return [
        ensemble.labels | {"share": share} | plain(ensemble.bounds("mass_ratio", values))
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
    settings: dict, structures: dict, paths: list[str]
) -> tuple[dict[str, pd.DataFrame], dict]:
    tables, order, beyond, shares = {"fragility": [], "medians": [], "pairs": []}, [], [], []
    for ensemble, (means, *of_pairs) in gathered(paths, settings, structures):
        middle = middles(ensemble.levels, means)
        tables["fragility"].append(curves(ensemble, means))
        tables["medians"].append(capacities(ensemble, middle))
        tables["pairs"].append(pairs(ensemble, of_pairs))
        order.append(falls(ensemble, means))
        beyond += beyond_size(ensemble, middle)
        shares += shares_of_gain(ensemble, middle, settings["shares_of_gain"])
        print(ensemble.labels, ensemble.motions, "motions", flush=True)
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
    tables, findings = main(job.params.settings, job.params.structures, job.input.shards)
    return tables["fragility"], tables["pairs"], tables["medians"], findings


if __name__ == "__main__":
    run(snakemake, work)
