"""What README and docs/findings.md say of this study."""

from steps.shared.published import Passage, Published, need, span


def of_models(results: Published) -> str:
    results.need(
        robustness_order="confirmed", robustness_gain="confirmed", robustness_one_gain="refuted"
    )
    rows = results.table("studies/robustness_models")
    friction = results.finding("robustness_friction", "enough")
    need(friction["mass_ratios"] == [0.5], "other than the lightest beam needs much friction")
    pgv = results.config_of("robustness")["models"]["pgv"]
    return (
        f"Under each of eight models of motions at {pgv} m/s, the column with its own mass fixed "
        "on top overturns most often and the frame with γ = 1 least: filtered noise of two soils "
        "with three corner frequencies, and the two "
        f"families. The gain in the median velocity is {span(rows.gain)} % by the model, so that "
        "it belongs to one, as each probability does. Of motions that a factor of 4 at most "
        f"brings to this velocity the same is true. Up to {100 * friction['most']:.0f} % of "
        f"broadband motions need a coefficient of friction above {friction['coefficient']} with γ "
        "= 0.5, and at most 5 % with γ = 1 or more. Vertical acceleration leaves the benefit."
    )


def of_order(results: Published) -> str:
    results.need(
        robustness_order="confirmed", robustness_gain="confirmed", robustness_one_gain="refuted"
    )
    rows = results.table("studies/robustness_models")
    return (
        "The order is the same under eight models of motions: a mass fixed on top makes "
        f"overturning more frequent, a loose beam rarer. The gain is {span(rows.gain)} %, by the "
        "model; each percentage of motions belongs to one."
    )


PASSAGES: dict[str, Passage] = {
    "Robust": of_order,
    "The order is robust, the numbers belong to a model": of_models,
}
