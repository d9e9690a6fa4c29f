"""The numbers of this study in the README."""

from pathlib import Path

import pandas as pd

from steps.shared.published import Numbers, computed, config_of, from_to

FAMILIES = ("near-fault", "broadband")


def motions(reference: Path, table: str, **place: float) -> pd.DataFrame:
    """Return the rows of a table of the study on temple columns, one for each family."""
    rows = pd.read_csv(reference / "studies" / f"{table}.csv").query("structure == 'temple'")
    for column, value in place.items():
        rows = rows[rows[column] == value]
    return rows.set_index("family")


def of_pulses(reference: Path) -> list[str]:
    claims = computed(reference)
    study = config_of(reference, "reversals")["pulses"]
    window = study["grids"][study["grid"]]["frequency_ratios"]
    shares = (claims["reversals_help"], claims["reversals_harm"])
    return [f"{window['lowest']:.1f}", *(f"{100 * share:.1f}" for share in shares)]


def of_many_motions(reference: Path) -> list[str]:
    gains = motions(reference, "reversals_medians", mass_ratio=1.0, as_large_as=0)
    pairs = motions(reference, "reversals_pairs", lighter=0, heavier=1.0)
    differ = (pairs.only_heavier, pairs.only_lighter)
    shares = [f"{100 * share:.1f}" for of in differ for share in of[[*FAMILIES]]]
    ends = [f"{100 * end:.1f}" for end in (gains.gain_low.min(), gains.gain_high.max())]
    return [*from_to(gains.gain, 1).split(" to "), *ends, *shares]


HEADLINES: dict[str, Numbers] = {"Reversals": of_pulses, "Many motions": of_many_motions}
