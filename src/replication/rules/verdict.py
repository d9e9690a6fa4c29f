"""End a run: print the verdicts, and fail if a verdict differs from the expected one."""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from replication.judging.claim import JudgedClaim
from replication.judging.findings import Finding, read_findings
from replication.judging.ledger import read_judged
from replication.judging.verdicts import tallies
from replication.workbench import run


def main(
    claims: Sequence[JudgedClaim], comparison: pd.DataFrame, checks: Mapping[str, Finding]
) -> tuple[str, list[str]]:
    """Return the lines that close the run, the paper's and each study's, and what is wrong.

    `checks` are findings that are no claims of anybody, and have to hold all the same.
    """
    faults = [
        f"claim {row.id} is {row.verdict}; expected {row.expected}{_numbers(row)}"
        for row in claims
        if row.verdict != row.expected and not row.not_tested
    ]
    faults += [
        f"{row.result} differs from {row.published} in {row.departs}: if it is meant to, copy it "
        "there, run again, and make publish"
        for row in comparison.itertuples()
        if row.verdict == "differs"
    ]
    faults += [
        f"our own check {name} does not hold: {_evidence(finding)}"
        for name, finding in checks.items()
        if not finding.holds
    ]
    reasons = Counter(row.not_tested for row in claims if row.not_tested)
    lines = [f"{count} claims not tested here: {reason}" for reason, count in reasons.items()]
    skipped = comparison[comparison.verdict.astype(str).str.startswith("not compared")]
    for reason, rows in skipped.groupby("verdict", sort=False):
        names = ", ".join(path.removeprefix("results/") for path in rows.result)
        lines.append(f"{len(rows)} of {len(comparison)} published results {reason}: {names}")
    return "\n".join([*lines, *tallies(claims)]), faults


def _numbers(row: JudgedClaim) -> str:
    """Return what was printed and what was computed, for a claim of a number."""
    if isinstance(row.computed, bool) or row.computed is None:
        return ""
    return f" (printed {row.printed}, computed {row.computed:.6g} {row.unit}".rstrip() + ")"


def _evidence(finding: Finding) -> str:
    entries = (f"{name} = {entry}" for name, entry in finding.entries.items() if name != "holds")
    return ", ".join(entries) or "no evidence given"


def work(job: Any) -> None:
    checks = {
        f"{rule}.{name}": read_findings(f"results/findings/{rule}.json")[name]
        for rule, names in job.params.checks.items()
        for name in names
    }
    lines, faults = main(read_judged(job.input.claims), pd.read_csv(job.input.comparison), checks)
    if faults:
        raise SystemExit("\n".join([*faults, lines]))
    text = f"report: paper/report.pdf\n{lines}\n"
    Path(job.output[0]).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
