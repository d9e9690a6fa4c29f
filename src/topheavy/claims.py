"""The verdict on a claim of the paper, from what was computed. Nothing is confirmed by hand.

A claim is a row of the ledger: something that the paper prints, in our words. A finding is what a
rule of the workflow computed for it: a value with its error, a truth, or why it could not.
"""

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any, Literal, get_args

Verdict = Literal["confirmed", "qualified", "misprint", "refuted", "not tested"]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)

LARGEST_SHARE_OF_TOLERANCE = 0.1
"""The error of a computed value may take this share of the claim's tolerance."""


def judge(claim: Mapping[str, Any], finding: Mapping[str, Any] | None) -> Verdict:
    """Return the verdict on a claim.

    A printed number is confirmed when the computed value agrees within the claim's tolerance, and
    a misprint when only the value of what is meant does. A statement is confirmed when it holds, a
    misprint when only what is meant holds, and qualified when it holds only under a condition.

    Parameters
    ----------
    claim : mapping
        With `id`, and `printed` and `tolerance` where a number is claimed.
    finding : mapping or None
        With `value`, `error` and perhaps `meant_value`; or with `holds` and perhaps `meant_holds`
        or `holds_when`; or with `not_tested`, the reason, where an optional package is missing.
        None for what cannot be tested.

    Raises
    ------
    ValueError
        When the error of the value is more than a tenth of the tolerance, or the finding is of the
        wrong kind: then nothing can be said.
    """
    if finding is None or "not_tested" in finding:
        return "not tested"
    if "tolerance" in claim:
        return _judge_number(claim, finding)
    if "holds" not in finding:
        raise ValueError(f"claim {claim['id']}: the finding has no truth; expected 'holds'")
    if finding["holds"]:
        return "confirmed"
    if finding.get("meant_holds"):
        return "misprint"
    return "qualified" if finding.get("holds_when") else "refuted"


def _judge_number(claim: Mapping[str, Any], finding: Mapping[str, Any]) -> Verdict:
    if "value" not in finding:
        raise ValueError(f"claim {claim['id']}: the finding has no value; expected a number")
    tolerance = claim["tolerance"]
    if not finding["error"] <= LARGEST_SHARE_OF_TOLERANCE * tolerance:  # NaN says nothing either
        raise ValueError(
            f"claim {claim['id']}: the error is {finding['error']:.2g}; expected at most a tenth "
            f"of the tolerance of {tolerance:.2g}"
        )

    def agrees(value: float) -> bool:
        return bool(abs(value - claim["printed"]) <= tolerance)

    if agrees(finding["value"]):
        return "confirmed"
    if "meant_value" in finding and agrees(finding["meant_value"]):
        return "misprint"
    return "refuted"


def tally(verdicts: Iterable[Verdict]) -> str:
    """Return the line that closes a run: how many claims came out how."""
    count = Counter(verdicts)
    plural = {"misprint": "misprints"}
    parts = ", ".join(f"{count[verdict]} {plural.get(verdict, verdict)}" for verdict in VERDICTS)
    return f"claims: {parts}"
