"""Reduction of √r of the column at which the benefit of the cap beam ends.

The benefit is the probability that the column overturns minus the frame's, under the same
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
from steps.shared.sweep import FAMILIES, models, outcomes, reductions, restitution_question, sets
from topheavy import Column
from topheavy.risk.resampling import Ensemble

WITHIN = "impulses within the contacts"
FINE = 0.5  # shift of an end by twice the step of the reductions, times the width of its interval


def compute(settings, motions, structures, shards):
    column = Column(**structures[motions["structure"]])
    shares, ends, benefits, samples = reductions(settings), [], [], {}
    level = settings["velocities"].index(motions["velocity"])
    measured = list(shares).index(settings["measured"][-1])
    for number, name in enumerate(FAMILIES):
        quakes = [quake for quake in sets(motions) if quake.startswith(name)]
        parts = [outcomes(shards, f"{quake}: lowered") == 1 for quake in quakes]
        samples[quakes[0]] = parts[0]
        fell, groups = np.concatenate(parts), np.repeat(quakes, [len(part) for part in parts])
        spec = settings["bootstrap"] | {"seed": settings["bootstrap"]["seed"] + number}
        ensemble = Ensemble(fell, groups.tolist(), **spec)
        means = ensemble.means()
        for place, velocity in enumerate(settings["velocities"]):
            less = means[:, : shares.size, place] - means[:, [shares.size], place]
            end, *resampled = (end_of(shares, benefit) for benefit in less)
            tail = (1.0 - spec["confidence"]) / 2.0
            low, high = np.quantile(resampled, (tail, 1.0 - tail), method="nearest")
            coarse = end_of(shares[::2], less[0, ::2])
            check(
                coarse == end or abs(coarse - end) <= FINE * (high - low),
                f"twice the step moves the end from {end:g} to {coarse:g} at {velocity:g} m/s",
            )
            ends.append(
                {"set": name, "velocity": velocity, "motions": len(fell)}
                | {"column": means[0, 0, place], "frame": means[0, shares.size, place]}
                | {"end": end, "end_low": low, "end_high": high}
                | {"remaining": less[0, measured] / less[0, 0]}
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


def compare(name, settings, ensemble, means):
    """Yield the benefit at the stated velocity, if √r of both or of the column alone is lower.

    The last row is that of impulses within the contacts.
    """
    shares, within = list(reductions(settings)), means.shape[1] - 2
    first, cases = len(shares), []  # lowered structures, reduction, places of column and frame
    for number, share in enumerate([0.0, *settings["lowered"]]):
        cases.append(("both", share, shares.index(share), first + number))
        if share:
            cases.append(("column alone", share, shares.index(share), first))
    for lowered, share, *places in [*cases, (WITHIN, 0.0, within, within + 1)]:
        column, frame = means[:, places].T
        yield (
            {"set": name, "lowered": lowered, "reduction": share}
            | {"column": column[0], "frame": frame[0]}
            | ensemble.bounds("benefit", column - frame)
        )


def sampled(samples, settings, motions, column):
    """Yield outcomes under a random motion of each family, half of them beside a boundary."""
    random = np.random.default_rng(settings["bootstrap"]["seed"])
    question, motions_of = restitution_question(motions, settings, column), models(motions)
    for name, fell in samples.items():
        number = int(random.integers(len(fell)))
        record = motions_of[name][number].record()
        for _ in range(settings["sample"]):
            place, level = (int(random.integers(size)) for size in fell[number].shape)
            block, factor = question.blocks[place], question.factors(record)[level]
            if random.integers(2):
                factor = beside_a_boundary(partial(overturns, block, record, None), factor)
            yield block, record, None, factor, fell[number, place, level]


def findings(break_even, break_even_benefit, settings):
    """Return where the benefit ends, and its size with √r of Eq. (25) and with measured √r.

    The share of the benefit that remains, at each velocity, has the last measured √r of the column
    alone.
    """
    ends, benefits = break_even, break_even_benefit
    lowered = benefits[benefits.lowered == "both"]
    known = ends[np.isfinite(ends.end)]
    results = {
        "benefit_ends": truth(
            len(known) == len(ends),
            least=known.end.min(),
            most=known.end.max(),
            low=ends.end_low.min(),
            high=ends.end_high.max(),
        ),
        "frame_is_safer": truth((lowered.benefit_low > 0.0).all()),
    }
    for name, rows in ends.groupby("set"):
        least, most = rows.remaining.min(), rows.remaining.max()
        less = truth(most < 1.0, least=least, most=most)
        results[f"remaining_share_{name.replace('-', '_')}"] = less
    measured = settings["measured"][-1]
    for name, way, share in (
        ("benefit", "both", 0.0),
        ("remaining", "column alone", measured),
        ("remaining_of_both", "both", measured),
        ("within", WITHIN, 0.0),
    ):
        rows = benefits[(benefits.lowered == way) & (benefits.reduction == share)]
        for row in rows.itertuples():
            low, high = row.benefit_low, row.benefit_high
            results[f"{name}_{row.set.replace('-', '_')}"] = value(
                row.benefit, (high - low) / 2.0, low=low, high=high
            )
    return results


if __name__ == "__main__":
    run(snakemake, compute, findings)
