"""What the jobs of a published run cost."""

import csv
from pathlib import Path


def read_costs(path: Path) -> dict[str, tuple[float, float]]:
    """Return seconds and megabytes of each job, by its name; none before the first edition.

    A shard's name ends with _1-of-4, for example.
    """
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {row["rule"]: (float(row["seconds"]), float(row["memory_mb"])) for row in rows}
