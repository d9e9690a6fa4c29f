"""√r of Eq. (25) over slenderness and mass ratio, against Housner's and the limit cos 2α."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from topheavy import Column, RockingFrame
from topheavy.bodies.structures import largest_slenderness


def column(degrees: float) -> Column:
    alpha = math.radians(degrees)
    return Column(math.sin(alpha), math.cos(alpha))


def main(settings: dict) -> tuple[pd.DataFrame, list[dict], dict]:
    slendernesses = np.linspace(0.0, settings["largest_slenderness"], settings["points"])[1:]
    over_slenderness = pd.DataFrame(
        {
            "slenderness_deg": a,
            "mass_ratio": g,
            "restitution": RockingFrame(column(a), g).restitution,
        }
        for g in settings["mass_ratios"]
        for a in slendernesses
    )
    gammas = np.concatenate([np.linspace(0.0, 10.0, 201), [math.inf]])
    over_mass_ratio = [
        {
            "slenderness_deg": a,
            "mass_ratio": g,
            "restitution": RockingFrame(column(a), g).restitution,
        }
        for a in settings["slendernesses"]
        for g in gammas
    ]
    rounding = float(np.finfo(float).eps)
    drawn = findings(over_slenderness)
    alone = over_slenderness.slenderness_deg.map(lambda a: column(a).restitution)
    heavy = over_slenderness.mass_ratio > 0.0
    least = (alone - over_slenderness.restitution)[heavy].min()  # more digits than in the table
    smaller = drawn["smaller_than_solitary"].with_evidence(least_difference=least)
    return (
        over_slenderness,
        over_mass_ratio,
        drawn
        | {
            "smaller_than_solitary": smaller,
            "solitary_column_recovered": truth(
                all(
                    RockingFrame(column(a), 0.0).restitution == column(a).restitution
                    for a in slendernesses
                )
            ),
            "largest_slenderness_of_column": value(
                math.degrees(largest_slenderness(0.0)), 90 * rounding, "°"
            ),
            "largest_slenderness_of_frame": value(
                math.degrees(largest_slenderness(math.inf)), 90 * rounding, "°"
            ),
        },
    )


def findings(restitution_over_slenderness: pd.DataFrame) -> dict[str, Finding]:
    """Return whether √r of the frames is smaller than that of their columns, from its table."""
    table = restitution_over_slenderness
    alone = table[table.mass_ratio == 0.0].set_index("slenderness_deg").restitution
    heavy = table[table.mass_ratio > 0.0]
    solitary = heavy.slenderness_deg.map(alone)
    smaller = solitary - heavy.restitution
    more_lost = (heavy.restitution**2 < solitary**2)[heavy.restitution >= 0.0]
    counter = heavy.slenderness_deg[heavy.restitution**2 > solitary**2]
    return {
        "smaller_than_solitary": truth(smaller.min() > 0.0, cells=len(smaller)),
        "energy_loss": truth(
            len(more_lost) and all(more_lost),
            cells_that_rock=len(more_lost),
            least_slenderness_against_deg=min(counter, default=math.nan),
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
