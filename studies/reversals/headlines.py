"""What README and docs/findings.md say of this study."""

from steps.shared.published import FAMILIES, WORDS, Passage, Published, both, need, span


def of_pulses(results: Published) -> str:
    results.need(reversals_lowest_rises="confirmed", reversals_are_proven="confirmed")
    study = results.config_of("reversals")["pulses"]
    window = study["grids"][study["grid"]]
    helps, harms = (
        results.finding("reversals_pulses", name)["value"] for name in ("helps", "harms")
    )
    need(helps > harms, "a heavy beam causes more overturning on the map than it prevents")
    frequencies, amplitudes = (
        f"{window[axis]['lowest']:g} to {window[axis]['highest']:g} times"
        for axis in ("frequency_ratios", "amplitudes")
    )
    shapes, slopes = (WORDS[len(study[name])] for name in ("shapes", "slendernesses"))
    return (
        f"On our map, pulses of {frequencies} the frequency parameter of the column (how fast it "
        f"rocks) and of {amplitudes} the acceleration above which it begins to rock, a very heavy "
        "beam prevents overturning on "
        f"{100 * helps:.1f} % of the area, and causes it on {100 * harms:.1f} % (means over "
        f"{shapes} pulse shapes and {slopes} slendernesses)."
    )


def of_many_motions(results: Published) -> str:
    results.need(reversals_motions_probability="confirmed", reversals_motions="refuted")
    gains, pairs = (
        results.table(f"studies/reversals_{name}")
        .query(f"structure == 'temple' and {where}")
        .set_index("family")
        for name, where in (
            ("medians", "mass_ratio == 1 and as_large_as == 0"),
            ("pairs", "lighter == 0 and heavier == 1"),
        )
    )
    (motions,) = set(gains.motions)
    need((gains.gain_low > 0.0).all(), "an interval of the gain is not positive")
    frame, column = (both(pairs[f"only_{name}"][[*FAMILIES]], 1) for name in ("heavier", "lighter"))
    height = 2 * results.config["structures"]["temple"]["half_height"]
    return (
        f"Under two families of {motions} synthetic motions each, near-fault and broadband, a "
        "beam as heavy as both columns raises the velocity of the ground that overturns half of "
        f"the {height:.0f} m columns by {span(gains.gain, 1)} % (95 % intervals from "
        f"{span([gains.gain_low.min(), gains.gain_high.max()], 1)} %). In the mean over the "
        f"intensities, {frame} % of these motions overturn only the frame, and {column} % only "
        "the column."
    )


def of_reasons(results: Published) -> str:
    results.need(reversals_never_without_impact="confirmed")
    apart = results.finding("reversals_pulses", "apart")
    size, restitution = apart["size_harms"][0], apart["restitution_harms"][0]
    need(
        size > 10.0 * restitution,
        "the larger size alone does not cause far more reversals than the lower √r alone",
    )
    return (
        f"The larger size alone causes overturning on {100 * size:.2f} % of this map, the lower "
        f"√r alone on {100 * restitution:.2f} %. Under every computed pulse that overturns only "
        "the heavier frame, it overturns after an impact."
    )


PASSAGES: dict[str, Passage] = {
    "Reversals": of_pulses,
    "Many motions": of_many_motions,
    "Reversals have a reason": of_reasons,
}
