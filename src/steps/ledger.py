"""The ledger: the claims of the paper and of the studies, and what was found for one of them."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from strict_yaml import read_yaml

JUDGED_BY = ("function", "rule", "finding", "expected", "remark")


def read_ledger(paths: Iterable[str | Path]) -> list[dict[str, Any]]:
    """Read the rows of all ledgers, the paper's first. `study` says whose it is: "" is the paper.

    A study's row that has the id of an earlier one does not stand by itself: it says by what that
    claim is judged from now on.

    Raises
    ------
    ValueError
        When a ledger has an id twice, or a study rewords what an earlier one claims.
    """
    rows: dict[str, dict[str, Any]] = {}
    for path in map(Path, paths):
        seen: set[str] = set()
        study = path.parent.name if path.parent.parent.name == "studies" else ""
        for row in read_yaml(path):
            known = rows.get(row["id"])
            if row["id"] in seen:
                raise ValueError(f"{path}: the id {row['id']!r} is given twice")
            seen.add(row["id"])
            if known is None:
                rows[row["id"]] = row | {"study": study}
                continue
            others = sorted(set(row) - {"id", *JUDGED_BY})
            if others:
                raise ValueError(
                    f"{path}: {row['id']} is a claim of {known['study'] or 'the paper'}; "
                    f"expected only what it is judged by, not {', '.join(others)}"
                )
            kept = {key: known[key] for key in known if key not in JUDGED_BY}
            rows[row["id"]] = kept | row
    return list(rows.values())


def finding_of(claim: Mapping[str, Any], findings: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return what was found for a claim among the findings of its rule; None if it is not tested.

    Where an optional package is missing, all findings of a rule are the one reason.

    Raises
    ------
    ValueError
        When the rule made no finding of that name.
    """
    if "finding" not in claim:
        return None
    if "not_tested" in findings:
        return dict(findings)
    if claim["finding"] not in findings:
        raise ValueError(
            f"the claim {claim['id']} names the finding {claim['finding']!r}, "
            f"which rule {claim['rule']} does not make"
        )
    return findings[claim["finding"]]
