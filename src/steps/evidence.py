"""The findings that the published tables determine, computed again from these tables alone."""

import math
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from replication.findings import Findings
from steps.evidence_paper import OF_PAPER
from steps.evidence_studies import OF_STUDIES

DIGITS = {"rel_tol": 1e-6}  # of what is computed from tables of nine digits
DIGITS_OF_ERROR = {"rel_tol": 0.06}  # errors are published with two digits

SOURCES = {source.__name__: source for source in (*OF_PAPER, *OF_STUDIES)}
"""What draws findings from published tables, by the name of the rule that made them."""

UNDRAWN = {
    "allen_histories": "peaks of histories, of which no table is published",
    "mechanism_admissible": "its table has a row for each of 8832 pulses",
    "mechanism_forces": "theorems",
    "reversals_check": "a sample that other solvers judge",
    "rocking_spectra": "its table has a row for each record and structure",
    "scale_effects": "two outcomes",
    "spectra_dimensional": "one amplitude, of the spectra",
    "stability": "rankings, which have no table",
    "statements": "single statements, which have no table",
    "verification": "a sample that other solvers judge",
}
"""Why no published table determines the findings of the other rules."""


def evidence(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the findings that do not follow from their tables."""

    def table(name: str) -> pd.DataFrame:
        return pd.read_csv(folder / f"{name}.csv")

    for rule in unlisted(findings, published_studies(folder))[0]:
        yield (
            f"findings/{rule}.json: nothing draws these findings from a table; expected {rule} in "
            "OF_PAPER or OF_STUDIES, or the reason in UNDRAWN of src/steps/evidence.py"
        )
    for rule in SOURCES.keys() & findings.keys():
        for name, key, expected in SOURCES[rule](table):
            finding = findings[rule].by_name.get(name)
            found = finding.entries.get(key) if finding else None
            if not same(found, expected, DIGITS_OF_ERROR if key == "error" else DIGITS):
                yield (
                    f"findings/{rule}.json: {name}.{key} is {found}, and {expected} by the "
                    "published table that it was drawn from"
                )


def published_studies(folder: Path) -> list[str]:
    """Return the names of the studies of the published edition, each of which has its config."""
    return sorted(path.stem for path in folder.glob("studies/*.yaml"))


def unlisted(rules: Iterable[str], studies: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the rules of which neither SOURCES nor UNDRAWN has an entry.

    First those of the paper and of studies that these lists know, of which nothing may be missing;
    then those of other studies, which need no entry to be published.
    """
    listed = {*SOURCES, *UNDRAWN}
    heads = [f"{study}_" for study in studies]
    new = tuple(head for head in heads if not any(name.startswith(head) for name in listed))
    missing = sorted({*rules} - listed)
    others = [rule for rule in missing if rule.startswith(new)]
    return [rule for rule in missing if rule not in others], others


def same(found: Any, expected: Any, digits: Mapping[str, float]) -> bool:
    """Whether a finding's entry is the expected one; of a mapping, the keys that are expected."""
    if isinstance(expected, Mapping):
        return isinstance(found, Mapping) and all(
            same(found.get(key), value, digits) for key, value in expected.items()
        )
    if isinstance(expected, list):
        return (
            isinstance(found, list)
            and len(found) == len(expected)
            and all(same(one, other, digits) for one, other in zip(found, expected, strict=True))
        )
    if isinstance(expected, bool | np.bool_ | str):
        return type(found) in (bool, str) and found == expected
    is_number = isinstance(found, int | float) and not isinstance(found, bool)
    return is_number and math.isclose(found, expected, **digits)
