"""The committed claims against the committed tables, without a run: `make check`.

Every verdict is judged anew from its numbers, and the closed forms of the tables are computed here
once more, from the paper's equations and not by the library.
"""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
from ledger import read_ledger
from publish import verdict_table
from strict_yaml import read_yaml

from topheavy.claims import judge, tally

CLOSE = {"rtol": 1e-8, "atol": 1e-9}  # the digits of the tables


def claims(ledger: list[dict], published: list[dict]) -> Iterator[str]:
    """Yield what is wrong with the published verdicts by the ledger."""
    rows = {row["id"]: row for row in published}
    for name in sorted({row["id"] for row in ledger} ^ set(rows)):
        yield f"claim {name} is not in both the ledger and tests/reference/claims.json"
    for claim in ledger:
        row = rows.get(claim["id"], claim)
        verdict = row.get("verdict")
        if "tolerance" in claim and "computed" in row:
            finding = {"value": row["computed"], "error": row["error"]}
            if row["meant"] is not None:
                finding["meant_value"] = row["meant"]
            verdict = judge(claim, finding)
        if {verdict, row.get("verdict")} != {claim["expected"]}:
            yield (
                f"claim {claim['id']} is published as {row.get('verdict')} and comes out {verdict} "
                f"from its numbers; expected {claim['expected']}"
            )


def tables(folder: Path, rows: list[dict]) -> Iterator[str]:
    """Yield the tables whose numbers are not those of the paper's equations, or of the claims."""

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
    lowest = table("heavier").lowest_overturning_low
    if not lowest.is_monotonic_increasing:
        yield "heavier.csv: the lowest amplitude that overturns does not rise with γ"
    equations = table("equations")
    wrong = set(equations[~equations.follows & equations.equation.notna()].equation)
    verdicts = {row["equation"]: row["verdict"] for row in rows if row["verdict"] == "misprint"}
    if wrong != set(verdicts) - {None}:
        yield "equations.csv: the equations that do not follow are not the ledger's misprints"


def _frequency_ratio(gamma: pd.Series) -> pd.Series:
    """p̂/p of Eq. (23), from its two limits; γ may be infinite."""
    column = 1.0 / (1.0 + 3.0 * gamma)
    return np.sqrt(column + (1.0 - column) * 2.0 / 3.0)


def _restitution(alpha: pd.Series, gamma: pd.Series) -> pd.Series:
    """√r of Eq. (25), from its two limits."""
    column = 1.0 / (1.0 + 3.0 * gamma)
    return column * (1.0 - 1.5 * np.sin(alpha) ** 2) + (1.0 - column) * np.cos(2.0 * alpha)


def main(root: Path = Path()) -> tuple[str, list[str]]:
    """Return the tally of the committed claims, and what is wrong."""
    config = read_yaml(root / "config" / "config.yaml")
    studies = [root / "studies" / name / "claims.yaml" for name in config["studies"]]
    ledger = read_ledger([root / "paper" / "claims.yaml", *studies])
    reference = root / "tests" / "reference"
    rows = json.loads((reference / "claims.json").read_text(encoding="utf-8"))
    faults = [*claims(ledger, rows), *tables(reference, rows)]
    if (root / "docs" / "verdicts.md").read_text(encoding="utf-8") != verdict_table(rows):
        faults.append("docs/verdicts.md is not the table of tests/reference/claims.json")
    return tally(row["verdict"] for row in rows), faults


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="replace")  # a terminal may know no Greek letters
    line, faults = main()
    print(*faults, line, sep="\n")
    print("the committed claims, tables and verdicts agree" if not faults else "they do not agree")
    sys.exit(bool(faults))
