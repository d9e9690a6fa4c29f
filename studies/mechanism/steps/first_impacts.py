"""Does a frame in the engine fall back in the time that Eq. (23) gives?"""

import math
from itertools import pairwise

import pandas as pd

from replication.workbench import Finding, truth
from studies.mechanism.steps.engine import run
from studies.mechanism.steps.rigs import crossing, experiment, models, rig_of
from topheavy import Cap, simulate

CLOSE = 0.01  # of the time of the first impact


def main(settings: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    """Return times of the first impact by time step, and their limit, beside the theory.

    The contacts harden with the steps. The limit is that of an error of first order, and its
    uncertainty what it moved by the last halving.
    """
    rows = []
    steps = sorted(settings["time_steps"], reverse=True)
    for model in models(settings["frames"], structures, caps):
        for lean in settings["leans"]:
            rotation = lean * model.frame.slenderness
            theory = float(simulate(model.frame, rotation=rotation, samples=2).impacts[0])
            rigs = [rig_of(model, step) for step in steps]
            found = [
                crossing(run(rig, rotation=rotation, duration=1.2 * theory))[1] for rig in rigs
            ]
            limits = [2.0 * fine - coarse for coarse, fine in pairwise(found)]
            spread = abs(limits[-1] - limits[-2]) / theory
            for step, time, error in zip(
                (*steps, 0.0), (*found, limits[-1]), (*[math.nan] * len(steps), spread), strict=True
            ):
                rows.append(
                    {
                        "structure": model.name,
                        "mass_ratio": model.frame.mass_ratio,
                        "lean": lean,
                        "step": step,
                        "difference": time / theory - 1.0,
                        "uncertainty": error,
                    }
                )
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(mechanism_first_impacts: pd.DataFrame) -> dict[str, Finding]:
    """Return how far first impacts are from Eq. (23), from the table of their times."""
    table = mechanism_first_impacts
    limit = table[table.step == 0.0]
    worst = limit.difference.abs().max()
    return {
        "first_impact": truth(
            worst < CLOSE,
            largest=worst,
            uncertainty=limit.uncertainty.max(),
            releases=len(limit),
            before_limit=table[table.step == table.step.max()].difference.abs().max(),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
