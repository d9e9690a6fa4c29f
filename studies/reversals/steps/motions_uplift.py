"""What uplift limits over the ensemble: ratios of the largest forces, with bands, and the cost.

Histories that overturn are counted; the forces are those of the others.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.peak_forces import (
    FORCES,
    GUIDED,
    MARGIN,
    PINNED,
    RIGID,
    bending,
    held,
    held_peaks,
    ratio_of,
    rocking_peaks,
    shear_after_uplift,
)
from steps.shared.spectrum import progress
from studies.reversals.subjects import unit
from topheavy import Cap, Column, RockingFrame, simulate
from topheavy.ground.synthetic.ensemble import Draw, first_draws
from topheavy.risk.resampling import interval, resampled
from topheavy.second import reference

STEPS = 60  # in a period of the held frame; a peak is off by 1.4e-3 at most
CLOSE = 1e-6  # relative: what the peaks of two solvers may differ by
ROCKS = 0.1  # of α: histories that rock this far are judged again

UNDRAWN = "its table has means of ratios, and the findings count single ones"


def cap_of(settings: dict) -> Cap:
    return Cap(settings["cap"]["span"], settings["cap"]["depth"] / 2.0)


def histories(draw: Draw, frames: list[RockingFrame], cap: Cap, settings: dict) -> list[dict]:
    """Return a row for each frame and intensity under one motion."""
    record, rows = draw.record(), []
    beside = held_peaks(frames, cap, record, settings["periods"], STEPS)
    levels = unit(frames[0].column) * np.array(settings["intensities"])
    scales = levels / record.peak_velocity
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


def summary(table: pd.DataFrame, settings: dict, boot: Mapping[str, Any]) -> pd.DataFrame:
    """Return mean ratios of the survivors that uplift, and shares that overturn, with bands."""
    rows = []
    for labels, cells in table.groupby(["family", "mass_ratio", "intensity"], sort=False):
        weights = resampled(len(cells), boot["resamples"], boot["seed"])
        stands = (cells.outcome == "rests").to_numpy(dtype=float)
        fell = (cells.outcome == "overturned").to_numpy(dtype=float)
        counted = weights @ stands
        for name in FORCES:
            for top, one in held(labels[1], settings["periods"]):
                ratio = np.where(stands > 0.0, cells[ratio_of(name, top, one)], 0.0)
                values = (weights @ ratio) / np.where(counted > 0.0, counted, np.nan)
                # A resample without a survivor has no mean, and is left out.
                low_high = interval(values[~np.isnan(values)], boot["confidence"])
                share = interval(weights @ fell, boot["confidence"])
                rows.append(
                    dict(zip(("family", "mass_ratio", "intensity"), labels, strict=True))
                    | {"force": name, "top": top, "held": one, "motions": len(cells)}
                    | {"survivors": int(stands.sum())}
                    | dict(zip(("ratio", "ratio_low", "ratio_high"), low_high, strict=True))
                    | dict(
                        zip(("overturned", "overturned_low", "overturned_high"), share, strict=True)
                    )
                    | {"rotation": cells.rotation.where(stands > 0.0).mean()}
                )
    return pd.DataFrame(rows)


def second_route(
    rocked: pd.DataFrame, chosen: list[Draw], cap: Cap, column: Column, settings: dict
) -> Finding:
    """Compare the peaks of the shortest motions under which a frame rocks with those of SciPy."""
    apart, motions = [], {tuple(draw.labels.values()): draw for draw in chosen}
    large = rocked[rocked.rotation > ROCKS].sort_values("samples", kind="stable")
    for row in large[: settings["checked_by_second_route"]].itertuples():
        record = motions[row.family, row.scenario, row.motion].record()
        scale = row.intensity * unit(column) / record.peak_velocity
        frame, scaled = RockingFrame(column, row.mass_ratio), record.scaled(scale)
        ours, other = (
            rocking_peaks(frame, cap, scaled, settings["points"], route)
            for route in (simulate, reference.simulate)
        )
        apart += [abs(ours.forces[name] / other.forces[name] - 1.0) for name in FORCES]
    return truth(
        bool(apart) and max(apart) < CLOSE,
        peaks=len(apart),
        largest_relative=float(max(apart)) if apart else None,
    )


def main(settings: dict, ensemble: dict) -> tuple:
    column, cap = Column(**settings["column"]), cap_of(settings)
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    chosen = first_draws(ensemble, settings["motions"])
    found = (histories(draw, frames, cap, settings) for draw in chosen)
    table = pd.DataFrame(row for of in progress(found, len(chosen), "motions") for row in of)
    bands = summary(table, settings, settings["bootstrap"])
    rocked = table[table.outcome == "rests"]
    beside = bands[(bands.held == RIGID) & (bands.top == PINNED)]
    ratios = rocked[[ratio_of(name, PINNED, RIGID) for name in FORCES]]
    findings = {
        "uplift_limits_totals": truth(
            len(rocked) > 0
            and bool((ratios < 1.0).all(axis=None))
            and (beside.ratio_high < 1.0).all(),
            largest=float(ratios.max(axis=None)),
            least=float(ratios.min(axis=None)),
            histories=len(table),
            survivors_that_uplift=len(rocked),
            overturned=int((table.outcome == "overturned").sum()),
            bending_moments={
                top: bending(rocked[ratio_of("bending_moment", top, RIGID)].dropna())
                for top in (PINNED, GUIDED)
            },
        ),
        "shear_is_at_most_that_of_uplift": truth(
            len(rocked) > 0 and (rocked.over_uplift < 1.0 + MARGIN).all(),
            margin=MARGIN,
            largest=rocked.over_uplift.max(),
        ),
        "uplift_second_route": second_route(rocked, chosen, cap, column, settings),
    }
    return bands, findings


def work(job: Any) -> tuple:
    return main(job.params.settings, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
