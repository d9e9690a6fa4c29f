"""The numbers in the README, each from a published table or claim, in the order of the text."""

import json
import math
import re
from collections.abc import Iterator
from pathlib import Path

import pandas as pd

from replication.inputs.strict_yaml import read_yaml

LINK = re.compile(r"\]\((?:[^()]|\([^()]*\))*\)")
DOI = re.compile(r"\[doi:[^\]]*\]")
STATED_PGV = 0.6
"""m/s, of the probabilities in the README."""
COMPARED = re.compile(r"([\d,]+) overturning flags")


def found(readme: str) -> str:
    """Return the README up to "Reproduce it", without the targets of links: all our findings."""
    return DOI.sub("", LINK.sub("]", readme.split("\n## Reproduce it")[0]))


def motions(reference: Path, table: str, **place: float) -> pd.Series:
    """Return a row of a table of study reversals: temple columns, near-fault motions."""
    rows = pd.read_csv(reference / "studies" / f"{table}.csv")
    rows = rows.query("structure == 'temple' and family == 'near-fault'")
    for column, value in place.items():
        rows = rows[rows[column] == value]
    return rows.squeeze()


def stated_motions(reference: Path, level: float) -> pd.DataFrame:
    """Return how many near-fault motions of a PGV overturn 6 m columns, and of how many.

    The rows are the supports of the mass: bare, free and fixed.
    """
    rows = pd.read_csv(reference / "studies" / "certainty_intensities.csv")
    rows = rows.query("structure == '6 m temple' and family == 'near-fault' and measure == 'pgv'")
    return rows[rows.level == level].set_index("support")[["fell", "motions"]]


def numbers(reference: Path) -> list[str]:
    """Return the decimal numbers of the findings as they are rounded there, in their order."""
    rows = json.loads((reference / "claims.json").read_text(encoding="utf-8"))
    claims = {row["id"]: row["computed"] for row in rows}
    ratios = pd.read_csv(reference / "mass_ratio.csv").set_index("mass_ratio")
    lowest = pd.read_csv(reference / "heavier.csv").set_index("mass_ratio").lowest_overturning_low
    starts = pd.read_csv(reference / "trilith_starts.csv").set_index("share_of_speed")
    gain = motions(reference, "reversals_medians", mass_ratio=1.0, as_large_as=0).gain
    reversed_ = motions(reference, "reversals_pairs", lighter=0, heavier=1.0).motions
    study = read_yaml(reference / "studies" / "reversals.yaml")["pulses"]
    window = study["grids"][study["grid"]]["frequency_ratios"]
    return [
        f"{ratios.size_ratio[math.inf]:.1f}",
        *(f"{lowest[gamma]:.3f}" for gamma in (0.0, math.inf)),
        f"{window['lowest']:.1f}",
        f"{100 * claims['reversals_help']:.1f}",
        f"{100 * claims['reversals_harm']:.1f}",
        f"{100 * gain:.1f}",
        f"{100 * reversed_:.1f}",
        f"{ratios.frequency_ratio[math.inf]:.3f}",
        f"{lowest[1.0]:.3f}",
        f"{STATED_PGV:.1f}",
        f"{claims['trilith_base_acceleration_in_g']:.3f}",
        f"{claims['trilith_uplift_acceleration']:.3f}",
        f"{starts.late_peak_over_alpha[1.0]:.3f}",
        f"{100 * claims['mechanism_share_apart']:.1f}",
    ]


def headlines(root: Path) -> Iterator[str]:
    """Yield the numbers in the README that are not those of the published tables."""
    readme = (root / "README.md").read_text(encoding="utf-8")
    printed, ours = re.findall(r"\d+\.\d+", found(readme)), numbers(root / "tests" / "reference")
    if printed != ours:
        yield (
            f"README.md, What we found: the numbers are {', '.join(printed)}; expected "
            f"{', '.join(ours)}, in this order, by the published tables and claims"
        )
    cells = int(pd.read_csv(root / "docs" / "verify_grid.csv").cells.sum())
    for number in COMPARED.findall(readme):
        if int(number.replace(",", "")) != cells:
            yield (
                f"README.md: {number} overturning flags are compared with heyoka's; expected "
                f"{cells:,} by docs/verify_grid.csv"
            )
