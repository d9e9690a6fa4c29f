"""What the jobs of a published run cost."""

import csv
import re
from pathlib import Path

_SHARD = re.compile(r"_\d+-of-\d+$")


def longest_jobs(costs: Path) -> dict[str, float]:
    """Return the seconds of the longest job of each rule; none before the first edition.

    Parameters
    ----------
    costs
        Table of the columns rule and seconds. A shard's name ends with _1-of-4, for example.
    """
    longest: dict[str, float] = {}
    if costs.exists():
        with costs.open(encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                rule = _SHARD.sub("", row["rule"])
                longest[rule] = max(longest.get(rule, 0.0), float(row["seconds"]))
    return longest
