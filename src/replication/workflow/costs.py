"""What the jobs of a published run cost."""

import csv
import re
from pathlib import Path

_SHARD = re.compile(r"_\d+-of-\d+$")


def read_costs(path: Path) -> dict[str, tuple[float, float]]:
    """Return seconds and megabytes of each job, by its name; none before the first edition.

    A shard's name ends with _1-of-4, for example.
    """
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {row["rule"]: (float(row["seconds"]), float(row["memory_mb"])) for row in rows}


def longest_jobs(path: Path) -> dict[str, float]:
    """Return the seconds of the longest job of each rule, from the same table."""
    longest: dict[str, float] = {}
    for name, (seconds, _) in read_costs(path).items():
        rule = _SHARD.sub("", name)
        longest[rule] = max(longest.get(rule, 0.0), seconds)
    return longest
