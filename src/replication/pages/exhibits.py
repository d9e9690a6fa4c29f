"""The page docs/exhibits.md: for each figure its script and tables, and what these cost."""

import csv
from collections.abc import Iterable, Mapping
from math import fsum
from pathlib import Path, PurePath
from typing import Any

from replication.workflow.provenance import Job, makers

HEAD = """\
# From figure to table to cost

`make publish` writes this page from the workflow, the captions, `docs/costs.csv` and
`docs/figures.csv`. Figures with S are in the supplement, the others in the article. Time is that of
all jobs that the figure needs, one after another, in the published run. Memory is that of the
largest of these jobs. Times of less than a second are not listed.

| figure | title | drawn by | from | computed by | time in s | memory in MB |
|---|---|---|---|---|---|---|
"""


def exhibits_page(
    jobs: Iterable[Job],
    captions: Mapping[str, Mapping[str, Any]],
    costs: Mapping[str, tuple[float, float]],
    numbers: Mapping[str, str],
) -> str:
    """Return the page: a row for each result with a caption, in the order of the figures.

    Captions and numbers are by the paths of the results, the numbers in their order; the jobs are
    those of `rule all`, and their costs those of `replication.workflow.costs.read_costs`.
    """
    made = makers(jobs)
    rows = []
    for path in filter(captions.__contains__, {**numbers, **captions}):
        caption, job = captions[path], made[path]
        tables = sorted(each for each in job.inputs if each in made and each.endswith(".csv"))
        scripts = {script: None for table in tables for script in made[table].scripts}
        needed = [costs[name] for name in _measured(path, made) if name in costs]
        seconds = fsum(cost[0] for cost in needed)  # whatever their order: they are of a set
        memory = max((cost[1] for cost in needed), default=0)
        cells = (
            numbers.get(path, ""),
            caption["title"].replace("|", "\\|"),
            _linked(job.scripts),
            ", ".join(f"`{PurePath(table).name}`" for table in tables),
            _linked(scripts),
            f"{seconds:.0f}" if seconds >= 1 else "",
            f"{memory:.0f}" if seconds >= 1 else "",
        )
        rows.append("| " + " | ".join(cells) + " |\n")
    return HEAD + "".join(rows)


def _measured(path: str, made: Mapping[str, Job]) -> set[str]:
    """Return the names of the benchmarks of the jobs that an output needs, directly or not."""
    waiting, seen = [path], set()
    while waiting:
        if (each := waiting.pop()) in made and each not in seen:
            seen.add(each)
            waiting += made[each].inputs
    logs = [PurePath(log) for each in seen for log in made[each].logs]
    return {log.stem for log in logs if log.suffix == ".tsv"}


def read_numbers(path: Path) -> dict[str, str]:
    """Return the numbers of the figures, by their paths; none where they are not published yet."""
    if not path.is_file():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        return {row["figure"]: row["number"] for row in csv.DictReader(file)}


def _linked(scripts: Iterable[str]) -> str:
    return ", ".join(f"[`{path}`](../{path})" for path in scripts)
