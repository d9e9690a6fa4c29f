"""What the published tables of the studies say about the findings that were drawn from them."""

import math
from collections.abc import Callable, Iterator
from itertools import combinations

import numpy as np
import pandas as pd

from steps.evidence_paper import Drawn, Table, rises

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


def mechanism_equivalence(table: Table) -> Drawn:
    rows = table("studies/mechanism_equivalence")
    off = rows.share_apart - rows.share_thinned
    yield "share_apart", "value", rows.share_apart.mean()
    yield "share_apart", "error", max(abs(off.mean()), math.sqrt((off**2).mean() / len(off)))
    for name in ("only_frame_overturns", "only_column_overturns"):
        yield "identical_response", name, rows[name].mean()
    largest = rows.lowest_change_largest.max()
    yield "column_is_never_safer_first", "largest", largest
    yield "column_is_never_safer_first", "holds", largest <= 0.0


def mechanism_verdicts(table: Table) -> Drawn:
    rows = table("studies/mechanism_verdicts")
    plastic, agrees = rows.contact == "plastic", rows.engine == rows.theory
    yield "same_verdicts", "holds", agrees.all()
    yield "same_verdicts", "pulses", plastic.sum()
    yield "same_verdicts", "share_plastic", agrees[plastic].mean()
    yield "same_verdicts", "share_bouncing", agrees[~plastic].mean()


def mechanism_rebounds(table: Table) -> Drawn:
    rows = table("studies/mechanism_rebounds")
    frames = rows[rows.mass_ratio > 0.0]
    plastic = frames[frames.plastic].difference.abs().max()
    yield "impact_at_the_new_pivots", "plastic_apart", plastic
    yield "maximum_restitution", "largest_of_soft", rows.difference.max()


def mechanism_dependence(table: Table) -> Drawn:
    rows = table("studies/mechanism_dependence")
    demand = rows[rows.varied == "mass_ratio"].rocking
    yield "heavier_needs_less", "holds", rises(-demand)
    yield "heavier_needs_less", "lightest", demand.iloc[0]
    yield "heavier_needs_less", "heaviest", demand.iloc[-1]
    yield "impact_asks_for_less_than_rocking", "holds", not (rows.impact > rows.rocking).any()


def mechanism_three_bodies(table: Table) -> Drawn:
    rows = table("studies/mechanism_three_bodies")
    yield "one_degree_of_freedom", "largest_over_alpha", rows.rotation_apart.max()
    yield "velocity_ratio", "largest", rows.ratio_apart.max()
    yield "same_forces", "largest_over_weight", rows.force_apart.max()


def mechanism_records(table: Table) -> Drawn:
    rows = table("studies/mechanism_records")
    stood = rows[rows.outcome != "overturned"]
    yield "stays_on_its_seats", "holds", not stood.pulls.any()


def mechanism_first_impacts(table: Table) -> Drawn:
    rows = table("studies/mechanism_first_impacts")
    limit, coarsest = rows[rows.step == 0.0], rows[rows.step == rows.step.max()]
    worst = limit.difference.abs().max()
    yield "largest", "value", worst
    yield "largest", "error", limit.uncertainty.max()
    yield "first_impact", "largest", worst
    yield "first_impact", "before_limit", coarsest.difference.abs().max()


def mechanism_slides(table: Table) -> Drawn:
    rows = table("studies/mechanism_slides")
    below = rows.friction < rows.tan
    between = ~below & (rows.friction < rows.needed)
    name = "slides_as_the_forces_say"
    yield name, "too_little", below.sum()
    yield name, "between", between.sum()
    yield name, "between_that_slide", rows.slides[between].sum()


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


def certainty_theorem(table: Table) -> Drawn:
    rows = table("studies/certainty_theorem")
    parts = {
        "linearised": rows.linearised & rows.proved,
        "exact": ~rows.linearised & rows.proved,
        "exact_open": ~rows.proved,
    }
    for name, part in parts.items():
        yield name, "motions", rows.motions[part].sum()
        yield name, "contradictions", rows.contradictions[part].sum()
        yield name, "holds", not rows.contradictions[part].any()


def certainty_lowest(table: Table) -> Drawn:
    rows = table("studies/certainty_lowest")
    confirmed = rows[rows["last"] < 1.0]
    yield "no_fall_is_found", "holds", confirmed.empty
    yield "no_fall_is_found", "apparent", len(rows)
    yield "no_fall_is_found", "confirmed", len(confirmed)
    yield "no_fall_is_found", "largest_apparent", 1.0 - rows.coarse.min()


