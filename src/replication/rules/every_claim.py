"""Judge every row of the ledger by the findings of the workflow."""

from pathlib import Path
from typing import Any

from replication.judging.findings import findings_by_rule
from replication.judging.ledger import as_text, read_ledger, with_verdicts
from replication.workbench import run


def work(job: Any) -> None:
    rows = with_verdicts(read_ledger(job.input.ledger), findings_by_rule(job.input.findings))
    for row in rows:
        print(f"{row.id}: {row.verdict} (expected {row.expected})")
    Path(job.output[0]).write_text(as_text(rows), encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
