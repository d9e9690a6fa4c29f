"""Compute the verdict on a claim of the paper. Nobody confirms a claim by hand.

A claim is a row of the ledger: a statement of the paper in our words. A finding is the result of a
rule for this claim: a value with its error, a truth value, or the reason why it was not computed.
"""

import math
from collections import Counter
from collections.abc import Iterable
from decimal import Decimal
from typing import Literal, get_args

from replication.judging.claim import Claim, JudgedClaim
from replication.judging.findings import Finding
from replication.judging.misprints import one_slip_apart

Verdict = Literal[
    "confirmed", "qualified", "slip", "misprint", "refuted", "by definition", "not tested"
]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)

PLURALS = {"slip": "slips", "misprint": "misprints"}

KINDS: dict[str, Verdict] = {
    "sign": "misprint",
    "number": "misprint",
    "letter": "slip",
    "bracket": "slip",
    "radical": "slip",
    "convention": "qualified",
}
"""The verdict if the printed form fails and the intended form holds, by the kind of discrepancy."""

LARGEST_SHARE_OF_TOLERANCE = 0.1
"""The error of a computed value may take this share of the claim's tolerance."""

LARGEST_RELATIVE_TOLERANCE = 0.1
"""A tolerance is at most this share of the printed value, or the rounding of its last digit."""


def verdict_on(claim: Claim, finding: Finding | None) -> Verdict:
    """Return the verdict on a claim.

    A printed number is confirmed when the computed value agrees within the claim's tolerance, and
    a statement when it holds. A statement that holds only under a stated condition is qualified.
    If the printed form fails and the intended form holds, the kind of discrepancy decides
    (`KINDS`). Of a number, either the premises are misprinted: as they are meant, they give the
    printed number. Or the number itself is: the meant one agrees with the computed value, and one
    slip turns it into the printed one (`misprints`). A number that is further off is refuted. A
    claim that cannot be false has no finding, nor has one that is not tested.

    Raises
    ------
    ValueError
        When the error of the value is more than a tenth of the tolerance, or the finding is of the
        wrong kind.
    """
    if claim.by_definition:
        if finding is not None:
            raise ValueError(f"claim {claim.id} holds by definition; expected no finding for it")
        return "by definition"
    if finding is None or finding.not_tested:
        return "not tested"
    if claim.tolerance is not None:
        return _judge_number(claim, finding, claim.tolerance)
    if finding.holds is None:
        raise ValueError(f"claim {claim.id}: the finding has no truth; expected 'holds'")
    if finding.holds:
        return "confirmed"
    if finding.meant_holds:
        return _by_kind(claim, finding.kind)
    return "qualified" if finding.holds_when else "refuted"


def _judge_number(claim: Claim, finding: Finding, tolerance: float) -> Verdict:
    if finding.value is None:
        raise ValueError(f"claim {claim.id}: the finding has no value; expected a number")
    if not finding.error <= LARGEST_SHARE_OF_TOLERANCE * tolerance:  # nor is NaN small enough
        raise ValueError(
            f"claim {claim.id}: the error is {finding.error:.2g}; expected at most a tenth "
            f"of the tolerance of {tolerance:.2g}"
        )

    def agrees(value: float | None) -> bool:
        return value is not None and bool(abs(value - claim.printed) <= tolerance)

    if agrees(finding.value):
        return "confirmed"
    if agrees(finding.meant_value) or _is_misprinted(claim, finding, tolerance):
        return _by_kind(claim, "number" if finding.kind is None else finding.kind)
    return "refuted"


def _is_misprinted(claim: Claim, finding: Finding, tolerance: float) -> bool:
    """Return whether the number that is meant is the computed one, and one slip from the print."""
    if finding.meant_value is None or not abs(finding.meant_value - finding.value) <= tolerance:
        return False
    last_digit = 2.0 * min(print_rounding(claim.printed), tolerance)  # 3.50 is kept as 3.5
    decimals = max(0, round(-math.log10(last_digit)))
    return one_slip_apart(claim.printed, finding.meant_value, decimals)


def _by_kind(claim: Claim, kind: str | None) -> Verdict:
    if kind not in KINDS:
        raise ValueError(
            f"claim {claim.id}: what is meant holds, and the kind of the discrepancy is "
            f"{kind!r}; expected one of {', '.join(KINDS)}"
        )
    return KINDS[kind]


def print_rounding(printed: float) -> float:
    """Return half a unit of the last digit of a printed number: 0.0005 of 0.275, 0.5 of 5.

    A trailing zero is not kept by YAML: 0.50 counts as 0.5.
    """
    exponent = Decimal(repr(printed)).normalize().as_tuple().exponent
    return 0.5 * 10.0 ** min(int(exponent), 0)


def tolerance_fault(claim: Claim) -> str:
    """Return why the tolerance of a claim is too wide for its verdict to mean anything, or "".

    A value that is off by a whole unit of the last printed digit, twice what rounding allows, has
    to fail.
    """
    if claim.tolerance is None:
        return ""
    printed, tolerance = claim.printed, claim.tolerance
    rounding = print_rounding(printed)
    widest = LARGEST_RELATIVE_TOLERANCE * abs(printed)
    if tolerance > max(widest, rounding):
        return (
            f"tolerance {tolerance:g} is more than a tenth of the printed {printed:g} and than the "
            f"rounding of the print; expected at most {max(widest, rounding):g}"
        )
    if tolerance >= 2.0 * rounding:
        return (
            f"tolerance {tolerance:g} would confirm a value twice as far off as the digits of the "
            f"printed {printed:g} allow; expected less than {2.0 * rounding:g}"
        )
    return ""


def by_origin(rows: Iterable[JudgedClaim]) -> dict[str, list[str]]:
    """Return the verdicts of judged rows, apart for the paper and for each study."""
    verdicts: dict[str, list[str]] = {"paper": []}
    for row in rows:
        verdicts.setdefault(row.study or "paper", []).append(row.verdict)
    return verdicts


def tallies(rows: Iterable[JudgedClaim]) -> list[str]:
    """Return the closing lines of a run: of the paper, and of each study, how many verdicts."""
    lines = []
    for name, verdicts in by_origin(rows).items():
        count = Counter(verdicts)
        words = {v: v if count[v] == 1 else PLURALS.get(v, v) for v in VERDICTS}
        lines.append(f"{name}: " + ", ".join(f"{count[v]} {words[v]}" for v in VERDICTS))
    return lines