def certainty_extensions(table: Table) -> Drawn:
    rows = table("studies/certainty_extensions")
    change = (rows.peak / rows.peak_without_vertical - 1.0).abs()
    yield "largest_change", "value", change.max()
    yield "largest_change", "median", change.median()
    yield "three_bodies", "histories", len(rows)
    yield "three_bodies", "impacts", rows.impacts.sum()
    yield "three_bodies", "largest", rows.routes_differ_by.max()


def certainty_records(table: Table) -> Drawn:
    rows = table("studies/certainty_records")
    frames = rows[rows.mass_ratio > 0.0]
    falls = rows.pivot_table(
        index=["record", "structure"], columns="mass_ratio", values="overturned", aggfunc="first"
    ).astype(bool)
    light, heavy = falls[0.0], falls.drop(columns=0.0)
    apart = sum(
        int((falls[heavier] & ~falls[lighter]).sum())
        for lighter, heavier in combinations(heavy.columns, 2)
    )
    yield "records", "holds", not frames.overturned.any()
    yield "records", "overturned", frames.overturned.sum()
    yield "records", "records", rows.record.nunique()
    yield "records", "frames", len(frames)
    yield "bare_columns_fall_first", "holds", not heavy[~light].to_numpy().any()
    yield "lighter_frames_fall_first", "holds", apart == 0
    asked = rows[rows.by_scipy.notna()]
    yield "second_route", "asked", len(asked)
    yield "second_route", "differ", (asked.by_scipy.astype(bool) != asked.overturned).sum()
    yield "napa", "value", rows.pgv[rows.record.str.startswith("napa")].max()


def certainty_restitution(table: Table) -> Drawn:
    rows = table("studies/certainty_restitution")
    pulses, less = (rows[rows.under == name] for name in ("pulses", "difference"))
    together = pulses[pulses.way == "both"]
    yield "lowest_rises_together", "holds", not together.falls.any()
    yield "lowest_rises_together", "compared", together.compared.sum()
    yield "lowest_rises_apart", "holds", not pulses.falls.any()
    yield "harms_range", "value", together.harms.max()
    yield "helps_range", "value", together.helps.max()
    joint = less.way.isin(["both", "scatter"])
    for name, part in (("together", less[joint]), ("apart", less[~joint])):
        yield f"probability_falls_{name}", "holds", (part.less_low > 0.0).all()
        yield f"probability_falls_{name}", "compared", len(part)
        yield f"probability_falls_{name}", "least", part.less_low.min()


def certainty_benefit(table: Table) -> Drawn:
    rows = table("studies/certainty_benefit")
    both, alone = (rows[rows.way == way] for way in ("both", "column alone"))
    lowest = alone[alone.factor == alone.factor.min()]
    yield "frame_is_safer", "holds", (both.less_low > 0.0).all()
    yield "remains", "holds", (alone.less_low > 0.0).all()
    yield "reverses", "holds", (lowest.less_high < 0.0).all()
    parts = {"frame_is_safer": both, "remains": alone, "reverses": lowest}
    for name, part in parts.items():
        yield name, "compared", len(part)
        yield name, "changes", part.to_dict("records")


def certainty_intensities(table: Table) -> Drawn:
    rows = table("studies/certainty_intensities")
    each = ["family", "structure", "measure", "level"]
    wide = rows.pivot_table(index=each, columns="support", values="fell")
    summed = wide.groupby(level=each[:2]).sum()
    sides = {
        "free_cap_helps": (wide.free - wide.bare, summed.free - summed.bare),
        "fixed_mass_harms": (wide.bare - wide.fixed, summed.bare - summed.fixed),
    }
    for name, (cells, sums) in sides.items():
        yield name, "holds", (sums < 0).all()
        yield name, "compared", len(cells)
        yield name, "differ", (cells != 0).sum()
        yield name, "exceptions", (cells > 0).sum()


OF_STUDIES: tuple[Callable[[Table], Drawn], ...] = (
    certainty_benefit,
    certainty_extensions,
    certainty_intensities,
    certainty_lowest,
    certainty_records,
    certainty_restitution,
    certainty_theorem,
    mechanism_dependence,
    mechanism_equivalence,
    mechanism_first_impacts,
    mechanism_rebounds,
    mechanism_records,
    mechanism_slides,
    mechanism_three_bodies,
    mechanism_verdicts,
    reversals_enough,
    reversals_motions,
    reversals_pulses,
    reversals_records,
    reversals_uplift,
    reversals_vase,
)
