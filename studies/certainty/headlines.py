"""What README and docs/findings.md say of this study."""

from steps.shared.published import FAMILIES, Passage, Published, both, need, span, with_interval


def of_conditions(results: Published) -> str:
    results.need(certainty_frame_is_safer="confirmed", certainty_benefit_reverses="confirmed")
    probable = results.table("studies/certainty_intensities")
    pgv = results.config_of("certainty")["benefit"]["pgv"]
    probable = probable.query(f"structure == '6 m temple' and measure == 'pgv' and level == {pgv}")
    bare, free = (probable[probable.support == name] for name in ("bare", "free"))
    (motions,) = set(bare.motions)
    even = results.finding("certainty_break_even", "benefit_ends")
    need(
        even["beyond"] == 0,
        "the benefit of some cells does not end at the deficits that were tried",
    )
    middle = with_interval(even, "median")
    return (
        f"The beam lies loose, nothing slides, contacts do not rebound. Of {motions} motions of "
        f"each family, scaled to a peak velocity of {pgv:.1f} m/s, {span(bare.probability)} % "
        f"overturn a 6 m column alone, and {span(free.probability)} % the frame. The estimate of "
        "this benefit falls to zero if the column alone keeps less of its velocity at its "
        f"impacts than the formula says, {100 * even['least']:.1f} to {100 * even['most']:.1f} % "
        f"less, median {middle} %, in {even['compared']} comparisons. Nobody has measured this "
        "for a frame, as far as we know."
    )


def of_velocity(results: Published) -> str:
    results.need(certainty_free_cap_helps="confirmed", certainty_fixed_mass_harms="confirmed")
    probable = results.table("studies/certainty_intensities")
    pgv = results.config_of("certainty")["benefit"]["pgv"]
    probable = probable.query(f"structure == '6 m temple' and measure == 'pgv' and level == {pgv}")
    bare, free, fixed = (probable[probable.support == name] for name in ("bare", "free", "fixed"))
    rows = (
        results.table("studies/certainty_benefit")
        .query("way == 'both' and factor == 1")
        .set_index("family")
    )
    frame, column = (
        both(rows[f"only_{name}"][[*FAMILIES]], 0, 1.0) for name in ("frame", "column")
    )
    (motions,) = set(rows.motions)
    return (
        f"Of {motions} near-fault and as many broadband motions, scaled to {pgv:.1f} m/s, "
        f"{span(bare.probability)} % overturn a 6 m column alone, {span(fixed.probability)} % the "
        f"column with its own mass fixed to its top, and {span(free.probability)} % the frame "
        f"with γ = 1. Only the frame is overturned by {frame} motions of the two families, and "
        f"only the column by {column}."
    )


def of_impacts(results: Published) -> str:
    results.need(
        certainty_frame_is_safer="confirmed", certainty_break_even_second_route="confirmed"
    )
    rows = results.table("studies/certainty_benefit").set_index(["way", "factor", "family"])

    def less(way: str, factor: float, name: str = "less", digits: int = 1) -> str:
        each = (rows.loc[(way, factor, family)] for family in FAMILIES)
        scale = 100.0 if name == "less" else 1.0
        return " and ".join(with_interval(row, name, digits, scale) for row in each)

    even = results.finding("certainty_break_even", "benefit_ends")
    need(
        results.finding("certainty_benefit", "frame_is_safer")["shrinks"],
        "the difference does not shrink",
    )
    need(
        even["beyond"] == 0,
        "the benefit of some cells does not end at the deficits that were tried",
    )
    return (
        f"At 0.6 m/s the probability of the column less that of the frame is {less('both', 1.0)} "
        "percentage points under near-fault and broadband motions (95 % intervals). If √r is 10 "
        f"% lower for both, it shrinks to {less('both', 0.9)}; the frame then overturns "
        f"{less('both', 0.9, 'over', 2)} times as often as the column, and "
        f"{less('both', 1.0, 'over', 2)} times with √r of Eq. (25). If that of the frame alone is "
        f"5 % lower, the difference is {less('frame alone', 0.95)}; if that of the column alone "
        f"is 10 % lower, it is {less('column alone', 0.9)}. The estimated difference reaches zero "
        f"at deficits of the column's √r alone of {100 * even['least']:.1f} to "
        f"{100 * even['most']:.1f} %, median {with_interval(even, 'median')} %, over "
        f"{even['compared']} comparisons that share motions. Nobody has measured which of the two "
        "is lower, as far as we know; a rigid-body engine, with rebound, lowers that of the frame."
    )


def of_records(results: Published) -> str:
    results.need(certainty_records_bare_first="refuted", certainty_records_lighter_first="refuted")
    rows, shares = (
        results.table("studies/certainty_records"),
        results.finding("certainty_rescaled", "shares_hold_at_half_the_step"),
    )
    pairs = rows.groupby(["record", "structure"]).overturned.any()
    need(
        int(pairs.sum()) == len(shares["shares"]) == 2,
        "other than two records overturn anything unscaled",
    )
    said = {one["record"]: [] for one in shares["filtered"]}
    for one in shares["filtered"]:
        said[one["record"]].append(f"{one['corner']:g} Hz: {one['said']}")
    filters = "; ".join(f"`{record}` {', '.join(words)}" for record, words in said.items())
    widths = "; ".join(
        f"`{name.split(',')[0]}` "
        + ", ".join(
            f"{100 * share:.0f} % within {100 * float(width):g} %" for width, share in of.items()
        )
        for name, of in shares["shares"].items()
    )
    return (
        f"Of {len(pairs)} pairs of a measured component and a column, unscaled, two overturn "
        "anything, and both reverse the order of γ. These records are uncorrected. Outcomes "
        "change at every resolution of their scale; the shares of scales at which any two γ are "
        f"reversed are: {widths} of their own. After a zero-phase Butterworth high-pass, filters "
        f"of order 2 and 4 agree on: {filters}. One program proves a pair of γ for each, unscaled."
    )


PASSAGES: dict[str, Passage] = {
    "Conditions": of_conditions,
    "At one velocity of the ground": of_velocity,
    "The benefit depends on the impacts": of_impacts,
    "Measured records reverse the order, too": of_records,
}
