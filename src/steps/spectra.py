"""Gather the overturning spectra from their shards, and compare frames of different γ.

The rule tests whether the minimum overturning amplitude rises with γ at every frequency. It also
computes the share of the frequency–amplitude plane on which only the heavier frame overturns.
"""

from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run, truth
from steps.spectra_compared import ORDER, Spectra, finite


def main(case: dict, solver: dict, table: pd.DataFrame) -> tuple[list[dict], dict]:
    spectra = Spectra(case, table)
    rises = spectra.lowest_rises()
    areas = [row for light, heavy in case["pairs"] for row in spectra.areas(light, heavy)]
    width, place, light, heavy, amplitude = spectra.counterexample(pairwise(case["mass_ratios"]))
    verdicts = [spectra.judged(place, g, amplitude, solver["tightened"]) for g in (light, heavy)]
    if verdicts != [[False] * 2, [True] * 2]:
        raise ArithmeticError(f"γ = {light}, {heavy} at {amplitude:.6g}: not a counterexample")
    exact = [row for row in areas if not row["linearised"]]

    def share(word: str, pair: int) -> list[float]:
        lighter = finite(case["pairs"][pair][0])
        return [row[word] for row in exact if row["lighter"] == lighter]

    findings = {
        "lowest_amplitude_rises_with_mass": rises,
        "heavier_is_more_stable": truth(
            not any(row["only_heavier_overturns"] for row in areas),
            holds_when=rises.holds,
            condition="what counts is the lowest amplitude of a pulse that overturns",
            width_of_band=width,
            amplitude_over_uplift=amplitude,
            survives=finite(light),
            overturns=finite(heavy),
            **place.described(),
        ),
        "areas": truth(
            True,
            pairs=[
                {
                    "lighter": finite(case["pairs"][pair][0]),
                    "heavier": finite(case["pairs"][pair][1]),
                    "only_lighter_overturns": float(np.mean(share("only_lighter_overturns", pair))),
                    "only_heavier_overturns": float(np.mean(share("only_heavier_overturns", pair))),
                    "largest_only_heavier": max(share("only_heavier_overturns", pair)),
                }
                for pair in range(len(case["pairs"]))
            ],
        ),
        "sample_agrees": spectra.sample(
            case["sample"]["points"], case["sample"]["seed"], solver["tightened"]
        ),
    }
    return areas, findings


def work(job: Any) -> tuple:
    table = pd.concat(map(pd.read_csv, job.input.shards)).sort_values(ORDER, ignore_index=True)
    return table, *main(job.params.case, job.params.solver, table)


if __name__ == "__main__":
    run(snakemake, work)
