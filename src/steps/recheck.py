"""The published edition against itself, without a run: `make check`.

Every row of the ledger is judged anew from the published findings. The findings are held against
the published tables, the tables against the paper's equations, and the pages against the verdicts.
"""

import json
import sys
from collections.abc import Iterable, Iterator, Mapping
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from claims import read_findings
from ledger import judged, read_ledger
from publish import CHECKSUMS, checksums, verdict_page, with_counts
from strict_yaml import read_yaml

from topheavy.claims import tallies

CLOSE = {"rtol": 1e-8, "atol": 1e-9}  # the digits of the tables
CLAIMS = "tests/reference/claims.json"

Findings = Mapping[str, Mapping[str, Any]]


def claims(
    ledger: Iterable[Mapping[str, Any]], findings: Findings, published: list[dict], root: Path
) -> Iterator[str]:
    """Yield what is wrong with the published rows: every field of every row is made anew."""
    rows = {row["id"]: row for row in published}
    for name in sorted({claim["id"] for claim in ledger} ^ set(rows)):
        yield f"claim {name} is not in both the ledger and {CLAIMS}"
    for claim in ledger:
        try:
            found = judged(claim, findings, root)
        except ValueError as fault:
            yield str(fault)
            continue
        if found["verdict"] != claim["expected"] and not found["not_tested"]:
            yield f"claim {claim['id']} comes out {found['verdict']}; expected {claim['expected']}"
        row = rows.get(claim["id"], found)
        for field in sorted({*found, *row}):
            ours, theirs = found.get(field), row.get(field)
            if ours != theirs or type(ours) is not type(theirs):
                yield (
                    f"claim {claim['id']}: {field} is {theirs!r} in {CLAIMS}, and {ours!r} by the "
                    "ledger and the findings"
                )


def equations(folder: Path) -> Iterator[str]:
    """Yield the tables whose numbers are not those of the paper's equations."""

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


def evidence(folder: Path, findings: Findings) -> Iterator[str]:
    """Yield the findings that do not follow from the tables which they were drawn from."""

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


def _differs(rule: str, name: str, key: str, expected: Any, findings: Findings) -> Iterator[str]:
    found = findings.get(rule, {}).get(name, {}).get(key)
    if found is None or not np.isclose(found, expected, **CLOSE):
        yield (
            f"findings/{rule}.json: {name}.{key} is {found}, and {expected:.9g} by the published "
            "table that it was drawn from"
        )


def pages(root: Path, rows: list[dict]) -> Iterator[str]:
    """Yield the first line of docs/verdicts.md, and of the README, that is not that of the rows."""
    readme = (root / "README.md").read_text(encoding="utf-8")
    expected = {
        "docs/verdicts.md": lambda: verdict_page(rows),
        "README.md": lambda: with_counts(readme, rows),
    }
    for page, made in expected.items():
        lines = (root / page).read_text(encoding="utf-8").splitlines()
        try:
            theirs = made().splitlines()
        except ValueError as fault:
            yield f"{page}: {fault}"
            continue
        for number, (line, other) in enumerate(zip_longest(lines, theirs), 1):
            if line != other:
                yield f"{page}, line {number} is {line!r}; expected {other!r} by the verdicts"
                break  # the lines below may only be shifted


def files(reference: Path) -> Iterator[str]:
    """Yield the published tables and findings that changed since `make publish` wrote them."""
    listed = dict(
        reversed(line.split("  ", 1))
        for line in (reference / CHECKSUMS).read_text(encoding="utf-8").splitlines()
    )
    there = dict(reversed(line.split("  ", 1)) for line in checksums(reference).splitlines())
    for name in sorted({*listed, *there}):
        if listed.get(name) != there.get(name):
            kind = "changed" if name in listed and name in there else "is not in both"
            yield f"tests/reference/{name} {kind}: held against {CHECKSUMS} of `make publish`"


def main(root: Path = Path()) -> tuple[list[str], list[str]]:
    """Return the tallies of the published claims, and what is wrong with the edition."""
    config = read_yaml(root / "config" / "config.yaml")
    studies = [root / "studies" / name / "claims.yaml" for name in config["studies"]]
    ledger = read_ledger([root / "paper" / "claims.yaml", *studies])
    reference = root / "tests" / "reference"
    findings = read_findings((reference / "findings").glob("*.json"))
    rows = json.loads((root / CLAIMS).read_text(encoding="utf-8"))
    faults = [
        *claims(ledger, findings, rows, root),
        *evidence(reference, findings),
        *equations(reference),
        *pages(root, rows),
        *files(reference),
    ]
    return tallies(rows), faults


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="replace")  # a terminal may know no Greek letters
    lines, faults = main()
    print(*faults, *lines, sep="\n")
    print("the published findings, tables, claims and pages agree" if not faults else "they differ")
    sys.exit(bool(faults))
