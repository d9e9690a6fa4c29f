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
    ratio_of,
    rocking_peaks,
)
from studies.reversals.steps.motions_uplift_shard import cap_of
from studies.reversals.steps.motions_vase import factors
from topheavy import Cap, Column, RockingFrame, reference, simulate
from topheavy.fragility.resampling import interval, resampled
from topheavy.synthetic.ensemble import Draw, first_draws

CLOSE = 1e-6  # relative: what the peaks of two solvers may differ by
ROCKS = 0.1  # of α: histories that rock this far are judged again

UNDRAWN = "its table has means of ratios, and the findings count single ones"


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
        (scale,) = factors(column, record, np.array([row.intensity]))
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


def main(settings: dict, ensemble: dict, shards: list[pd.DataFrame]) -> tuple:
    column, cap = Column(**settings["column"]), cap_of(settings)
    keys, chosen = ["family", "scenario", "motion"], first_draws(ensemble, settings["motions"])
    of_family = {family: place for place, family in enumerate(ensemble["families"])}
    table = pd.concat(shards).sort_values(
        keys, kind="stable", key=lambda key: key.map(of_family) if key.name == "family" else key
    )
    if len(table) != (
        wanted := len(chosen) * len(settings["mass_ratios"]) * len(settings["intensities"])
    ):
        raise ValueError(
            f"the shards have {len(table)} histories; expected {wanted}: a shard is incomplete, "
            "delete it and run again"
        )
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
    return main(job.params.settings, job.params.ensemble, [*map(pd.read_csv, job.input.shards)])


if __name__ == "__main__":
    run(snakemake, work)
