"""One shard of the histories in which uplift limits forces: every n-th motion, on every frame."""

from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import run
from steps.shared.peak_forces import FORCES, held_peaks, ratio_of, rocking_peaks, shear_after_uplift
from steps.shared.spectrum import progress, shard_of
from studies.reversals.steps.motions_vase import factors
from topheavy import Cap, Column, RockingFrame
from topheavy.synthetic.ensemble import Draw, first_draws

STEPS = 60  # in a period of the held frame; a peak is off by 1.4e-3 at most


def cap_of(settings: dict) -> Cap:
    return Cap(settings["cap"]["span"], settings["cap"]["depth"] / 2.0)


def histories(draw: Draw, frames: list[RockingFrame], cap: Cap, settings: dict) -> list[dict]:
    """Return a row for each frame and intensity under one motion."""
    record, rows = draw.record(), []
    beside = held_peaks(frames, cap, record, settings["periods"], STEPS)
    scales = factors(frames[0].column, record, np.array(settings["intensities"]))
    scaled = [record.scaled(factor) for factor in scales]
    for frame, fixed in zip(frames, beside, strict=True):
        for intensity, factor, motion in zip(settings["intensities"], scales, scaled, strict=True):
            found = rocking_peaks(frame, cap, motion, settings["points"])
            peak = factor * record.peak_acceleration
            row = draw.labels | {
                "mass_ratio": frame.mass_ratio,
                "intensity": intensity,
                "samples": record.acceleration.size,
                "outcome": found.outcome,
                "rotation": found.rotation,
                "impulse": found.impulse,
                "error": found.error,
                "over_uplift": found.forces["base_shear"] / shear_after_uplift(frame, peak),
            }
            for name in FORCES:
                for one, forces in fixed.items():
                    row[ratio_of(name, *one)] = found.forces[name] / (forces[name] * factor)
            rows.append(row)
    return rows


def main(settings: dict, ensemble: dict, shard: str) -> pd.DataFrame:
    column, cap = Column(**settings["column"]), cap_of(settings)
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    mine = shard_of(first_draws(ensemble, settings["motions"]), shard)
    found = (histories(draw, frames, cap, settings) for draw in mine)
    return pd.DataFrame(row for rows in progress(found, len(mine), "motions") for row in rows)


def work(job: Any) -> pd.DataFrame:
    return main(job.params.settings, job.params.ensemble, job.wildcards.scatteritem)


if __name__ == "__main__":
    run(snakemake, work)
