"""How far √r of the column may be lowered until the benefit of the cap beam ends.

The benefit is the probability that the column overturns less that of the frame, under the same
motions. A lower √r of the column alone reduces it, but for the scatter of a finite number of
motions: it ends where its non-increasing (isotonic) fit is zero.
"""

import math
from functools import partial

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression

from replication.step import check, run, truth, value
from steps.shared.samples import beside_a_boundary, check_sample, overturns
from steps.shared.sweep import (
    FAMILIES,
    models,
    outcomes,
    reductions,
    restitution_question,
    sets,
)
from topheavy import Column
from topheavy.risk.resampling import Ensemble

WITHIN = "impulses within the contacts"
FINE = 0.5  # of the interval of an end: how far twice the step of the reductions may move it


def compute(settings, motions, structures, shards):
    column = Column(**structures[motions["structure"]])
    shares, ends, benefits, samples = reductions(settings), [], [], {}
    level = settings["velocities"].index(motions["velocity"])
    for number, name in enumerate(FAMILIES):
        quakes = [each for each in sets(motions) if each.startswith(name)]
        parts = [outcomes(shards, f"{each}: lowered") == 1 for each in quakes]
        samples[quakes[0]] = parts[0]
        fell, groups = np.concatenate(parts), np.repeat(quakes, [len(part) for part in parts])
        spec = settings["bootstrap"] | {"seed": settings["bootstrap"]["seed"] + number}
        ensemble = Ensemble(fell, groups.tolist(), **spec)
        means = ensemble.means()
        for place, velocity in enumerate(settings["velocities"]):
            less = means[:, : shares.size, place] - means[:, [shares.size], place]
            every = np.array([end_of(shares, one) for one in less])
            low, high = bounds(every, spec["confidence"])
            coarse = end_of(shares[::2], less[0, ::2])
            check(
                coarse == every[0] or abs(coarse - every[0]) <= FINE * (high - low),
                f"twice the step moves the end from {every[0]:g} to {coarse:g} at {velocity:g} m/s",
            )
            ends.append(
                {"set": name, "velocity": velocity, "motions": len(fell)}
                | {"column": means[0, 0, place], "frame": means[0, shares.size, place]}
                | {"end": every[0], "end_low": low, "end_high": high}
            )
        benefits += compare(name, settings, ensemble, means[..., level])
    check_sample(sampled(samples, settings, motions, column))
    return {"ends": pd.DataFrame(ends), "benefits": pd.DataFrame(benefits)}


def end_of(shares, benefits):
    """Return the reduction at which the non-increasing fit of the benefits reaches zero.

    Lines join the centres of its blocks, over which it is constant. Infinite where it is positive
    in the last block.
    """
    fit = isotonic_regression(benefits, increasing=False)
    first, last = fit.blocks[:-1], fit.blocks[1:] - 1
    centres, values = 0.5 * (shares[first] + shares[last]), fit.x[first]
    ended = np.flatnonzero(values <= 0.0)
    if not ended.size:
        return math.inf
    if ended[0] == 0:
        return 0.0
    before, after = ended[0] - 1, ended[0]
    step = (centres[after] - centres[before]) / (values[before] - values[after])
    return float(centres[before] + step * values[before])


def bounds(ends, confidence):
    """Return the interval of an end, of that of all motions and those of its resamples."""
    tail = (1.0 - confidence) / 2.0
    return np.quantile(ends[1:], (tail, 1.0 - tail), method="nearest")


def compare(name, settings, ensemble, means):
    """Return the benefit at the stated velocity, if √r of both or of the column alone is lower.

    The last row is that of impulses within the contacts.
    """
    shares, rows = list(reductions(settings)), []
    first = len(shares)
    for number, share in enumerate([0.0, *settings["lowered"]]):
        column = shares.index(share)
        for way, frame in {"both": first + number, "column alone": first}.items():
            if share or way == "both":
                rows.append(row(name, way, share, ensemble, means[:, column], means[:, frame]))
    within = means.shape[1] - 2
    rows.append(row(name, WITHIN, 0.0, ensemble, means[:, within], means[:, within + 1]))
    return rows


def row(name, way, share, ensemble, column, frame):
    return {"set": name, "lowered": way, "reduction": share} | {
        "column": column[0],
        "frame": frame[0],
        **ensemble.bounds("benefit", column - frame),
    }


def sampled(samples, settings, motions, column):
    """Yield outcomes under a random motion of each family, half of them beside a boundary."""
    random = np.random.default_rng(settings["bootstrap"]["seed"])
    question, motions_of = restitution_question(motions, settings, column), models(motions)
    for name, fell in samples.items():
        at = int(random.integers(len(fell)))
        record = motions_of[name][at].record()
        for _ in range(settings["sample"]):
            place, level = (int(random.integers(size)) for size in fell[at].shape)
            block, factor = question.blocks[place], question.factors(record)[level]
            if random.integers(2):
                factor = beside_a_boundary(partial(overturns, block, record, None), factor)
            yield block, record, None, factor, fell[at, place, level]


def findings(break_even, break_even_benefit, settings):
    """Return where the benefit ends, and its size as √r of Eq. (25) and as measured say."""
    ends, benefits = break_even, break_even_benefit
    both = benefits[benefits.lowered == "both"]
    known = ends[np.isfinite(ends.end)]
    found = {
        "benefit_ends": truth(
            len(known) == len(ends),
            least=known.end.min(),
            most=known.end.max(),
            low=ends.end_low.min(),
            high=ends.end_high.max(),
        ),
        "frame_is_safer": truth((both.benefit_low > 0.0).all()),
    }
    measured = settings["measured"][-1]
    for name, way, share in (
        ("benefit", "both", 0.0),
        ("remaining", "column alone", measured),
        ("remaining_of_both", "both", measured),
        ("within", WITHIN, 0.0),
    ):
        rows = benefits[(benefits.lowered == way) & (benefits.reduction == share)]
        for one in rows.itertuples():
            low, high = one.benefit_low, one.benefit_high
            found[f"{name}_{one.set.replace('-', '_')}"] = value(
                one.benefit, (high - low) / 2.0, low=low, high=high
            )
    return found


if __name__ == "__main__":
    run(snakemake, compute, findings)
