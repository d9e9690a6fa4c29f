"""What the published tables of the studies say about the findings that were drawn from them."""

from collections.abc import Callable, Iterator
from itertools import combinations

import numpy as np
import pandas as pd

from steps.redrawn_paper import Drawn, Table

# Study reversals ---------------------------------------------------------------------------------


def reversals_pulses(table: Table) -> Drawn:
    areas = table("studies/reversals_areas")
    ends = areas[(areas.lighter == 0) & (areas.heavier == "infinite")]
    for name in ("helps", "harms"):
        fine, two, four = (ends[name + end].mean() for end in ("", "_by_two", "_by_four"))
        yield name, "value", fine
        yield name, "error", 2.0 * max(abs(fine - two) / 3.0, abs(fine - four) / 15.0)
    yield "most_harm", "value", areas.harms.max()
    harmed = areas.groupby(["lighter", "heavier"]).harms.sum()
    yield "at_every_pair", "holds", (harmed > 0.0).all()
    why = table("studies/reversals_why").query("heavier == 'infinite'")
    harm = why.groupby("change").harms.mean()
    yield "size_harms", "holds", harm["size"] > 10.0 * harm["restitution"]
    yield "restitution_spares", "holds", harm["both"] < harm["size"]


def reversals_enough(table: Table) -> Drawn:
    rows = table("studies/reversals_enough")
    second = rows.frequency_ratio.isin(sorted(rows.frequency_ratio.unique())[::2])
    halves = [part.groupby("share").mass_ratio.median() for part in (rows[second], rows[~second])]
    for share, ratio in rows.groupby("share").mass_ratio.median().items():
        name = f"amplitude_at_{100 * share:.0f}_percent"
        yield name, "value", ratio
        yield name, "error", max(abs(ratio - half[share]) for half in halves)


def reversals_motions(table: Table) -> Drawn:
    pairs = table("studies/reversals_pairs")
    yield "heavier_is_safer", "holds", not pairs.only_heavier.any()
    yield "heavier_is_safer", "cells", pairs.cells.sum()
    yield "heavier_is_safer", "least_reversed", pairs.reversed.min()
    yield "heavier_is_safer", "most_reversed", pairs.reversed.max()
    yield "probability_is_lower", "holds", (pairs.reversed_high < 0.5).all()
    yield "probability_is_lower", "largest_upper_end", pairs.reversed_high.max()
    medians = table("studies/reversals_medians")
    frames = medians[medians.as_large_as == 0].set_index(["family", "structure", "mass_ratio"])
    alone = medians[medians.as_large_as > 0]
    excess = [
        frames["median"][row.family, row.structure, row.as_large_as] / row.median - 1.0
        for row in alone.itertuples()
    ]
    yield "gain_is_that_of_size", "beyond", [{"excess": one} for one in excess]
    curves = table("studies/reversals_fragility")
    yield "misfit", "value", (curves.probability - curves.fitted).abs().max()


def reversals_records(table: Table) -> Drawn:
    rows = table("studies/reversals_records")
    letters = {key: np.array([*"".join(part.outcomes)]) for key, part in _by_frame(rows)}
    counts = []
    for record in rows.record.unique():
        for light, heavy in combinations(rows.mass_ratio.unique(), 2):
            one, other = letters[record, light], letters[record, heavy]
            falls = ((one == "f") & (other == "s")).sum(), ((one == "s") & (other == "f")).sum()
            counts.append((*falls, ((one != "?") & (other != "?")).sum()))
    only_lighter, only_heavier, compared = np.transpose(counts)
    yield "heavier_is_safer", "only_lighter", only_lighter.sum()
    yield "heavier_is_safer", "only_heavier", only_heavier.sum()
    yield "heavier_is_safer", "compared", compared.sum()
    yield "heavier_is_safer", "holds", not only_heavier.any()
    yield "fewer_reversals", "holds", (only_heavier < only_lighter).all()
    yield "cells_that_can_be_told", "not_told", rows.outcomes.str.count(r"\?").sum()


def _by_frame(rows: pd.DataFrame) -> Iterator[tuple[tuple, pd.DataFrame]]:
    """Yield the rows of each record and γ, all in the same order of slenderness and size."""
    yield from rows.sort_values(["slenderness_deg", "size"]).groupby(["record", "mass_ratio"])


# Study mechanism ---------------------------------------------------------------------------------


def reversals_vase(table: Table) -> Drawn:
    rows = table("studies/reversals_vase_ranks")
    fixed, free = (rows[rows.structure == name] for name in ("fixed", "free"))
    lowers, raises = "fixed_mass_lowers_the_capacity", "free_mass_raises_the_capacity"
    yield lowers, "holds", (fixed.over_bare_high < 1.0).all()
    yield raises, "holds", (free.over_bare_low > 1.0).all()
    for name, ours in ((lowers, fixed), (raises, free)):
        yield name, "least", ours.over_bare.min()
        yield name, "largest", ours.over_bare.max()
    yield "every_motion", "holds", not (fixed.later.any() or free.sooner.any())
    yield "every_motion", "fixed_later", fixed.later.max()
    yield "every_motion", "free_sooner", free.sooner.max()


def reversals_uplift(table: Table) -> Drawn:
    rows = table("studies/reversals_uplift")
    cells = rows[(rows.force == "base_shear") & (rows.held == "rigid") & (rows.top == "pinned")]
    name = "uplift_limits_totals"
    yield name, "histories", cells.motions.sum()
    yield name, "survivors_that_uplift", cells.survivors.sum()


# Study certainty ---------------------------------------------------------------------------------


OF_STUDIES: tuple[Callable[[Table], Drawn], ...] = (
    reversals_enough,
    reversals_motions,
    reversals_pulses,
    reversals_records,
    reversals_uplift,
    reversals_vase,
)
