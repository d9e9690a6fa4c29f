"""Compare published tables with the paper's equations, and findings with tables: `make check`.

The check also judges every row of the ledger again from the published findings, without a run.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from replication.inputs.strict_yaml import read_yaml
from replication.pages.edition_check import close
from replication.pages.edition_check import main as recheck
from steps.headlines import headlines
from steps.redrawn import departures

CLOSE = {"rtol": 1e-8, "atol": 1e-9}  # the digits of the tables


def main(root: Path = Path()) -> tuple[list[str], list[str]]:
    """Return the tallies of the published claims, and the errors in the published files."""
    return recheck(
        lambda folder, findings: [
            *departures(folder, findings),
            *equations(folder),
            *headlines(root),
        ],
        root,
    )


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


if __name__ == "__main__":
    close(*main())
