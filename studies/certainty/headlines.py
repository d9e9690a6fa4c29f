"""The numbers of this study in the README."""

from pathlib import Path

import pandas as pd

from steps.shared.published import Numbers, config_of


def stated_motions(reference: Path, support: str) -> pd.DataFrame:
    """Return how many motions of the stated PGV overturn 6 m columns, and of how many, by family.

    The support of the mass is bare, free or fixed.
    """
    rows = pd.read_csv(reference / "studies" / "certainty_intensities.csv")
    rows = rows.query("structure == '6 m temple' and measure == 'pgv' and support == @support")
    rows = rows[rows.level == stated_pgv(reference)]
    return rows.set_index("family")[["fell", "motions", "probability"]]


def stated_pgv(reference: Path) -> float:
    """Return the peak ground velocity in m/s of the probabilities in README and article."""
    return config_of(reference, "certainty")["benefit"]["pgv"]


def unscaled(reference: Path) -> dict[str, dict[bool, list[float]]]:
    """Return the γ of 6 m columns that each measured record overturns (True), and that survive it.

    Of the records that overturn any; γ = 0 is the bare column.
    """
    rows = pd.read_csv(reference / "studies" / "certainty_records.csv")
    rows = rows[rows.structure == "6 m temple"]
    return {
        str(record): {
            falls: of.mass_ratio[of.overturned == falls].tolist() for falls in (True, False)
        }
        for record, of in rows.groupby("record", sort=False)
        if of.overturned.any()
    }


def of_velocity(reference: Path) -> list[str]:
    return [f"{stated_pgv(reference):.1f}"]


def of_records(reference: Path) -> list[str]:
    alone, both = unscaled(reference).values()
    return [f"{gamma:g}" for gamma in alone[True] + both[False] if gamma % 1.0]


HEADLINES: dict[str, Numbers] = {
    "The support of the mass decides": of_velocity,
    "The benefit depends on the impacts": of_velocity,
    "Reversals have a reason": of_records,
}
