"""Forces of columns and frames that rock, beside rigid ones that are clamped against uplift.

Clamped columns are fixed at their bases and pinned to the cap beam: they are cantilevers.
"""

import math
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from replication.step import check, grid, run, truth
from steps.shared import plain
from steps.shared.cases import cap_of, pulse_on
from steps.shared.histories import history
from topheavy import Cap, Column, Pulse, RockingFrame, simulate
from topheavy.forces.members import base_shear_slope, clamped_forces, largest_forces

FORCES = ("base_shear", "overturning_moment", "bending_moment")
SEED = 2014  # seed of the sample of histories that the plain solver computes again
CLOSE = 1e-3  # relative difference of the peaks of two solvers
HALVED = 5e-3  # relative change of a peak with half as many samples


def peaks(
    frame: RockingFrame, cap: Cap, pulse: Pulse, points: int, solver: Callable = simulate
) -> tuple[str, np.ndarray]:
    """Return the outcome of a history, and its largest `FORCES` over the weight.

    The forces are NaN if the frame overturns.
    """
    response = simulate(frame, pulse, samples=2)
    if response.overturned:
        return response.outcome, np.full(len(FORCES), math.nan)
    course = history(frame, pulse, response, points, solver)
    fine, coarse = largest_forces(frame, cap, course.rotation, course.velocity, course.ground)
    check(
        bool(np.allclose(coarse, fine, rtol=HALVED)),
        f"half as many points change the forces {fine} to {coarse}: {frame} under {pulse}",
    )
    return response.outcome, fine


def compute(settings: dict, column: dict) -> list[dict]:
    """Return the largest forces of each history, normalised by those of the clamped rigid frame."""
    base, cap = Column(**column), cap_of(settings["cap"])
    shapes, ratios = settings["shapes"], map(float, grid(settings["frequency_ratios"]))
    cells = product(shapes, ratios, settings["mass_ratios"], settings["amplitudes"])
    rows, survivors = [], []
    for shape, ratio, gamma, amplitude in cells:
        frame = RockingFrame(base, gamma)
        level, slope = frame.uplift_acceleration, base_shear_slope(frame)
        pulse = pulse_on(base, shape, ratio, amplitude)
        outcome, forces = peaks(frame, cap, pulse, settings["points"])
        clamped = clamped_forces(frame, cap, pulse)
        rows.append(
            {"shape": shape, "frequency_ratio": ratio, "mass_ratio": gamma, "outcome": outcome}
            | {"peak_acceleration": pulse.amplitude, "uplift_acceleration": level}
            | {"shear_after_uplift": level + slope * (pulse.amplitude - level)}
            | {"base_shear": forces[0]}
            | {f"{n}_over_clamped": forces[i] / clamped[i] for i, n in enumerate(FORCES)}
        )
        if outcome != "overturned":
            survivors.append((frame, pulse, forces))
    sample = np.random.default_rng(SEED).permutation(len(survivors))[: settings["sample"]]
    for frame, pulse, forces in (survivors[number] for number in sample):
        _, repeated = peaks(frame, cap, pulse, settings["points"], plain.simulate)
        check(
            bool(np.allclose(repeated, forces, rtol=CLOSE)),
            f"the plain solver has the forces {repeated}, not {forces}: {frame} under {pulse}",
        )
    return rows


def findings(uplift: pd.DataFrame) -> dict[str, Any]:
    """Return whether all forces, and the base shear, are lower than those of the clamped frame."""
    survivors = uplift[uplift.outcome != "overturned"]
    largest = survivors[[f"{name}_over_clamped" for name in FORCES]].max()
    base_shear, overturned = largest["base_shear_over_clamped"], len(uplift) - len(survivors)
    evidence = {"histories": len(uplift), "overturned": overturned}
    return {
        "uplift_limits_forces": truth(
            overturned == 0 and largest.max() < 1.0,
            holds_when=largest.max() < 1.0,
            condition="the frame survives, and is compared with a rigid one that is clamped "
            "against uplift, whose columns are cantilevers",
            **evidence,
            base_shear_largest=base_shear,
        ),
        "uplift_is_beneficial": truth(
            overturned == 0 and base_shear < 1.0,
            holds_when=base_shear < 1.0,
            condition="the frame survives; the benefit is a lower base shear than that of a rigid "
            "frame clamped against uplift",
            **evidence,
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
