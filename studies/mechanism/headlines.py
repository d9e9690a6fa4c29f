"""What README and docs/findings.md say of this study."""

from steps.shared.published import Passage, Published, need


def of_mechanism(results: Published) -> str:
    same = results.finding("mechanism_equivalence", "identical_response")
    enough = results.finding("mechanism_admissible", "friction_is_enough")
    tan = results.finding("mechanism_admissible", "uplift_needs_tan")
    need(tan["holds"], "a frame uplifts with less friction than tan α")
    at = enough["share_that_rocks_at"][f"{enough['friction']:g}"]
    lightest = min((gamma for gamma in at if float(gamma) > 0), key=float)
    need(at[lightest] < at["0"], "a light cap beam requires no more friction than the column alone")
    return (
        f"None of {tan['cells']} computed frames and columns uplifts with less friction than tan "
        "α, and a light cap beam requires more than the column alone: with a coefficient of "
        f"{enough['friction']:g}, {100 * at[lightest]:.0f} % of those with γ = {lightest} that "
        f"survive rock without sliding, and {100 * at['0']:.0f} % of the columns. The frame loses "
        "more energy at impacts than the larger column, as the paper says: outcomes differ under "
        f"{100 * same['mean_share_apart']:.1f} % of pulses on average, and "
        f"{100 * same['largest_share_apart']:.1f} % at most."
    )


PASSAGES: dict[str, Passage] = {
    "The mechanism requires friction, and contacts without rebound": of_mechanism
}
