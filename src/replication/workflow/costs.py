"""What the jobs of a published run cost, and how long the paths through them are."""

import csv
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from replication.workflow.internals import timed_by, users_of


def read_costs(path: Path) -> dict[str, tuple[float, float]]:
    """Return seconds and megabytes of each job, by its name; none before the first edition.

    A shard's name ends with _1-of-4, for example.
    """
    if not path.exists():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {row["rule"]: (float(row["seconds"]), float(row["memory_mb"])) for row in rows}


def paths(
    rules: Iterable[Any], took: Mapping[str, tuple[float, float]]
) -> Iterator[tuple[Any, float]]:
    """Yield each rule with the time of the longest path from its begin to the end of a run, s."""
    users = users_of(rules)

    @cache
    def left(rule: Any) -> float:
        own = max((took[name][0] for name in timed_by(rule, took)), default=0.0)
        return own + max(map(left, users[rule]), default=0.0)

    return ((rule, left(rule)) for rule in users)
