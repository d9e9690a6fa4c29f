"""Judge one claim: `snakemake --cores 2 claim_<id>` computes its finding and prints its line."""

import sys
from typing import Any

from replication.claim import Claim
from replication.digits import decimals
from replication.findings import Finding, Findings, read_findings
from replication.ledger import finding_of
from replication.verdicts import verdict_on
from replication.workbench import run


def verdict_line(claim: Claim, finding: Finding | None, verdict: str) -> str:
    """Return the line of a claim: its verdict, with the reason in brackets."""
    printed = "" if claim.printed is None else f"printed {claim.printed}, "
    if finding is None:
        grounds = claim.remark
    elif finding.not_tested:
        grounds = finding.not_tested
    elif finding.value is not None:
        unit = claim.unit or finding.unit
        beside = finding.error, claim.printed, claim.tolerance
        number = decimals(finding.value, *beside)
        grounds = f"{printed}computed {number} ± {finding.error:.1g} {unit}".strip()
        if finding.meant_value is not None and verdict not in ("confirmed", "refuted"):
            grounds += (
                f"; what is meant gives {decimals(finding.meant_value, *beside)} {unit}".rstrip()
            )
    else:
        meaning = {
            "qualified": f"holds under a condition: {claim.remark}",
            "refuted": "does not hold",
        }
        if finding.kind:
            meant = f"does not hold as printed ({finding.kind}); what is meant does"
            meaning |= {"slip": meant, "misprint": meant}
        grounds = printed + meaning.get(verdict, "holds")
    line = f"{claim.id}: {verdict} ({grounds})"
    if verdict == claim.expected:
        return line
    if finding is not None and finding.not_tested:
        return f"{line}; a full run tests it and expects {claim.expected}"
    return f"{line}; expected {claim.expected}"


def work(job: Any) -> None:
    claim = job.params.claim
    findings = read_findings(job.input.findings[0]) if claim.finding else Findings({})
    finding = finding_of(claim, findings)
    verdict = verdict_on(claim, finding)
    line = verdict_line(claim, finding, verdict)
    print(line)
    sys.__stdout__.reconfigure(errors="replace")  # a terminal may know no ± or °
    print(line, file=sys.__stdout__, flush=True)
    is_untested = finding is not None and finding.not_tested
    if verdict != claim.expected and not is_untested:
        raise SystemExit(1)


if __name__ == "__main__":
    run(snakemake, work)
