"""What the published tables of the paper say about the findings that were drawn from them."""

import math
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from steps import (
    allen_errors,
    allen_overturning,
    equations,
    heavier,
    moment_rotation,
    negative_stiffness,
    trilith,
    trilith_states,
)

Table: TypeAlias = Callable[[str], pd.DataFrame]
Drawn: TypeAlias = Iterator[tuple[str, str, Any]]
"""A finding, one of its entries, and this entry by the table."""


def rises(values: pd.Series) -> bool:
    """Return whether each value is larger than the one before."""
    return bool((np.diff(values) > 0.0).all())


def mass_ratio(table: Table) -> Drawn:
    rows = table("mass_ratio").set_index("mass_ratio")
    yield "limit_of_frequency_ratio", "value", rows.frequency_ratio[math.inf]
    yield "limit_of_size_ratio", "value", rows.size_ratio[math.inf]
    yield "gain_at_mass_ratio_one", "value", rows.share_of_size_gain[1.0]
    yield "heavier_is_larger", "holds", rises(rows.size_ratio)


def spectra(table: Table) -> Drawn:
    rows = table("spectra_areas")
    yield "heavier_is_more_stable", "holds", not rows.only_heavier_overturns.any()
    exact = rows[~rows.linearised].groupby("lighter", sort=False)
    names = ["only_lighter_overturns", "only_heavier_overturns"]
    yield (
        "areas",
        "pairs",
        [
            {name: pair[name].mean() for name in names}
            | {"largest_only_heavier": pair.only_heavier_overturns.max()}
            for _, pair in exact
        ],
    )


def restitution(table: Table) -> Drawn:
    rows = table("restitution_over_slenderness")
    alone = rows[rows.mass_ratio == 0.0].set_index("slenderness_deg").restitution
    heavy = rows[rows.mass_ratio > 0.0]
    solitary = heavy.slenderness_deg.map(alone)
    yield "smaller_than_solitary", "holds", (heavy.restitution < solitary).all()
    yield "smaller_than_solitary", "cells", len(heavy)
    rocks = heavy.restitution >= 0.0
    loses = heavy.restitution**2 < solitary**2
    yield "energy_loss", "holds", bool(rocks.any()) and loses[rocks].all()
    yield "energy_loss", "cells_that_rock", rocks.sum()
    against = heavy.slenderness_deg[heavy.restitution**2 > solitary**2]
    yield "energy_loss", "least_slenderness_against_deg", against.min()


def uplift_limits(table: Table) -> Drawn:
    slopes = table("uplift_slopes").dropna()
    yield "slope_by_three_bodies", "frames", len(slopes)
    ratios = table("uplift_ratios")
    rigid = ratios[ratios.held == "rigid"]
    totals = rigid[rigid.force != "bending_moment"]
    cantilevers = rigid[rigid.top == "pinned"]
    limited = "uplift_limits_forces"
    yield limited, "holds", ratios.largest.max() < 1.0
    yield limited, "holds_when", max(totals.largest.max(), cantilevers.largest.max()) < 1.0
    for force, rows in totals.groupby("force"):
        yield limited, f"{force}_least", rows.least.min()
        yield limited, f"{force}_largest", rows.largest.max()
    bending, ends = {}, {"least": "min", "largest": "max"}
    for top, rows in rigid[rigid.force == "bending_moment"].groupby("top"):
        stand = rows.histories - rows.overturned
        not_lower = round(float(((1.0 - rows.lower) * stand).sum()))
        bending[top] = {"histories": int(stand.sum()), "not_lower": not_lower}
        bending[top] |= {end: float(rows[end].agg(how)) for end, how in ends.items()}
    yield limited, "bending_moments", bending
    cells = cantilevers[cantilevers.force == "base_shear"]
    fell = cells.overturned.sum()
    for name in (limited, "uplift_is_beneficial"):
        yield name, "histories", cells.histories.sum()
        yield name, "overturned", fell
    yield "uplift_is_beneficial", "holds", fell == 0 and ratios.largest.max() < 1.0
    yield "uplift_is_beneficial", "holds_when", cells.largest.max() < 1.0


def vase(table: Table) -> Drawn:
    broken = table("vase_exceptions")
    asked = {"fixed_mass_always_lowers": ["fixed"], "frame_always_raises": ["free"]}
    for name, structures in (asked | {"support_decides": ["fixed", "free"]}).items():
        ours = broken[broken.structure.isin(structures)]
        yield name, "exceptions", len(ours)
        yield name, "exceptions_under_records", (ours.kind == "record").sum()
        yield name, "holds", ours.empty
    fresh = broken[broken.kind == "fresh"].frequency_ratio
    yield "condition_on_a_fresh_grid", "exceptions_beyond", sorted(fresh)
    yield "second_route", "exceptions", len(broken)
    rows = table("vase")
    alone = rows.structure == "bare"
    portals = rows[(rows.structure == "portal") & (rows["shape"] == rows["shape"][0])]
    wider = portals.slenderness_deg > rows.slenderness_deg[alone].iloc[0]
    yield "portal_has_a_wider_base", "holds", wider.all()
    yield "portal_has_a_wider_base", "minimum_overturning_g", list(portals.minimum_overturning)
    at = ["mass_ratio", "shape"]
    frames = rows[rows.structure == "free"]
    beside = rows[rows.structure == "portal"].merge(frames, on=at, suffixes=("", "_free"))
    over = beside.minimum_overturning / beside.minimum_overturning_free
    yield "portal_overturns_last", "holds", (over > 1.0).all()
    yield "portal_overturns_last", "compared", len(over)
    yield "portal_overturns_last", "least", over.min()
    yield "portal_overturns_last", "largest", over.max()
    single = table("vase_shares").dropna(subset="shapley_value")
    for worth, found in single.groupby("worth"):
        shares = found.groupby("taken_from_the_frame").share_of_gain
        ends = {name: [part.mean(), part.min(), part.max()] for name, part in shares}
        yield "shares_of_the_gain", worth, ends


OF_PAPER: tuple[Callable[[Table], Drawn], ...] = (
    mass_ratio,
    restitution,
    spectra,
    uplift_limits,
    vase,
)

SOURCES = {
    "allen_errors": allen_errors.findings,
    "allen_overturning": allen_overturning.findings,
    "equations": equations.findings,
    "heavier": heavier.findings,
    "moment_rotation": moment_rotation.findings,
    "negative_stiffness": negative_stiffness.findings,
    "trilith": trilith.findings,
    "trilith_states": trilith_states.findings,
}
"""Which functions draw the findings of the paper's rules from their tables."""

UNDRAWN = {
    "allen_histories": "peaks of histories, of which no table is published",
    "rocking_spectra": "its table has a row for each record and structure",
    "scale_effects": "two outcomes",
    "spectra_dimensional": "one amplitude, of the spectra",
    "stability": "rankings, which have no table",
    "statements": "single statements, which have no table",
    "verification": "a sample that other solvers judge",
}
"""Why no published table determines the findings of the other rules."""
