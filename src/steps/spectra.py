"""Gather the overturning spectra from their shards, and compare frames of different γ.

The rule tests whether the minimum overturning amplitude rises with γ at every frequency. It also
computes the share of the frequency–amplitude plane on which only the heavier frame overturns.
"""

from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth
from steps.shared.spectra_compared import ORDER, Spectra, finite, of_sample


def main(settings: dict, solver: dict, lines: pd.DataFrame) -> tuple:
    spectra = Spectra(settings, lines)
    rises = spectra.lowest_rises()
    areas = [row for light, heavy in settings["pairs"] for row in spectra.areas(light, heavy)]
    width, place, light, heavy, amplitude = spectra.counterexample(
        pairwise(settings["mass_ratios"])
    )
    verdicts = [spectra.judged(place, g, amplitude, solver["tightened"]) for g in (light, heavy)]
    if verdicts != [[False] * 2, [True] * 2]:
        raise ArithmeticError(f"γ = {light}, {heavy} at {amplitude:.6g}: not a counterexample")
    table, spec = pd.DataFrame(areas), settings["sample"]
    sample = spectra.sample(spec["points"], spec["seed"], solver["tightened"])
    drawn = findings(table, sample)
    return (
        table,
        sample,
        {
            "lowest_amplitude_rises_with_mass": rises,
            "heavier_is_more_stable": truth(
                drawn["heavier_is_more_stable"]["holds"],
                holds_when=rises.holds,
                condition="what counts is the lowest amplitude of a pulse that overturns",
                width_of_band=width,
                amplitude_over_uplift=amplitude,
                survives=finite(light),
                overturns=finite(heavy),
                **place.described(),
            ),
            "areas": drawn["areas"],
            "sample_agrees": drawn["sample_agrees"],
        },
    )


def findings(spectra_areas: pd.DataFrame, spectra_sample: pd.DataFrame) -> dict[str, Any]:
    """Return the shares of the maps that overturn one frame alone, and whether a sample agrees."""
    exact = spectra_areas[~spectra_areas.linearised]
    pairs = [
        {
            "lighter": lighter,
            "heavier": heavier,
            "only_lighter_overturns": float(np.mean(maps.only_lighter_overturns)),
            "only_heavier_overturns": float(np.mean(maps.only_heavier_overturns)),
            "largest_only_heavier": maps.only_heavier_overturns.max(),
        }
        for (lighter, heavier), maps in exact.groupby(["lighter", "heavier"], sort=False)
    ]
    return {
        "heavier_is_more_stable": {"holds": not spectra_areas.only_heavier_overturns.any()},
        "areas": truth(True, pairs=pairs),
        "sample_agrees": of_sample(spectra_sample),
    }


def work(job: Any) -> tuple:
    table = pd.concat(map(pd.read_csv, job.input.shards)).sort_values(ORDER, ignore_index=True)
    return table, *main(job.params.settings, job.params.solver, table)


if __name__ == "__main__":
    run(snakemake, work)
