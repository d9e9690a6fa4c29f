"""Probability of overturning at stated peak ground velocities and accelerations, with bands.

Bare columns, frames with a free cap beam, and columns with the same mass fixed to the top, under
the synthetic motions of study reversals, each scaled to the intensity.
"""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.second import by_scipy
from steps.shared.spectrum import progress
from steps.shared.sweep import Asked, Swept, read_answers
from studies.certainty.subjects import FREE, MEASURES, similar, supported
from topheavy.risk.tables import exact_interval


def probabilities(
    answers: Mapping[str, tuple[Asked, Swept]], families: list[str], confidence: float
) -> pd.DataFrame:
    """Return the probability of overturning with its interval, over the motions of each family."""
    counted = {}
    for family, (measure, (asked, swept)) in product(families, answers.items()):
        fell = swept.of_family(family).outcomes
        counts, motions = fell.sum(axis=0), len(fell)
        low, high = exact_interval(counts, motions, confidence)
        for place, subject in enumerate(asked.subjects):
            labels = {"family": family, **subject.labels, "measure": measure}
            found = {"level": asked.levels, "fell": counts[place], "motions": motions}
            found |= {"probability": counts[place] / motions}
            found |= {"probability_low": low[place], "probability_high": high[place]}
            counted[family, place, measure] = pd.DataFrame(labels | found)
    places = range(len(asked.subjects))
    return pd.concat(counted[key] for key in product(families, places, answers))


def sampled(answers: Mapping[str, tuple[Asked, Swept]], settings: dict) -> Iterator[tuple]:
    """Yield a seeded sample of the outcomes, for SciPy."""
    random, count = np.random.default_rng(settings["seed"]), settings["checked"]
    for number in progress(range(count), count, "checks"):
        asked, swept = answers[MEASURES[number % len(MEASURES)]]
        motion, place, level = (int(random.integers(size)) for size in swept.outcomes.shape)
        factor = asked.levels[level] / swept.peaks[motion]
        record, block = swept.draws[motion].record(), asked.subjects[place].block
        yield block, record, factor, bool(swept.outcomes[motion, place, level])


def worst(table: pd.DataFrame) -> float:
    """Return the largest upper end of an interval."""
    return float(table.probability_high.max())


def main(
    settings: dict, ensemble: dict, structures: dict, swept: Mapping[str, Swept]
) -> tuple[pd.DataFrame, dict]:
    answers = {one: (supported(settings, structures, one), swept[one]) for one in MEASURES}
    table = probabilities(answers, ensemble["families"], settings["confidence"])
    ample = settings["ample"]
    large = [
        name
        for name, column, _ in similar(settings, structures)
        if 2.0 * column.half_height >= ample["height"]
    ]
    velocity = table[table.measure == "pgv"]
    framed = velocity[(velocity.support == FREE) & velocity.structure.isin(large)]
    modest = framed[framed.level <= ample["pgv"]]
    agreed = by_scipy(sampled(answers, settings))
    return table, {
        "ample_stability": truth(
            worst(framed) < ample["probability"],
            holds_when=worst(modest) < ample["probability"],
            condition=f"PGV up to {ample['pgv']:g} m/s, columns of {ample['height']:g} m or more",
            largest_upper_end=worst(modest),
            at_highest=worst(framed),
            margin=ample["probability"],
            structures=large,
        ),
        **findings(table),
        "second_route": truth(
            agreed["differ"] == 0 and agreed["decided"] > 0, checked=settings["checked"], **agreed
        ),
    }


def findings(certainty_intensities: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the support decides, from the table of probabilities."""
    each = ["family", "structure", "measure", "level"]
    wide = certainty_intensities.pivot_table(index=each, columns="support", values="fell")
    summed = wide.groupby(level=each[:2]).sum()
    return {
        "free_cap_helps": truth(
            (summed.free < summed.bare).all(),
            compared=len(wide),
            differ=int((wide.free != wide.bare).sum()),
            exceptions=int((wide.free > wide.bare).sum()),
        ),
        "fixed_mass_harms": truth(
            (summed.fixed > summed.bare).all(),
            compared=len(wide),
            differ=int((wide.fixed != wide.bare).sum()),
            exceptions=int((wide.fixed < wide.bare).sum()),
        ),
    }


def work(job: Any) -> tuple:
    settings, ensemble = job.params.settings, job.params.ensemble
    swept = {
        one: read_answers(job.input.shards, one, ensemble, settings["motions"]) for one in MEASURES
    }
    return main(settings, ensemble, job.params.structures, swept)


if __name__ == "__main__":
    run(snakemake, work)
