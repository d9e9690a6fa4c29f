"""Probability of overturning of a column, of one with a fixed mass, and of frames, by model.

Motions are scaled to stated peak ground velocities. Intervals are of motions drawn anew;
structures stay paired under each motion.
"""

from functools import partial
from itertools import combinations

import numpy as np
from scipy.special import bdtr

from replication.step import check, run, truth, value
from steps.shared import harmonic
from steps.shared.samples import beside_a_boundary, check_sample, overturns
from steps.shared.sweep import (
    FREE_FALL,
    VERTICAL,
    components,
    frames,
    models,
    outcomes,
    sets,
    stated,
)
from topheavy import Column
from topheavy.risk.curve import fit, medians
from topheavy.risk.resampling import Ensemble

NAMES = ("column", "fixed", "frame")
COLUMN, FIXED, FRAME = range(3)


def compute(settings, structures, shards):
    columns = {name: Column(**structures[name]) for name in settings["structures"]}
    column, names = columns[settings["structure"]], sets(settings)
    check_sample(sampled(shards, settings, column))
    tables = {name: [] for name in ("probabilities", "gains", "pairs", "fragility", "rotations")}
    for model in models(settings):
        results = outcomes(shards, model)
        kept = (results != FREE_FALL).all(axis=(1, 2))
        tables["probabilities"].append(row(model, results[kept] == 1, settings))
        if not model.endswith(VERTICAL):
            for name, structure in columns.items():
                fell = outcomes(shards, f"{model}: {name}") == 1
                tables["gains"] += gains(model, name, fell, settings, structure)
                shares = fell.mean(axis=0)
                if model in names and name == settings["structure"]:
                    shares = [*shares, *outcomes(shards, f"{model}: fixed mass").mean(axis=0)]
                tables["fragility"] += curves(model, name, shares, settings, structure)
        if model in names:
            factors = settings["velocity"] / outcomes(shards, f"{model}: peaks")
            few = factors <= settings["largest_factor"]
            if not few.all():
                name = f"{model}, factor at most {settings['largest_factor']:g}"
                tables["probabilities"].append(row(name, results[few] == 1, settings))
            turned = outcomes(shards, f"{model}: rotations")
            tables["rotations"] += rotations(model, turned, settings)
    for name in columns:
        fell = [outcomes(shards, f"{model}: {name}") == 1 for model in names]
        tables["pairs"] += pairs(name, fell, settings)
    gammas, narrow = [0.0, *settings["mass_ratios"]], settings["harmonic"]
    overturned = harmonic.outcomes(narrow, gammas, column)
    check_sample(harmonic.sampled(narrow, gammas, overturned, column))
    tables["harmonic"] = harmonic.pairs(narrow, gammas, overturned, settings["bootstrap"])
    return tables


def row(model, fell, settings):
    """Return probabilities at the stated velocity, and their paired differences.

    `only_frame` are the motions that overturn the frame and not the column. A small change of
    scale changes the outcome of the column for the share `changed` of the motions.
    """
    ensemble = Ensemble(fell[..., :1], None, **settings["bootstrap"])
    shares = ensemble.means()[..., 0].T
    numbers = {name: shares[place] for place, name in enumerate(NAMES)}
    numbers["harm"] = shares[FIXED] - shares[COLUMN]
    numbers["benefit"] = shares[COLUMN] - shares[FRAME]
    of_column, of_frame = fell[:, COLUMN, 0], fell[:, FRAME, 0]
    columns = {"model": model, "motions": len(fell)}
    columns["only_frame"] = int((of_frame & ~of_column).sum())
    columns["changed"] = float((of_column != fell[:, COLUMN, 1]).mean())
    for name, values in numbers.items():
        columns |= ensemble.bounds(name, values)
    return columns


def gains(model, structure, fell, settings, column):
    """Return for each frame its gain, and how often only it overturns and not the column.

    The gain is that of the velocity at which half of the motions overturn a structure, by a fitted
    curve. `ratio` is the number of cases, motions at one velocity, in which only the frame
    overturns, over the number in which only the column does.
    """
    ensemble = Ensemble(fell, None, **settings["bootstrap"])
    velocities = frames(settings, column).velocities
    middle = medians(velocities, fit(velocities, ensemble.means(), skewed=True))
    check(
        np.isfinite(middle[0]).all(),
        f"{model}, {structure}: the velocities reach no median; widen them",
    )
    ratios = alone(ensemble, [(0, place) for place in range(1, fell.shape[1])])
    return [
        {"model": model, "structure": structure, "mass_ratio": gamma, "motions": len(fell)}
        | ensemble.bounds("gain", middle[:, place] / middle[:, 0] - 1.0)
        | ensemble.bounds("ratio", ratios[:, place - 1])
        for place, gamma in enumerate(settings["mass_ratios"], 1)
    ]


def alone(ensemble, pairs):
    """Return how often only the heavier frame of a pair overturns, over how often the lighter."""
    fell = ensemble.outcomes
    orders = [order for light, heavy in pairs for order in ((light, heavy), (heavy, light))]
    cases = np.stack([fell[:, first] & ~fell[:, second] for first, second in orders], axis=1)
    means = ensemble.means(cases.sum(axis=-1))
    return means[:, 1::2] / means[:, ::2]


