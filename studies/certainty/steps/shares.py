"""Which of α, p̂ and √r carries the difference in probability between the vase and the frame.

As in `steps.vase_shares` for the minimum overturning acceleration and for a map of pulses, each of
the three is taken from the frame or from the column with the fixed mass. The worth of a block is
the share of synthetic motions, at a stated PGV, that it survives.
"""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.sweep import Swept, read_answers
from steps.vase_shares import PARAMETERS, shapley, subsets
from studies.certainty.subjects import exchanges


def values_of(settings: dict, swept: Swept) -> pd.DataFrame:
    """Return the Shapley values of each parameter for each motion, γ and PGV.

    They are linear in the worth, so that their means are those of the share of motions.
    """
    labels = [subject.labels for subject in exchanges(settings).subjects]
    places = {(one["mass_ratio"], one["free"]): place for place, one in enumerate(labels)}
    rows = []
    for draw, fell in zip(swept.draws, swept.outcomes, strict=True):
        for gamma in settings["mass_ratios"]:
            for number, level in enumerate(settings["pgv"]):
                worth = {one: float(not fell[places[gamma, one], number]) for one in subsets()}
                label = {"family": draw.family, "mass_ratio": gamma, "pgv": level}
                rows.append(label | shapley(worth))
    return pd.DataFrame(rows)


def shares(values: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Return the share of each parameter in the gain in probability, with resampled intervals."""
    random, rows = np.random.default_rng(settings["seed"]), []
    for labels, motions in values.groupby(["family", "mass_ratio", "pgv"], sort=False):
        each = motions[list(PARAMETERS)].to_numpy()
        again = random.integers(len(each), size=(settings["resamples"], len(each)))
        sums = each[again].sum(axis=1)
        of_resamples = sums / sums.sum(axis=1, keepdims=True)
        tail = 0.5 * (1.0 - settings["confidence"])
        low, high = np.quantile(of_resamples, [tail, 1.0 - tail], axis=0)
        share = each.sum(axis=0) / each.sum()
        for place, name in enumerate(PARAMETERS):
            row = dict(zip(("family", "mass_ratio", "pgv"), labels, strict=True))
            row |= {"motions": len(each), "gain": each.sum() / len(each), "parameter": name}
            row |= {"share": share[place], "share_low": low[place], "share_high": high[place]}
            rows.append(row)
    return pd.DataFrame(rows)


def main(settings: dict, swept: Swept) -> tuple[pd.DataFrame, dict[str, Finding]]:
    table = shares(values_of(settings, swept), settings)
    return table, findings(table)


def findings(certainty_shares: pd.DataFrame) -> dict[str, Finding]:
    """Return the range of each parameter's share, and whether α has most, from their table."""
    table = certainty_shares
    slenderness = table[table.parameter == "α"]
    ranges = table.groupby("parameter", sort=False).share.agg(["min", "max"])
    return {
        "slenderness_has_most": truth(
            len(slenderness) > 0 and bool((slenderness.share_low > 0.5).all()),
            compared=len(slenderness),
            ranges={name: [float(x) for x in row] for name, row in ranges.iterrows()},
        )
    }


def work(job: Any) -> tuple:
    settings = job.params.settings
    motions = settings["motions"]
    return main(settings, read_answers(job.input.shards, "shares", job.params.ensemble, motions))


if __name__ == "__main__":
    run(snakemake, work)
