"""√r of Eq. (25) over slenderness and mass ratio, against Housner's and the limit cos 2α."""

import math

import numpy as np

from replication.workbench import run, truth, value
from topheavy import Column, RockingFrame
from topheavy.structures import largest_slenderness


def column(degrees: float) -> Column:
    alpha = math.radians(degrees)
    return Column(math.sin(alpha), math.cos(alpha))


def main(case: dict) -> tuple[dict, dict, dict]:
    slendernesses = np.linspace(0.0, case["largest_slenderness"], case["points"])[1:]
    over_slenderness = [
        {
            "slenderness_deg": a,
            "mass_ratio": g,
            "restitution": RockingFrame(column(a), g).restitution,
        }
        for g in case["mass_ratios"]
        for a in slendernesses
    ]
    gammas = np.concatenate([np.linspace(0.0, 10.0, 201), [math.inf]])
    over_mass_ratio = [
        {
            "slenderness_deg": a,
            "mass_ratio": g,
            "restitution": RockingFrame(column(a), g).restitution,
        }
        for a in case["slendernesses"]
        for g in gammas
    ]
    heavy = [row for row in over_slenderness if row["mass_ratio"] > 0.0]
    solitary = {a: column(a).restitution for a in slendernesses}
    smaller = [solitary[row["slenderness_deg"]] - row["restitution"] for row in heavy]
    more_lost = [
        row["restitution"] ** 2 < solitary[row["slenderness_deg"]] ** 2
        for row in heavy
        if row["restitution"] >= 0.0
    ]
    counter = [
        row["slenderness_deg"]
        for row in heavy
        if row["restitution"] ** 2 > solitary[row["slenderness_deg"]] ** 2
    ]
    rounding = float(np.finfo(float).eps)
    findings = {
        "smaller_than_solitary": truth(
            min(smaller) > 0.0, cells=len(smaller), least_difference=min(smaller)
        ),
        "energy_loss": truth(
            more_lost and all(more_lost),
            cells_that_rock=len(more_lost),
            least_slenderness_against_deg=min(counter, default=math.nan),
        ),
        "solitary_column_recovered": truth(
            all(RockingFrame(column(a), 0.0).restitution == r for a, r in solitary.items())
        ),
        "massless_columns": truth(
            all(
                math.isclose(
                    RockingFrame(column(a), math.inf).restitution,
                    math.cos(2 * math.radians(a)),
                    rel_tol=1e-12,
                    abs_tol=1e-12,
                )
                for a in slendernesses
            )
        ),
        "largest_slenderness_of_column": value(
            math.degrees(largest_slenderness(0.0)), 90 * rounding, "°"
        ),
        "largest_slenderness_of_frame": value(
            math.degrees(largest_slenderness(math.inf)), 90 * rounding, "°"
        ),
    }
    return over_slenderness, over_mass_ratio, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case))
