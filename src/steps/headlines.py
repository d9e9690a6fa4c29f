"""The numbers in the README, each from a published table or claim, passage by passage."""

import math
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pandas as pd

from replication.inputs.strict_yaml import read_yaml
from steps.shared.published import Numbers, computed

STUDIES = Path(__file__).resolve().parents[2] / "studies"
CODE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)
LINK = re.compile(r"\]\((?:[^()]|\([^()]*\))*\)")
DOI = re.compile(r"\[doi:[^\]]*\]")
ENDS = ["min", "max"]
COMPARED = re.compile(r"([\d,]+) overturning flags")


def found(readme: str) -> str:
    """Return the README up to "Reproduce it", without code and targets of links: our findings."""
    return DOI.sub("", LINK.sub("]", CODE.sub("", readme.split("\n## Reproduce it")[0])))


def rises_at_one_period(reference: Path) -> pd.Series:
    """Return by how much a very heavy cap beam raises the minimum under each pulse of 1.5 s."""
    rows = pd.read_csv(reference / "vase.csv").set_index("shape")
    bare = rows[rows.structure == "bare"].minimum_overturning
    heavy = rows[(rows.structure == "free") & (rows.mass_ratio == math.inf)].minimum_overturning
    return heavy / bare - 1.0


def portals(reference: Path) -> pd.DataFrame:
    """Return the portals under a one-cosine pulse."""
    rows = pd.read_csv(reference / "vase.csv")
    return rows[(rows.structure == "portal") & (rows["shape"] == "one-cosine")]


def ratios(reference: Path) -> pd.DataFrame:
    """Return the published ratios of size and frequency, by γ."""
    return pd.read_csv(reference / "mass_ratio.csv").set_index("mass_ratio")


def minima(reference: Path) -> pd.Series:
    """Return the minimum overturning accelerations (g) of heavier and heavier frames, by γ."""
    rows = pd.read_csv(reference / "heavier.csv").set_index("mass_ratio")
    return rows.lowest_overturning_low


# The numbers of each passage ----------------------------------------------------------------------


def of_size(reference: Path) -> list[str]:
    return [
        f"{ratios(reference).size_ratio[math.inf]:.1f}",
        f"{read_yaml(reference / 'config.yaml')['heavier']['pulse']['period']:.1f}",
        *(f"{minima(reference)[gamma]:.3f}" for gamma in (0.0, math.inf)),
    ]


def of_central_result(reference: Path) -> list[str]:
    minimum = minima(reference)
    ratio = ratios(reference).frequency_ratio[math.inf]
    return [f"{one:.3f}" for one in (ratio, minimum[1.0], minimum[0.0])]


def of_portals(reference: Path) -> list[str]:
    moments = pd.read_csv(reference / "sources" / "portal_forces.csv")
    held = moments[moments.resisted].groupby("state").joint_moment_over_frame
    ranges = [end for state in ("rocks", "rests_pinned") for end in held.get_group(state).agg(ENDS)]
    rows = portals(reference)
    (quoted,) = rows.dropna(subset="minimum_overturning").itertuples()
    pulled = rows.dropna(subset="pulled_from")
    return [
        f"{quoted.minimum_overturning:.2f}",
        *(f"{span:.1f}" for span in (quoted.span, *pulled.span)),
        f"{pulled.pulled_from.min():.1f}",
        *(f"{one:.1f}" for one in ranges),
    ]


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


OF_PAPER: dict[str, Numbers] = {
    "Size": of_size,
    "The central result holds": of_central_result,
    "A portal overturns later still": of_portals,
    "One inference requires a smooth start": of_trilith,
}
"""The numbers of the paper's passages; those of a study are in its folder, as HEADLINES."""


def by_passage(reference: Path) -> dict[str, list[str]]:
    """Return the decimal numbers of each passage, as they are rounded there, in their order.

    Of the published studies, and of those alone.
    """
    found = dict(OF_PAPER)
    for path in sorted((reference / "studies").glob("*.yaml")):
        if (STUDIES / path.stem / "headlines.py").is_file():
            found |= import_module(f"studies.{path.stem}.headlines").HEADLINES
    return {passage: of(reference) for passage, of in found.items()}


def passages(findings: str) -> dict[str, list[str]]:
    """Return the decimal numbers that each passage of the README states, by its heading."""
    stated = {}
    for passage in re.split(r"\n(?=- \*\*|\n)", findings):
        heading = re.match(r"- \*\*(.+?)\.?\*\*", passage.lstrip("\n"))
        stated[heading[1] if heading else passage.strip()] = re.findall(r"\d+\.\d+", passage)
    return stated


def headlines(root: Path) -> Iterator[str]:
    """Yield the numbers in the README that are not those of the published tables."""
    readme = (root / "README.md").read_text(encoding="utf-8")
    printed, ours = passages(found(readme)), by_passage(root / "tests" / "reference")
    for passage in {**printed, **ours}:
        stated, expected = (of.get(passage, []) for of in (printed, ours))
        if stated != expected:
            yield (
                f"README.md, {passage[:60]}: the numbers are {', '.join(stated)}; expected "
                f"{', '.join(expected)}, in this order, by the published tables and claims"
            )
    cells = int(pd.read_csv(root / "docs" / "verify_grid.csv").cells.sum())
    for number in COMPARED.findall(readme):
        if int(number.replace(",", "")) != cells:
            yield (
                f"README.md: {number} overturning flags are compared with heyoka's; expected "
                f"{cells:,} by docs/verify_grid.csv"
            )
