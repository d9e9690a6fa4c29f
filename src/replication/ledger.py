"""The ledger: the claims of paper and studies, and the verdict on each claim from its finding."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from replication.calls import definition
from replication.strict_yaml import read_yaml
from replication.verdicts import verdict_on
from replication.workbench import CALLED

OURS = "ours"
JUDGED_BY = ("function", "rule", "finding", "expected", "remark", "by_definition")


def read_ledger(paths: Iterable[str | Path]) -> list[dict[str, Any]]:
    """Read the rows of all ledgers, the paper's first.

    `study` names the source of a claim: a study, "" for the paper, OURS for a claim of ours that
    supports claims of the paper. If a study's row has the id of an earlier claim, this row replaces
    the rule and finding that judge the claim.

    Raises
    ------
    ValueError
        When a ledger is not a list of rows with ids, contains an id twice, or a study changes the
        statement of an earlier claim.
    """
    return [row for _, row in read_rows(paths)]


def read_rows(paths: Iterable[str | Path]) -> list[tuple[Path, dict[str, Any]]]:
    """Read the same rows, each with the file that names its rule and finding."""
    rows: dict[str, tuple[Path, dict[str, Any]]] = {}
    for path in map(Path, paths):
        seen: set[str] = set()
        study = path.parent.name if path.parent.parent.name == "studies" else ""
        for row in _rows_of(path):
            if row["id"] in seen:
                raise ValueError(f"{path}: the id {row['id']!r} is given twice")
            seen.add(row["id"])
            if row["id"] not in rows:
                rows[row["id"]] = path, row | {"study": OURS if row.get("ours") else study}
                continue
            _, known = rows[row["id"]]
            others = sorted(set(row) - {"id", *JUDGED_BY})
            if others:
                raise ValueError(
                    f"{path}: {row['id']} is a claim of {known['study'] or 'the paper'}; "
                    f"expected only what it is judged by ({', '.join(JUDGED_BY)}), "
                    f"not {', '.join(others)}"
                )
            kept = {key: known[key] for key in known if key not in JUDGED_BY}
            rows[row["id"]] = path, kept | row
    return list(rows.values())


def _rows_of(path: Path) -> list[dict[str, Any]]:
    rows = read_yaml(path)
    if not isinstance(rows, list) or not rows:
        kind = "is empty" if not rows else f"holds a {type(rows).__name__}"
        raise ValueError(f"{path} {kind}; expected a list of claims, each beginning with '- id: '")
    for number, row in enumerate(rows, 1):
        if not isinstance(row, dict) or not isinstance(row.get("id"), str):
            begins = str(row.get("statement", row) if isinstance(row, dict) else row)[:60]
            raise ValueError(f"{path}: row {number} has no id ({begins}); expected '- id: a_name'")
    return rows


def finding_of(claim: Mapping[str, Any], findings: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return the finding of a claim among the findings of its rule; None if it is not tested.

    If an optional package is missing, the findings of the rule contain only the reason.

    Raises
    ------
    ValueError
        When the rule made no finding of that name.
    """
    if "finding" not in claim:
        return None
    if "not_tested" in findings:
        return dict(findings)
    if claim["finding"] not in findings or claim["finding"] == CALLED:
        raise ValueError(
            f"the claim {claim['id']} names the finding {claim['finding']!r}, "
            f"which rule {claim['rule']} does not make"
        )
    return findings[claim["finding"]]


def judged(
    claim: Mapping[str, Any], findings: Mapping[str, Mapping[str, Any]], root: str | Path = "."
) -> dict[str, Any]:
    """Return a row of the judged ledger: the claim, its finding, and the verdict.

    Parameters
    ----------
    claim
        A row of the ledger.
    findings
        The findings of each rule, by the name of the rule.
    root
        The root of the repository, in which the row's function is looked up.

    Raises
    ------
    ValueError
        When the finding cannot judge the claim, or its rule never called the row's function.
    """
    of_rule = findings.get(claim.get("rule", ""), {})
    finding = finding_of(claim, of_rule)
    verdict = verdict_on(claim, finding)
    found = finding or {}
    if found and "not_tested" not in found:
        refuse_uncalled(claim, of_rule.get(CALLED, ()), root)
    return {
        "id": claim["id"],
        "study": claim["study"],
        "where": claim["where"],
        "equation": claim.get("equation"),
        "statement": claim["statement"],
        "printed": claim.get("printed"),
        "computed": found.get("value", found.get("holds")),
        "meant": found.get("meant_value"),
        "kind": found.get("kind") or "",
        "error": found.get("error"),
        "unit": claim.get("unit", ""),
        "tolerance": claim.get("tolerance"),
        "verdict": verdict,
        "expected": claim["expected"],
        "not_tested": found.get("not_tested", ""),
        "remark": found.get("not_tested", claim.get("remark", "")),
        "function": claim.get("function", ""),
        "rule": claim.get("rule", ""),
    }


def refuse_uncalled(
    claim: Mapping[str, Any], called: Iterable[str], root: str | Path = "."
) -> None:
    """Raise ValueError when the function that a row names did not run while its rule did."""
    name = definition(claim["function"], root)
    if name not in called:
        raise ValueError(
            f"claim {claim['id']}: its rule {claim['rule']} never called {claim['function']} "
            f"({name}); expected a function that computes its finding, one of those under "
            f"'{CALLED}' in the findings of the rule"
        )
