"""Judge every row of the ledger by the findings of the workflow."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from replication.judging.claim import Claim, JudgedClaim
from replication.judging.findings import Findings, findings_by_rule
from replication.judging.ledger import as_text, judged, read_ledger
from replication.workbench import run


def main(
    ledger: Iterable[Claim], findings: Mapping[str, Findings], root: str | Path = "."
) -> list[JudgedClaim]:
    """Return the judged rows; print each verdict.

    Raises
    ------
    ValueError
        With one line for each row that cannot be judged.
    """
    rows, faults = [], []
    for claim in ledger:
        try:
            rows.append(judged(claim, findings, root))
        except ValueError as fault:
            faults.append(str(fault))
            continue
        print(f"{claim.id}: {rows[-1].verdict} (expected {claim.expected})")
    if faults:
        raise ValueError("\n".join(faults))
    return rows


def work(job: Any) -> None:
    rows = main(read_ledger(job.input.ledger), findings_by_rule(job.input.findings))
    Path(job.output[0]).write_text(as_text(rows), encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
