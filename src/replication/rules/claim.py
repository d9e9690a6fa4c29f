"""One claim alone: `snakemake --cores 2 claim_<id>` computes it and prints its line."""

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from replication.ledger import finding_of
from replication.verdicts import verdict_on
from replication.workbench import run


def verdict_line(claim: Mapping[str, Any], finding: Mapping[str, Any] | None, verdict: str) -> str:
    """Return the line of a claim: its verdict, and in brackets what that rests on."""
    printed = f"printed {claim['printed']}, " if "printed" in claim else ""
    if finding is None:
        grounds = claim["remark"]
    elif "not_tested" in finding:
        grounds = finding["not_tested"]
    elif "value" in finding:
        unit = claim.get("unit", finding.get("unit", ""))
        grounds = (
            f"{printed}computed {finding['value']:.6g} ± {finding['error']:.1g} {unit}".strip()
        )
        if "meant_value" in finding and verdict not in ("confirmed", "refuted"):
            grounds += f"; what is meant gives {finding['meant_value']:.6g} {unit}".rstrip()
    else:
        meaning = {
            "qualified": f"holds under a condition: {claim.get('remark', '')}",
            "refuted": "does not hold",
        }
        if finding.get("kind"):
            meant = f"does not hold as printed ({finding['kind']}); what is meant does"
            meaning |= {"slip": meant, "misprint": meant}
        grounds = printed + meaning.get(verdict, "holds")
    line = f"{claim['id']}: {verdict} ({grounds})"
    if verdict == claim["expected"]:
        return line
    if finding is not None and "not_tested" in finding:
        return f"{line}; a full run tests it and expects {claim['expected']}"
    return f"{line}; expected {claim['expected']}"


def work(job: Any) -> None:
    claim = job.params.claim
    findings = {
        key: finding
        for path in job.input.findings
        for key, finding in json.loads(Path(path).read_text(encoding="utf-8")).items()
    }
    finding = finding_of(claim, findings)
    verdict = verdict_on(claim, finding)
    is_untested = finding is not None and "not_tested" in finding
    line = verdict_line(claim, finding, verdict)
    print(line)
    sys.__stdout__.reconfigure(errors="replace")  # a terminal may know no ± or °
    print(line, file=sys.__stdout__, flush=True)
    if verdict != claim["expected"] and not is_untested:
        raise SystemExit(1)


if __name__ == "__main__":
    run(snakemake, work)
