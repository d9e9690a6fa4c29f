"""Fail when a verdict is not the expected one, and name the claim; else count the verdicts."""

import csv
import json
from collections import Counter
from pathlib import Path

from replication.claims import unexpected
from replication.step import log_to, publish, stop
from replication.verdicts import VERDICTS


def summary(rows: list[dict], comparison: list[dict]) -> str:
    """Return how many claims of the paper, of ours and of each study have each verdict."""
    lines = []
    for part in dict.fromkeys(row["part"] for row in rows):
        count = Counter(row["verdict"] for row in rows if row["part"] == part)
        counts = ", ".join(f"{count[verdict]} {verdict}" for verdict in VERDICTS if count[verdict])
        differ = sum(bool(row["differs"]) for row in rows if row["part"] == part)
        lines.append(f"{part}: {counts}" + (f" (our copy differs in {differ})" if differ else ""))
    agree = sum(table["verdict"] == "agrees" for table in comparison)
    lines.append(
        f"tables: {agree} of {len(comparison)} agree with the published ones, others not compared"
    )
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        rows = json.loads(Path(snakemake.input.claims).read_text("utf-8"))
        comparison = [
            *csv.DictReader(Path(snakemake.input.comparison).read_text("utf-8").splitlines())
        ]
        wrong = unexpected(rows) + [
            f"{row['table']} differs from {row['published']} in {row['departs']}"
            for row in comparison
            if row["verdict"] == "differs"
        ]
        if wrong:
            stop("\n".join(wrong))
        publish(snakemake, {snakemake.output[0]: summary(rows, comparison)})