def pairs(structure, parts, settings):
    """Return the ratio of `gains` for each pair of frames, under the motions of all sets.

    The column has γ = 0.
    """
    groups = np.repeat(range(len(parts)), [len(part) for part in parts]).tolist()
    ensemble = Ensemble(np.concatenate(parts), groups, **settings["bootstrap"])
    gammas = [0.0, *settings["mass_ratios"]]
    combined = [*combinations(range(len(gammas)), 2)]
    ratios = alone(ensemble, combined)
    return [
        {"structure": structure, "lighter": gammas[light], "heavier": gammas[heavy]}
        | {"motions": len(groups)}
        | ensemble.bounds("ratio", ratios[:, place])
        for place, (light, heavy) in enumerate(combined)
    ]


def curves(model, name, shares, settings, column):
    """Return the probability of each structure on a column over the velocity.

    The fixed mass is on the stated column alone, under the sets and not under noise.
    """
    names = [("column", 0.0), *(("frame", gamma) for gamma in settings["mass_ratios"])]
    names.append(("fixed mass", settings["mass_ratio"]))
    return [
        {"model": model, "column": name, "structure": structure, "mass_ratio": gamma}
        | {"velocity": velocity, "probability": share}
        for (structure, gamma), values in zip(names, shares, strict=False)
        for velocity, share in zip(frames(settings, column).velocities, values, strict=True)
    ]


def rotations(model, peaks, settings):
    """Return the median of the peaks of |θ|/α; an overturned structure counts as above it.

    The interval of a median is that of its ranks by the binomial distribution.
    """
    tail = (1.0 - settings["bootstrap"]["confidence"]) / 2.0
    rank = max(int((bdtr(np.arange(len(peaks)), len(peaks), 0.5) < tail).sum()), 1)
    ordered = np.sort(peaks, axis=0)
    ends = {"_low": ordered[rank - 1], "": np.median(peaks, axis=0), "_high": ordered[-rank]}
    return [
        {"model": model, "mass_ratio": gamma, "velocity": velocity}
        | {f"median_peak{end}": peaks_of[place, level] for end, peaks_of in ends.items()}
        for place, gamma in enumerate([0.0, *settings["mass_ratios"]])
        for level, velocity in enumerate(settings["rotations"]["velocities"])
    ]


def sampled(shards, settings, column):
    """Yield outcomes under random motions; half of those without vertical motion at a boundary."""
    random = np.random.default_rng(settings["bootstrap"]["seed"])
    question, motions = stated(settings, column), models(settings)
    for place in np.linspace(0, len(motions) - 1, settings["sample"]).astype(int):
        model = [*motions][place]
        results = outcomes(shards, model)[..., 0]
        number = int(random.choice(np.flatnonzero((results != FREE_FALL).all(axis=1))))
        record, up = components(motions[model][number], settings)
        for block, result in zip(question.blocks, results[number], strict=True):
            factor = settings["velocity"] / record.peak_velocity
            if up is None and random.integers(2):
                factor = beside_a_boundary(partial(overturns, block, record, up), factor)
            yield block, record, up, factor, result == 1


def findings(motions, motions_gains, motions_pairs, motions_harmonic, settings, structures):
    """Return orders and gains; `gain_trilith` and so on are those of γ as stated, by structure."""
    gains = motions_gains
    equal = gains[gains.mass_ratio == settings["mass_ratio"]]
    by_height = sorted(settings["structures"], key=lambda name: structures[name]["half_height"])
    rising = equal.pivot(index="model", columns="structure", values="gain")[by_height]
    rises = (np.diff(rising, axis=1) > 0.0).all(axis=1)
    with_column = motions_harmonic.lighter == 0.0
    reversals = motions_harmonic[~with_column & (motions_harmonic.difference_low > 0.0)]
    broadband = (motions_pairs.ratio_high < 1.0).all()
    return {
        f"gain_{name}": truth(
            (rows.gain_low > 0.0).all(),
            least=rows.gain.min(),
            most=rows.gain.max(),
            low=rows.gain_low.min(),
            high=rows.gain_high.max(),
        )
        for name, rows in equal.groupby("structure")
    } | {
        "order": truth(
            ((motions.harm_low > 0.0) & (motions.benefit_low > 0.0)).all(),
            **{name: [motions[name].min(), motions[name].max()] for name in NAMES},
        ),
        "gain": truth((gains.gain_low > 0.0).all(), least=equal.gain.min(), most=equal.gain.max()),
        "gain_rises_with_height": value(rises.sum(), 0.0, models=len(rises)),
        "some_only_frame": truth((motions.only_frame > 0).all()),
        "probability_is_lower": truth(
            broadband and reversals.empty,
            holds_when=broadband,
            condition="the motions are broad-band or near-fault, as in the four sets",
            pairs=len(motions_pairs),
            least=motions_pairs.ratio.min(),
            most=motions_pairs.ratio.max(),
        ),
        "column_overturns_most_often": truth(
            broadband and (motions_harmonic[with_column].difference < 0.0).all()
        ),
        "order_of_frames_can_turn": truth(
            len(reversals) > 0,
            **{
                name: f"{number:g}" if name in ("lighter", "heavier") else number
                for row in reversals.nlargest(1, "difference").to_dict("records")
                for name, number in row.items()
            },
        ),
        "outcomes_that_change": value(motions.changed.max(), 0.0, change=settings["change"]),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
