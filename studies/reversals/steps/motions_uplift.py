"""What uplift limits over the ensemble: ratios of the largest forces, with bands, and the cost.

A motion is drawn anew with its histories on every frame. Histories that overturn are counted; the
forces are those of the others.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth
from steps.peak_forces import (
    FORCES,
    GUIDED,
    PINNED,
    RIGID,
    held,
    held_peaks,
    ratio_of,
    rocking_peaks,
)
from steps.spectrum import progress
from steps.uplift_limits import MARGIN, bending, shear_after_uplift
from studies.reversals.steps.motions_vase import factors, some
from topheavy import Cap, Column, RockingFrame, reference, simulate
from topheavy.fragility.resampling import interval, resampled
from topheavy.synthetic.ensemble import Draw

CLOSE = 1e-6  # relative: what the peaks of two solvers may differ by
ROCKS = 0.1  # of α: histories that rock this far are judged again
STEPS = 60  # in a period of the held frame; a peak is off by 1.4e-3 at most


def histories(draw: Draw, frames: list[RockingFrame], cap: Cap, case: dict) -> list[dict]:
    """Return a row for each frame and intensity under one motion."""
    record, rows = draw.record(), []
    beside = held_peaks(frames, cap, record, case["periods"], STEPS)
    scales = factors(frames[0].column, record, np.array(case["intensities"]))
    for frame, fixed in zip(frames, beside, strict=True):
        for intensity, factor in zip(case["intensities"], scales, strict=True):
            found = rocking_peaks(frame, cap, record.scaled(factor), case["points"])
            peak = factor * record.peak_acceleration
            row = draw.labels | {
                "mass_ratio": frame.mass_ratio,
                "intensity": intensity,
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


def summary(table: pd.DataFrame, case: dict, boot: Mapping[str, Any]) -> pd.DataFrame:
    """Return mean ratios of the survivors that uplift, and shares that overturn, with bands."""
    rows = []
    for labels, cells in table.groupby(["family", "mass_ratio", "intensity"], sort=False):
        weights = resampled(len(cells), boot["resamples"], boot["seed"])
        stands = (cells.outcome == "rests").to_numpy(dtype=float)
        fell = (cells.outcome == "overturned").to_numpy(dtype=float)
        counted = weights @ stands
        for name in FORCES:
            for top, one in held(labels[1], case["periods"]):
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
    rocked: pd.DataFrame, chosen: list[Draw], cap: Cap, column: Column, case: dict
) -> Finding:
    """Compare the peaks of the shortest motions under which a frame rocks with those of SciPy."""
    apart, records = [], {tuple(draw.labels.values()): draw.record() for draw in chosen}
    large = rocked[rocked.rotation > ROCKS]
    runs = [(records[row.family, row.scenario, row.motion], row) for row in large.itertuples()]
    runs.sort(key=lambda run: run[0].acceleration.size)
    for record, row in runs[: case["checked_by_second_route"]]:
        (scale,) = factors(column, record, np.array([row.intensity]))
        frame, scaled = RockingFrame(column, row.mass_ratio), record.scaled(scale)
        ours, other = (
            rocking_peaks(frame, cap, scaled, case["points"], route)
            for route in (simulate, reference.simulate)
        )
        apart += [abs(ours.forces[name] / other.forces[name] - 1.0) for name in FORCES]
    return truth(
        bool(apart) and max(apart) < CLOSE,
        peaks=len(apart),
        largest_relative=float(max(apart)) if apart else None,
    )


def main(case: dict, ensemble: dict) -> tuple:
    column = Column(**case["column"])
    cap = Cap(case["cap"]["span"], case["cap"]["depth"] / 2.0)
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    chosen = some(ensemble, case["motions"])
    found = (histories(draw, frames, cap, case) for draw in chosen)
    table = pd.DataFrame(row for rows in progress(found, len(chosen), "motions") for row in rows)
    bands = summary(table, case, case["bootstrap"])
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
        "uplift_second_route": second_route(rocked, chosen, cap, column, case),
    }
    return bands, findings


def work(job: Any) -> tuple:
    return main(job.params.case, job.params.ensemble)


if __name__ == "__main__":
    run(snakemake, work)
