"""The tables and findings of this run beside those that are published in tests/reference/.

The config of this run is kept beside the comparison, for the report and for `make publish`, and so
are the parameters and inputs of its jobs. A result is compared unless these differ from those of
the published run, in its job or in one upstream.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pandas as pd
import yaml

from replication.judging.findings import read_findings
from replication.workbench import run, write_table

COLUMNS = ["result", "published", "verdict", "departs"]
ERRORS = 0.1
"""By how much of it an error may differ from the published one, which has two digits."""


def departures(ours: pd.DataFrame, theirs: pd.DataFrame, bounds: Mapping) -> Iterator[str]:
    """Yield each column in which a table departs from the published one.

    A number may differ by `relative` of it or by `absolute`, a whole number also by `counts`, if
    the bounds have that; the error of a finding by `ERRORS` of it.
    """
    for name in [*theirs, *(name for name in ours if name not in theirs)]:
        if name not in ours or name not in theirs:
            yield f"{name} (only {'here' if name in ours else 'published'})"
            continue
        whole = all(pd.api.types.is_integer_dtype(one[name]) for one in (ours, theirs))
        absolute = bounds.get("counts", 0) if whole else bounds["absolute"]
        try:
            pd.testing.assert_series_equal(
                ours[name],
                theirs[name],
                check_dtype=False,
                rtol=ERRORS if name.endswith(".error") else bounds["relative"],
                atol=absolute,
            )
        except AssertionError:
            yield name


def read(path: str | Path) -> pd.DataFrame:
    """Return a table, or findings as one row with an entry of evidence in each column."""
    if Path(path).suffix == ".csv":
        return pd.read_csv(path)
    found = read_findings(path).as_json()
    return pd.DataFrame([dict(_entries("", {name: found[name] for name in read_findings(path)}))])


def _entries(name: str, entry: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(entry, Mapping | list):
        items = entry.items() if isinstance(entry, Mapping) else enumerate(entry)
        for key, inner in items:
            yield from _entries(f"{name}.{key}".removeprefix("."), inner)
    else:
        yield name, entry


def main(
    results: Mapping[str, str],
    origins: Mapping[str, Mapping[str, str]],
    published: Mapping[str, str] | None,
    bounds: Mapping,
) -> list[dict]:
    """Return a row for each result: whether it agrees with what is published, or why neither.

    `results` are the paths of ours and of the published; `origins` the jobs of each of ours with
    checksums, its own the last; `published` those of the published run, None if it kept none.
    Bounds are those of tables; whatever else is published has `bounds["sampled"]`.
    """
    own = {path: [*jobs][-1] for path, jobs in origins.items()}
    untested = {
        own[path]: reason
        for path in results
        if path.endswith(".json") and (reason := read_findings(path).not_tested)
    }
    tables = {own[path] for path, there in results.items() if Path(there).match("reference/*.csv")}
    rows = []
    for path, there in results.items():
        others = published if published is not None else origins[path]
        changed = [job for job, value in origins[path].items() if others.get(job) != value]
        columns = []
        if changed:
            verdict = f"not compared: parameters or inputs differ of {', '.join(changed)}"
        elif reasons := [untested[job] for job in origins[path] if job in untested]:
            verdict = f"not compared: {reasons[0]}"
        else:
            strict = Path(there).match("reference/*.csv") or (
                there.endswith(".json") and own[path] in tables
            )
            within = bounds if strict else bounds.get("sampled", bounds)
            columns = list(departures(read(path), read(there), within))
            verdict = "differs" if columns else "agrees"
        rows.append(dict(zip(COLUMNS, (path, there, verdict, ", ".join(columns)), strict=True)))
        print(f"{path}: {verdict} {rows[-1]['departs']}")
    return rows


def work(job: Any) -> None:
    published = Path("tests/reference/origins.json")
    jobs = {name: value for each in job.params.origins.values() for name, value in each.items()}
    Path(job.output.origins).write_text(json.dumps(jobs, indent=1, sort_keys=True) + "\n", "utf-8")
    known = json.loads(published.read_text("utf-8")) if published.is_file() else None
    used = job.params.config
    rows = main(job.params.results, job.params.origins, known, used["reproducibility"])
    write_table(job.output.table, pd.DataFrame(rows, columns=COLUMNS))
    text = yaml.safe_dump(dict(used), allow_unicode=True, sort_keys=False)
    Path(job.output.config).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
