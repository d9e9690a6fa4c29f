"""Read claims, and judge each by its finding."""

import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import StrictInt, ValidationError

from replication.config import Number, Positive, Section, read_yaml
from replication.numbers import inputs, without_marks

TITLES = {"paper": "claims of the paper", "ours": "claims of our own"}


BRACES = re.compile(r"\{\w+(?:\[[\w.]+\])*(?::[^{}]*)?\}")
"""A number of the config in a text; any other brace is text."""


class Entry(Section):
    """A claim as in its file; the head of paper/claims.yaml explains the keys."""

    id: str
    where: str
    statement: str
    printed: StrictInt | Number | str | None = None
    unit: str = ""
    tolerance: Positive | None = None
    rule: str = ""
    finding: str = ""
    expected: str
    differs: str = ""
    remark: str = ""


class Claim(Entry):
    """A claim of a list, `part`: paper or ours.

    `marked` has statement and remark with the marks of their numbers.
    """

    marked: dict[str, str] | None = None
    part: str = ""
    file: str = ""


def read_claims(path: str, settings: Mapping[str, Any]) -> list[Claim]:
    """Return the claims of a file; {keys} in statement and remark are filled from its config.

    The file has two lists, `paper` and `ours`.

    Raises
    ------
    SystemExit
        When a claim has an unknown key, lacks one, or has the id of another; when its statement
        names a key that the config lacks; when its tolerance is too wide, or its verdict unknown.
    """
    from replication.verdicts import VERDICTS, tolerance_fault

    content = read_yaml(path)
    known = inputs(settings)
    claims: list[Claim] = []
    for part, rows in content.items():
        if not isinstance(rows, list):
            raise SystemExit(f"{path} has {rows!r:.40}; expected a list of claims")
        for number, row in enumerate(rows, 1):
            name = row.get("id") if isinstance(row, dict) else f"number {number} of {part}"
            try:
                claim = Claim(**Entry.model_validate(row).model_dump(), part=part, file=path)
                claim.marked = {
                    name: BRACES.sub(lambda key: key[0].format(**known), getattr(claim, name))
                    for name in ("statement", "remark")
                }
                claim.statement, claim.remark = map(without_marks, claim.marked.values())
            except ValidationError as errors:
                faults = "; ".join(
                    f"'{'.'.join(map(str, e['loc']))}': {e['msg']}" for e in errors.errors()
                )
                raise SystemExit(f"{path}: claim {name}: {faults}") from None
            except (KeyError, IndexError) as key:
                raise SystemExit(
                    f"{path}: claim {name} has {{{key.args[0]}}}, which is no key of the "
                    f"config; expected one of {', '.join(settings)}"
                ) from None
            except (TypeError, ValueError) as error:
                raise SystemExit(f"{path}: claim {name}: {error}, in a number of braces") from None
            fault = tolerance_fault(claim)
            if claim.id in [each.id for each in claims]:
                fault = "the id is there twice"
            if claim.expected not in VERDICTS:
                fault = f"expected is {claim.expected!r}; expected one of {', '.join(VERDICTS)}"
            is_judged = claim.expected not in ("by definition", "not tested")
            if bool(claim.rule and claim.finding) != is_judged:
                fault = (
                    "a claim names a rule and a finding, unless it is by definition or not tested"
                )
            if fault:
                raise SystemExit(f"{path}: claim {claim.id}: {fault}")
            claims.append(claim)
    return claims


def judged(claim: Claim, findings: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return a claim with what was computed for it, its verdict, and whether our copy differs.

    Raises
    ------
    SystemExit
        When the rule makes no such finding, or the finding cannot judge the claim.
    """
    from replication.verdicts import decimals, verdict_on

    finding = None
    if claim.finding:
        if claim.finding not in findings.get(claim.rule, {}):
            known = ", ".join(findings.get(claim.rule, {})) or "none: no such rule"
            raise SystemExit(
                f"{claim.file}: claim {claim.id} names the finding '{claim.finding}' of rule "
                f"{claim.rule}, which has {known}. Name one of these, or return it from findings() "
                "of the script of the rule"
            )
        finding = findings[claim.rule][claim.finding]
    try:
        verdict, differs = verdict_on(claim, finding)
    except ValueError as fault:
        raise SystemExit(f"{claim.file}: {fault}") from None
    row = claim.model_dump() | {
        "verdict": verdict,
        "differs": differs,
        "expected_differs": claim.differs,
        "computed": None,
        "shown": "",
    }
    if finding is not None:
        row["condition"] = finding.get("condition", "")
        row["computed"] = finding.get("value", finding.get("holds"))
        if "value" in finding:
            number = decimals(finding["value"], finding["error"], claim.printed, claim.tolerance)
            row["shown"] = f"{number} {claim.unit or finding['unit']}".strip()
    return row


def read_findings(paths: Iterable[str | Path]) -> dict[str, dict[str, Any]]:
    """Return the findings of several rules; a file has the name of its rule."""
    return {Path(path).stem: json.loads(Path(path).read_text("utf-8")) for path in paths}


def counts(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """Return a line for each list of claims: how many have each verdict."""
    from replication.verdicts import counted

    lists: dict[str, list] = {}
    for row in rows:
        lists.setdefault(row["part"], []).append(row)
    return [f"{TITLES[part]}: {counted(members)}" for part, members in lists.items()]


def unexpected(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """Return a line for each claim whose verdict, or flag, is not the expected one."""
    return [
        f"{row['file']}: verdict of {row['id']} is {_verdict(row, 'verdict', 'differs')}, expected "
        f"{_verdict(row, 'expected', 'expected_differs')} (computed: "
        f"{row['shown'] or row['computed']}): set `expected`, or look for the cause"
        for row in rows
        if row["verdict"] != row["expected"] or row["differs"] != row["expected_differs"]
    ]


def _verdict(row: Mapping[str, Any], verdict: str, differs: str) -> str:
    return row[verdict] + (f" (our copy differs: {row[differs]})" if row.get(differs) else "")
