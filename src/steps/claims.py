"""The ledger judged: every row against what the workflow found."""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ledger import judged, read_ledger

from replication.workbench import run


def main(
    ledger: Iterable[Mapping[str, Any]], findings: Mapping[str, Any], root: str | Path = "."
) -> list[dict]:
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
        print(f"{claim['id']}: {rows[-1]['verdict']} (expected {claim['expected']})")
    if faults:
        raise ValueError("\n".join(faults))
    return rows


def read_findings(paths: Iterable[str | Path]) -> dict[str, dict[str, Any]]:
    """Return the findings of each rule, by the name of its file."""
    return {Path(path).stem: json.loads(Path(path).read_text(encoding="utf-8")) for path in paths}


def work(job: Any) -> None:
    rows = main(read_ledger(job.input.ledger), read_findings(job.input.findings))
    Path(job.output[0]).write_text(as_text(rows), encoding="utf-8")


def as_text(rows: list[dict]) -> str:
    """Return the judged ledger as results/claims.json has it."""
    return json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


if __name__ == "__main__":
    run(snakemake, work)
