"""Probability of overturning of a column, of one with a fixed mass, and of frames, by model.

Motions are scaled to stated peak ground velocities. Intervals are of motions drawn anew;
structures stay paired under each motion.
"""

from functools import partial
from itertools import combinations

import numpy as np
import pandas as pd

from replication.step import check, run, truth
from steps.shared.ensemble import Ensemble
from steps.shared.second import beside_a_boundary, check_by_scipy, overturns
from steps.shared.sweep import (
    FREE_FALL,
    SETS,
    components,
    models,
    outcomes,
    question_of,
    structures_of,
)
from topheavy import Column
from topheavy.risk.curve import fit, medians

NAMES = ("column", "fixed", "frame")
COLUMN, FIXED, FRAME = range(3)
FACTOR = ", factor at most "  # appended to the name of a set of which some motions are left out


def compute(settings, structures, shards):
    column = Column(**structures[settings["structure"]])
    samples = {model: outcomes(shards, model) for model in models(settings)}
    check_by_scipy(sampled(samples, settings, column))
    tables = {"probabilities": [], "fragility": [], "pairs": []}
    for model, found in samples.items():
        kept = found[(found != FREE_FALL).all(axis=(1, 2))] == 1
        rows = {model: kept}
        if model in SETS:
            factors = settings["velocity"] / outcomes(shards, f"{model}: peaks")
            if (few := factors <= settings["largest_factor"]).sum() < len(kept):
                rows[f"{model}{FACTOR}{settings['largest_factor']:g}"] = kept[few]
        for name, one in rows.items():
            ensemble = Ensemble(one, None, **settings["bootstrap"])
            means, velocities = ensemble.means(), question_of(model, settings, column).velocities
            tables["probabilities"].append(row(name, ensemble, means, velocities[:-1]))
            if name in SETS:
                tables["fragility"] += curves(name, ensemble, means, velocities, settings, column)
                tables["pairs"] += pairs(name, ensemble, means, velocities, settings, column)
    return {name: pd.DataFrame(rows) for name, rows in tables.items()}


def row(model, ensemble, means, velocities):
    """Return probabilities at the stated velocity, their differences, and the gain of the median.

    `only_frame` are the motions that overturn the frame and not the column. The gain is that of the
    velocity that overturns the frame under half of the motions, over that of the column.
    """
    fell, shares = ensemble.outcomes[..., -1], means[..., -1].T
    numbers = {name: shares[place] for place, name in enumerate(NAMES)}
    numbers["harm"] = shares[FIXED] - shares[COLUMN]
    numbers["benefit"] = shares[COLUMN] - shares[FRAME]
    found = {"model": model, "motions": len(fell)}
    found["only_frame"] = int((fell[:, FRAME] & ~fell[:, COLUMN]).sum())
    found["only_column"] = int((fell[:, COLUMN] & ~fell[:, FRAME]).sum())
    if velocities.size:
        middle = middles(velocities, means[:, [COLUMN, FRAME], :-1])
        check(np.isfinite(middle[0]).all(), f"{model}: the velocities reach no median; widen them")
        found["median_velocity"] = middle[0, 0]
        numbers["gain"] = middle[:, 1] / middle[:, 0] - 1.0
    for name, values in numbers.items():
        found |= ensemble.bounds(name, values)
    return found


def middles(velocities, shares):
    """Return the velocities that overturn under half of the motions, by fitted curves."""
    return medians(velocities, fit(velocities, shares, skewed=True))


def curves(model, ensemble, means, velocities, settings, column):
    """Return the probability of each structure over the velocity."""
    return [
        {"model": model, "structure": name, "mass_ratio": gamma, "velocity": velocity}
        | ensemble.bounds("probability", means[:, place, level])
        for place, (name, gamma, _) in enumerate(structures_of(settings, column))
        for level, velocity in enumerate(velocities[:-1])
    ]


def pairs(model, ensemble, means, velocities, settings, column):
    """Return for each pair of frames the gain of the median, and how often one overturns alone.

    `only_lighter` and `only_heavier` are shares of the motions, in the mean over the logarithm of
    the velocity; `reversed` is the share of `only_heavier` in both. The column has γ = 0.
    """
    frames = {
        gamma: place
        for place, (name, gamma, _) in enumerate(structures_of(settings, column))
        if name != "fixed mass"
    }
    middle, fell = middles(velocities[:-1], means[..., :-1]), ensemble.outcomes[..., :-1]
    weights = np.ones(fell.shape[-1])
    weights[[0, -1]] = 0.5  # the trapezoidal rule
    rows = []
    for light, heavy in combinations(sorted(frames), 2):
        one, other = frames[light], frames[heavy]
        alone = np.stack([fell[:, one] & ~fell[:, other], fell[:, other] & ~fell[:, one]], axis=1)
        lighter, heavier = (ensemble.means(alone) @ (weights / weights.sum())).T
        rows.append(
            {"model": model, "lighter": light, "heavier": heavy}
            | ensemble.bounds("only_lighter", lighter)
            | ensemble.bounds("only_heavier", heavier)
            | ensemble.bounds("reversed", heavier / (lighter + heavier))
            | ensemble.bounds("gain", middle[:, other] / middle[:, one] - 1.0)
        )
    return rows


def sampled(samples, settings, column):
    """Yield a seeded sample of outcomes; half of those without vertical motion at a boundary."""
    random = np.random.default_rng(settings["bootstrap"]["seed"])
    motions, names = models(settings), list(samples)
    for number in range(settings["checked"]):
        model = names[number % len(names)]
        found, question = samples[model], question_of(model, settings, column)
        at, place, level = (int(random.integers(size)) for size in found.shape)
        if found[at, place, level] == FREE_FALL:
            continue
        record, up = components(motions[model][at], settings)
        block, factor = question.blocks[place], question.velocities[level] / record.peak_velocity
        if up is None and random.integers(2):
            factor = beside_a_boundary(partial(overturns, block, record, up), factor)
        yield block, record, up, factor, found[at, place, level] == 1


def findings(motions, motions_pairs):
    curves = motions.dropna(subset=["gain"])
    ends = {name: [motions[name].min(), motions[name].max()] for name in NAMES}
    return {
        "order": truth(
            ((motions.harm_low > 0.0) & (motions.benefit_low > 0.0)).all(),
            samples=len(motions),
            **ends,
        ),
        "gain": truth(
            (curves.gain_low > 0.0).all(),
            samples=len(curves),
            least=curves.gain.min(),
            most=curves.gain.max(),
        ),
        "some_only_frame": truth((motions.only_frame > 0).all(), samples=len(motions)),
        "probability_is_lower": truth(
            (motions_pairs.reversed_high < 0.5).all(),
            pairs=len(motions_pairs),
            least=motions_pairs.reversed.min(),
            most=motions_pairs.reversed.max(),
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
