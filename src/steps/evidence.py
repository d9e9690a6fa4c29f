"""The findings that the published tables determine, computed again from these tables alone."""

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from replication.findings import Findings

DIGITS = {"rel_tol": 1e-6}  # of what is computed from tables of nine digits
DIGITS_OF_ERROR = {"rel_tol": 0.06}  # errors are published with two digits

Table: TypeAlias = Callable[[str], pd.DataFrame]
Drawn: TypeAlias = Iterator[tuple[str, str, Any]]
"""A finding, one of its entries, and this entry by the table."""


def evidence(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the findings that do not follow from their tables."""

    def table(name: str) -> pd.DataFrame:
        return pd.read_csv(folder / f"{name}.csv")

    for rule in SOURCES.keys() & findings.keys():
        for name, key, expected in SOURCES[rule](table):
            finding = findings[rule].by_name.get(name)
            found = finding.entries.get(key) if finding else None
            if not same(found, expected, DIGITS_OF_ERROR if key == "error" else DIGITS):
                yield (
                    f"findings/{rule}.json: {name}.{key} is {found}, and {expected} by the "
                    "published table that it was drawn from"
                )


def same(found: Any, expected: Any, digits: Mapping[str, float]) -> bool:
    """Whether a finding's entry is the expected one; of a mapping, the keys that are expected."""
    if isinstance(expected, Mapping):
        return isinstance(found, Mapping) and all(
            same(found.get(key), value, digits) for key, value in expected.items()
        )
    if isinstance(expected, list):
        return (
            isinstance(found, list)
            and len(found) == len(expected)
            and all(same(one, other, digits) for one, other in zip(found, expected, strict=True))
        )
    if isinstance(expected, bool | np.bool_ | str):
        return type(found) in (bool, str) and found == expected
    is_number = isinstance(found, int | float) and not isinstance(found, bool)
    return is_number and math.isclose(found, expected, **digits)


# The paper ---------------------------------------------------------------------------------------


def equations(table: Table) -> Drawn:
    for row in table("equations").itertuples():
        yield row.id, "holds", bool(row.follows)


def mass_ratio(table: Table) -> Drawn:
    rows = table("mass_ratio").set_index("mass_ratio")
    yield "limit_of_frequency_ratio", "value", rows.frequency_ratio[math.inf]
    yield "limit_of_size_ratio", "value", rows.size_ratio[math.inf]
    yield "gain_at_mass_ratio_one", "value", rows.share_of_size_gain[1.0]
    yield "heavier_is_larger", "holds", _rises(rows.size_ratio)


def heavier(table: Table) -> Drawn:
    rows = table("heavier")
    lowest = rows.lowest_overturning_low
    yield (
        "heavier_survives_more",
        "holds",
        _rises(lowest) and bool(rows.same_verdict_by_all.all()),
    )
    yield "heavier_survives_more", "lowest_overturning_g", list(lowest)
    yield "solitary_column_overturns", "holds", rows.outcome.iloc[0] == "overturned"
    yield "heaviest_survives", "holds", rows.outcome.iloc[-1] != "overturned"


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


def trilith(table: Table) -> Drawn:
    near = table("trilith_nearness").set_index("quantity")
    width = near.loc["effective_width_of_columns"]
    yield "amplitude_to_lift", "value", near.to_lift["amplitude_at_tested_frequency"]
    yield "frequency_to_lift", "value", near.to_lift["frequency_at_tested_amplitude"]
    yield "tilt_to_lift", "value", near.to_lift["tilt_of_the_base"]
    yield "width_to_lift", "value", width.to_lift
    yield "width_lost_at_each_edge", "value", (width.tested - width.to_lift) / 2.0
    bracketed = near.other_side_lifts & ~near.safe_side_lifts
    yield "thresholds_bracketed", "holds", bracketed.all()
    starts = table("trilith_starts").set_index("share_of_speed")
    yield "rest_from_rest", "holds", starts.outcome[0.0] == "no uplift"
    kept = "abrupt_start_keeps_it_rocking"
    yield kept, "holds", starts.outcome[1.0] == "rocking"
    yield kept, "steady_peak_over_alpha", starts.late_peak_over_alpha[1.0]


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
    yield "heavier_needs_less", "holds", _rises(-demand)
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


def _rises(values: pd.Series) -> bool:
    return bool((np.diff(values) > 0.0).all())


SOURCES: dict[str, Callable[[Table], Drawn]] = {
    source.__name__: source
    for source in (
        equations,
        mass_ratio,
        heavier,
        spectra,
        trilith,
        reversals_pulses,
        reversals_enough,
        reversals_motions,
        reversals_records,
        mechanism_equivalence,
        mechanism_verdicts,
        mechanism_rebounds,
        mechanism_dependence,
        mechanism_three_bodies,
        mechanism_records,
    )
}
"""The functions above by the name of the rule whose findings they draw."""
