"""The numbers in the README, each from a published table or claim, in the order of the text."""

import json
import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pandas as pd

from replication.inputs.parts import PAPER
from replication.inputs.strict_yaml import read_yaml

LINK = re.compile(r"\]\((?:[^()]|\([^()]*\))*\)")
DOI = re.compile(r"\[doi:[^\]]*\]")
COMPARED = re.compile(r"([\d,]+) overturning flags")


def found(readme: str) -> str:
    """Return the README up to "Reproduce it", without the targets of links: all our findings."""
    return DOI.sub("", LINK.sub("]", readme.split("\n## Reproduce it")[0]))


def motions(reference: Path, table: str, **place: float) -> pd.DataFrame:
    """Return the rows of a table of study reversals on temple columns, one for each family."""
    rows = pd.read_csv(reference / "studies" / f"{table}.csv").query("structure == 'temple'")
    for column, value in place.items():
        rows = rows[rows[column] == value]
    return rows.set_index("family")


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
    return read_yaml(reference / "studies" / "certainty.yaml")["benefit"]["pgv"]


def rises_at_one_period(reference: Path) -> pd.Series:
    """Return by how much a very heavy cap beam raises the minimum under each pulse of 1.5 s."""
    rows = pd.read_csv(reference / "vase.csv").set_index("shape")
    bare = rows[rows.structure == "bare"].minimum_overturning
    heavy = rows[(rows.structure == "free") & (rows.mass_ratio == math.inf)].minimum_overturning
    return heavy / bare - 1.0


def portals(reference: Path) -> pd.Series:
    """Return the minimum overturning accelerations (g) of the portals under a one-cosine pulse."""
    rows = pd.read_csv(reference / "vase.csv")
    rows = rows[(rows.structure == "portal") & (rows["shape"] == "one-cosine")]
    return rows.minimum_overturning


def from_to(shares: pd.Series, digits: int = 0) -> str:
    """Return the range of shares in words, in per cent: "17 to 23"."""
    return f"{100 * shares.min():.{digits}f} to {100 * shares.max():.{digits}f}"


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


def computed(reference: Path) -> dict[str, float]:
    """Return the computed value of each published claim, by its id."""
    rows = json.loads((reference / "claims.json").read_text(encoding="utf-8"))
    return {row["id"]: row["computed"] for row in rows}


def ratios(reference: Path) -> pd.DataFrame:
    """Return the published ratios of size and frequency, by γ."""
    return pd.read_csv(reference / "mass_ratio.csv").set_index("mass_ratio")


def minima(reference: Path) -> pd.Series:
    """Return the minimum overturning accelerations (g) of heavier and heavier frames, by γ."""
    rows = pd.read_csv(reference / "heavier.csv").set_index("mass_ratio")
    return rows.lowest_overturning_low


# The numbers in the order of the text ------------------------------------------------------------


def of_size(reference: Path) -> list[str]:
    return [
        f"{ratios(reference).size_ratio[math.inf]:.1f}",
        f"{read_yaml(reference / 'config.yaml')['heavier']['pulse']['period']:.1f}",
        *(f"{minima(reference)[gamma]:.3f}" for gamma in (0.0, math.inf)),
    ]


def of_pulses(reference: Path) -> list[str]:
    claims = computed(reference)
    study = read_yaml(reference / "studies" / "reversals.yaml")["pulses"]
    window = study["grids"][study["grid"]]["frequency_ratios"]
    shares = (claims["reversals_help"], claims["reversals_harm"])
    return [f"{window['lowest']:.1f}", *(f"{100 * share:.1f}" for share in shares)]


def of_many_motions(reference: Path) -> list[str]:
    gains = motions(reference, "reversals_medians", mass_ratio=1.0, as_large_as=0).gain
    reversed_ = motions(reference, "reversals_pairs", lighter=0, heavier=1.0).motions
    return [*from_to(gains, 1).split(" to "), *from_to(reversed_, 1).split(" to ")]


def of_central_result(reference: Path) -> list[str]:
    return [f"{ratios(reference).frequency_ratio[math.inf]:.3f}", f"{minima(reference)[1.0]:.3f}"]


def of_velocity(reference: Path) -> list[str]:
    return [f"{stated_pgv(reference):.1f}"]


def of_portals(reference: Path) -> list[str]:
    return [f"{portals(reference).min():.2f}"]


def of_records(reference: Path) -> list[str]:
    alone, both = unscaled(reference).values()
    return [f"{gamma:g}" for gamma in alone[True] + both[False] if gamma % 1.0]


def of_trilith(reference: Path) -> list[str]:
    claims = computed(reference)
    starts = pd.read_csv(reference / "trilith_starts.csv").set_index("share_of_speed")
    states = pd.read_csv(reference / "trilith_states.csv").outcome.value_counts(normalize=True)
    return [
        f"{claims['trilith_base_acceleration_in_g']:.3f}",
        f"{claims['trilith_uplift_acceleration']:.3f}",
        f"{100 * states['rocking']:.1f}",
        f"{starts.late_peak_over_alpha[1.0]:.3f}",
        *(f"{100 * states[outcome]:.1f}" for outcome in ("rests", "overturned")),
    ]


def of_mechanism(reference: Path) -> list[str]:
    return [f"{100 * computed(reference)['mechanism_share_apart']:.1f}"]


IN_ORDER: tuple[tuple[str, Callable[[Path], list[str]]], ...] = (
    (PAPER, of_size),
    ("reversals", of_pulses),
    ("reversals", of_many_motions),
    (PAPER, of_central_result),
    ("certainty", of_velocity),
    (PAPER, of_portals),
    ("certainty", of_velocity),
    ("certainty", of_records),
    (PAPER, of_trilith),
    ("mechanism", of_mechanism),
)
"""The part of the work that each passage of the README is of, and its numbers."""


def numbers(reference: Path) -> list[str]:
    """Return the decimal numbers of the findings as they are rounded there, in their order.

    Without a study, the README tells none of its numbers.
    """
    there = {PAPER, *(path.stem for path in (reference / "studies").glob("*.yaml"))}
    return [number for part, of in IN_ORDER if part in there for number in of(reference)]


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
