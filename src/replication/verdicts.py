"""Compute the verdict on a claim from its finding. Nobody confirms a claim by hand."""

import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

from replication.claims import Claim, Verdict
from replication.digits import decimals

TITLES = {"paper": "claims of the paper", "ours": "claims of our own"}

COPY_DIFFERS = ("sign", "number", "letter", "bracket", "radical")
"""Kinds of discrepancy by which our copy can contradict the paper's own premises."""

LARGEST_SHARE_OF_TOLERANCE = 0.1
"""The error of a computed value may take this share of the claim's tolerance."""


def verdict_on(claim: Claim, finding: Mapping[str, Any] | None) -> tuple[str, str]:
    """Return the verdict on a claim, and by what our copy of the paper differs, or "".

    A printed number is confirmed when the computed value agrees within the claim's tolerance, and a
    statement when it holds. A statement that holds on a stated condition alone is qualified. If the
    form in our copy fails, and what the premises of the paper mean holds, the meaning is judged and
    the discrepancy named. A statement that only a measurement could confirm is at most supported. A
    claim that is not tested keeps the discrepancy that it names.

    Raises
    ------
    ValueError
        When the error of the value is more than a tenth of the tolerance, or the finding is of the
        wrong kind.
    """
    if claim.expected in ("by definition", "not tested"):
        if finding is not None:
            raise ValueError(f"claim {claim.id} is {claim.expected}; expected no finding for it")
        return claim.expected, claim.differs
    if finding is None:
        raise ValueError(f"claim {claim.id} has no finding; expected one, or 'not tested'")
    if claim.tolerance is not None:
        holds, meant = _numbers_agree(claim, finding, claim.tolerance)
    elif "holds" not in finding:
        raise ValueError(f"claim {claim.id}: the finding has no truth; expected truth(…)")
    else:
        holds, meant = finding["holds"], finding.get("meant_holds", False)
    if holds:
        return ("supported" if claim.expected == "supported" else "confirmed"), ""
    if meant:
        kind = finding.get("kind")
        if kind not in COPY_DIFFERS:
            raise ValueError(
                f"claim {claim.id}: what is meant holds, and the kind of the discrepancy is "
                f"{kind!r}; expected one of {', '.join(COPY_DIFFERS)}"
            )
        return "confirmed", kind
    return ("qualified" if finding.get("holds_when") else "refuted"), ""


def _numbers_agree(claim: Claim, finding: Mapping, tolerance: float) -> tuple[bool, bool]:
    if "value" not in finding:
        raise ValueError(f"claim {claim.id}: the finding has no value; expected value(…)")
    if not finding["error"] <= LARGEST_SHARE_OF_TOLERANCE * tolerance:  # nor is NaN small enough
        raise ValueError(
            f"claim {claim.id}: the error is {finding['error']:.2g}; expected at most a tenth "
            f"of the tolerance of {tolerance:.2g}"
        )

    def agrees(value: float | None) -> bool:
        return value is not None and bool(abs(value - claim.printed) <= tolerance)

    return agrees(finding["value"]), agrees(finding.get("meant_value"))


def counted(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return how many claims have each verdict, and how many of them in a mended form."""
    count = Counter(row["verdict"] for row in rows)
    mended = sum(row["verdict"] == "confirmed" and bool(row["differs"]) for row in rows)
    return ", ".join(
        f"{count[verdict]} {verdict}"
        + (f" ({mended} in a mended form)" if verdict == "confirmed" and mended else "")
        for verdict in get_args(Verdict)
        if count[verdict]
    )


def judged(claim: Claim, findings: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return a claim with what was computed for it, its verdict, and whether our copy differs.

    Raises
    ------
    SystemExit
        When the rule makes no such finding, or the finding cannot judge the claim.
    """
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
