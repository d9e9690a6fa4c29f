"""The ledger: the claims of paper and studies, and the verdict on each claim from its finding."""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from replication.inputs.strict_yaml import read_yaml
from replication.inputs.suggestions import hint
from replication.judging.calls import definition
from replication.judging.claim import Claim, JudgedClaim
from replication.judging.findings import CALLED, Finding, Findings
from replication.judging.verdicts import verdict_on

OURS = "ours"
REPRODUCED = "reproduced"
JUDGED_BY = ("function", "rule", "finding", "expected", "remark", "by_definition")


# The rows ----------------------------------------------------------------------------------------


def read_ledger(paths: Iterable[str | Path]) -> list[Claim]:
    """Read the claims of all ledgers, the paper's first.

    If a study's row has the id of an earlier claim, this row replaces the rule and finding that
    judge the claim.

    Raises
    ------
    ValueError
        When a ledger is not a list of rows with ids, contains an id twice, or a study changes the
        statement of an earlier claim. When a row has an unknown key or lacks a required one.
    """
    return [
        Claim.of(row, path, next((one for one in (OURS, REPRODUCED) if row.get(one)), study))
        for path, study, row in read_rows(paths)
    ]


def read_rows(paths: Iterable[str | Path]) -> Iterator[tuple[Path, str, dict[str, Any]]]:
    """Yield the rows of all ledgers as they are written.

    Each comes with the file that names its rule and finding, and with the study whose claim it is.
    """
    rows: dict[str, tuple[Path, str, dict[str, Any]]] = {}
    for path in map(Path, paths):
        seen: set[str] = set()
        study = path.parent.name if path.parent.parent.name == "studies" else ""
        for row in _rows_of(path):
            if row["id"] in seen:
                raise ValueError(f"{path}: the id {row['id']!r} is given twice")
            seen.add(row["id"])
            if row["id"] not in rows:
                rows[row["id"]] = path, study, row
                continue
            _, source, known = rows[row["id"]]
            others = sorted(set(row) - {"id", *JUDGED_BY})
            if others:
                raise ValueError(
                    f"{path}: {row['id']} is a claim of {source or 'the paper'}; "
                    f"expected only what it is judged by ({', '.join(JUDGED_BY)}), "
                    f"not {', '.join(others)}"
                )
            kept = {key: known[key] for key in known if key not in JUDGED_BY}
            rows[row["id"]] = path, source, kept | row
    yield from rows.values()


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


# The verdicts ------------------------------------------------------------------------------------


def finding_of(claim: Claim, findings: Findings) -> Finding | None:
    """Return the finding of a claim among the findings of its rule; None if it is not tested.

    If an optional package is missing, the findings of the rule contain only the reason.

    Raises
    ------
    ValueError
        When the rule made no finding of that name.
    """
    if not claim.finding:
        return None
    if findings.not_tested:
        return Finding.of({"not_tested": findings.not_tested})
    if claim.finding not in findings.by_name:
        raise ValueError(
            f"the claim {claim.id} names the finding {claim.finding!r}, "
            f"which rule {claim.rule} does not make; {hint(claim.finding, findings.by_name)}"
        )
    return findings[claim.finding]


def with_verdict(
    claim: Claim, findings: Mapping[str, Findings], root: str | Path = "."
) -> JudgedClaim:
    """Return the claim with the result for it and the verdict, by the findings of each rule.

    The function of the claim is looked up in the repository `root`.

    Raises
    ------
    ValueError
        When the finding cannot judge the claim, or its rule never called the claim's function.
    """
    of_rule = findings.get(claim.rule, Findings({}))
    finding = finding_of(claim, of_rule)
    verdict = verdict_on(claim, finding)
    found = finding or Finding()
    if finding and not finding.not_tested:
        name, called = definition(claim.function, root), of_rule.called
        if name not in called:
            raise ValueError(
                f"claim {claim.id}: its rule {claim.rule} never called {name}; expected a function "
                f"that computes its finding, one of those under '{CALLED}' in the findings of the "
                "rule"
            )
    given = {each.name for each in fields(JudgedClaim)} & vars(claim).keys() - {"remark"}
    return JudgedClaim(
        **{name: getattr(claim, name) for name in given},
        computed=found.holds if found.value is None else found.value,
        meant=found.meant_value,
        kind=found.kind or "",
        condition=found.entries.get("condition", "") if verdict == "qualified" else "",
        error=found.error,
        verdict=verdict,
        not_tested=found.not_tested,
        remark=found.not_tested or claim.remark,
    )


def with_verdicts(
    ledger: Iterable[Claim], findings: Mapping[str, Findings], root: str | Path = "."
) -> list[JudgedClaim]:
    """Return all claims with their results and verdicts, as `with_verdict` does for one.

    Raises
    ------
    ValueError
        With one line for each claim that its finding cannot judge.
    """
    rows, faults = [], []
    for claim in ledger:
        try:
            rows.append(with_verdict(claim, findings, root))
        except ValueError as fault:
            faults.append(str(fault))
    if faults:
        raise ValueError("\n".join(faults))
    return rows


def as_text(rows: Iterable[JudgedClaim], *, published: bool = False) -> str:
    """Return the judged ledger as results/claims.json has it, or as it is published."""
    text = [asdict(row) for row in rows]
    if published:
        usual = {each.name: each.default for each in fields(JudgedClaim)}
        text = [{key: of for key, of in row.items() if of != usual[key]} for row in text]
    return json.dumps(text, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def read_judged(path: str | Path) -> list[JudgedClaim]:
    """Read the judged ledger, results/claims.json.

    Raises
    ------
    ValueError
        When a row has other keys than those of a JudgedClaim, or lacks one without a default.
    """
    rows = []
    for row in json.loads(Path(path).read_text(encoding="utf-8")):
        try:
            rows.append(JudgedClaim(**row))
        except TypeError as fault:
            raise ValueError(f"{path}: {row.get('id')}: {fault}") from None
    return rows
