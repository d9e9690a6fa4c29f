"""Compare published tables with the paper's equations, and findings with tables: `make check`.

The check also judges every row of the ledger again from the published findings, without a run.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from replication.findings import Findings
from replication.rechecking import close
from replication.rechecking import main as recheck
from replication.strict_yaml import read_yaml

CLOSE = {"rtol": 1e-8, "atol": 1e-9}  # the digits of the tables


def main(root: Path = Path()) -> tuple[list[str], list[str]]:
    """Return the tallies of the published claims, and the errors in the published files."""
    return recheck(lambda folder, findings: [*evidence(folder, findings), *equations(folder)], root)


def equations(folder: Path) -> Iterator[str]:
    """Yield the tables whose numbers differ from the paper's equations."""

    def table(name: str) -> pd.DataFrame:
        return pd.read_csv(folder / f"{name}.csv")

    config = read_yaml(folder / "config.yaml")
    ratios = table("mass_ratio")
    if not np.allclose(ratios.frequency_ratio, _frequency_ratio(ratios.mass_ratio), **CLOSE):
        yield "mass_ratio.csv: p̂/p is not that of Eq. (23)"
    if not np.allclose(ratios.size_ratio, _frequency_ratio(ratios.mass_ratio) ** -2.0, **CLOSE):
        yield "mass_ratio.csv: R̂/R is not that of Eq. (24)"
    for name in ("restitution_over_mass_ratio", "restitution_over_slenderness"):
        found = table(name)
        alpha = np.radians(found.slenderness_deg)
        if not np.allclose(found.restitution, _restitution(alpha, found.mass_ratio), **CLOSE):
            yield f"{name}.csv: √r is not that of Eq. (25)"
    moments = table("moment_rotation").query("rotation_fraction != 0")
    column = config["structures"][config["moment_rotation"]["structure"]]
    alpha = np.arctan2(column["half_width"], column["half_height"])
    lever = np.sin(alpha * (1.0 - moments.rotation_fraction.abs()))
    expected = np.sign(moments.rotation_fraction) * (1.0 + 2.0 * moments.mass_ratio) * lever
    if not np.allclose(moments.moment, expected, **CLOSE):
        yield "moment_rotation.csv: the moment is not that of the weights of column and cap"


def _frequency_ratio(gamma: pd.Series) -> pd.Series:
    """p̂/p of Eq. (23), from its two limits; γ may be infinite."""
    column = 1.0 / (1.0 + 3.0 * gamma)
    return np.sqrt(column + (1.0 - column) * 2.0 / 3.0)


def _restitution(alpha: pd.Series, gamma: pd.Series) -> pd.Series:
    """√r of Eq. (25), from its two limits."""
    column = 1.0 / (1.0 + 3.0 * gamma)
    return column * (1.0 - 1.5 * np.sin(alpha) ** 2) + (1.0 - column) * np.cos(2.0 * alpha)


def evidence(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the findings that do not follow from their tables."""

    def table(name: str) -> pd.DataFrame:
        return pd.read_csv(folder / f"{name}.csv")

    printed = table("equations").set_index("id")
    for name, follows in printed.follows.items():
        yield from _differs("equations", str(name), "holds", bool(follows), findings)
    lowest = table("heavier").lowest_overturning_low
    rises = lowest.is_monotonic_increasing and lowest.is_unique
    yield from _differs("heavier", "heavier_survives_more", "holds", rises, findings)
    if "mechanism_equivalence" in findings:
        share = table("studies/mechanism_equivalence").share_apart.mean()
        yield from _differs("mechanism_equivalence", "share_apart", "value", share, findings)
    if "mechanism_verdicts" in findings:
        runs = table("studies/mechanism_verdicts")
        same = (runs.engine == runs.theory)[runs.contact == "plastic"].mean()
        yield from _differs("mechanism_verdicts", "same_verdicts", "share_plastic", same, findings)
    if "reversals_pulses" in findings:
        areas = table("studies/reversals_areas")
        ends = areas[(areas.lighter == 0) & (areas.heavier == "infinite")]
        for name in ("helps", "harms"):
            yield from _differs("reversals_pulses", name, "value", ends[name].mean(), findings)
        why = table("studies/reversals_why").query("heavier == 'infinite'")
        harm = why.groupby("change").harms.mean()
        decides = bool(harm["size"] > 10.0 * harm["restitution"])
        yield from _differs("reversals_pulses", "size_harms", "holds", decides, findings)
    if "reversals_enough" in findings:
        medians = table("studies/reversals_enough").groupby("share").mass_ratio.median()
        for share, ratio in medians.items():
            name = f"amplitude_at_{100 * share:.0f}_percent"
            yield from _differs("reversals_enough", name, "value", ratio, findings)
    if "reversals_motions" in findings:
        most = table("studies/reversals_pairs").reversed.max()
        yield from _differs(
            "reversals_motions", "heavier_is_safer", "most_reversed", most, findings
        )


def _differs(
    rule: str, name: str, key: str, expected: Any, findings: Mapping[str, Findings]
) -> Iterator[str]:
    finding = findings[rule].by_name.get(name) if rule in findings else None
    found = finding.entries.get(key) if finding else None
    if found is None or not np.isclose(found, expected, **CLOSE):
        yield (
            f"findings/{rule}.json: {name}.{key} is {found}, and {expected:.9g} by the published "
            "table that it was drawn from"
        )


if __name__ == "__main__":
    close(*main())
