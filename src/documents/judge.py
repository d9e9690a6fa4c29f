"""Judge every claim of a run, then say what is not as expected."""

import csv
import json
import sys
from pathlib import Path
from typing import Any

from replication.claims import read_claims
from replication.job import log_to, stop, write
from replication.verdicts import counts, judged, read_findings, unexpected

PLACES = (
    "to read all of it: open results/site/index.html; paper/report.pdf, paper/supplement.pdf, "
    "tables: results/tables/, figures: figures/*.svg, notebooks: results/notebooks/"
)


def faults(rows: list[dict], comparison: list[dict]) -> list[str]:
    """Return a line for each unexpected verdict, and for each table that is not as published."""
    return unexpected(rows) + [
        f"{table['table']} differs from {table['published']} in {table['departs']}: look for the "
        "cause, or make publish"
        if table["verdict"] == "differs"
        else f"{table['table']} was not compared ({table['verdict']}), although the config is the "
        "published one: make publish"
        for table in comparison
        if table["verdict"] == "differs"
        or (table["required"] == "True" and table["verdict"] != "agrees")
    ]


def summary(rows: list[dict], comparison: list[dict]) -> str:
    """Return the last lines of a run: counts of verdicts, faults, and where results lie."""
    agree = sum(table["verdict"] == "agrees" for table in comparison)
    line = f"tables: {agree} of {len(comparison)} agree with the published ones"
    for reason in ("other parameters", "not published"):
        rules = dict.fromkeys(t["rule"] for t in comparison if t["verdict"] == reason)
        line += f"; not compared ({reason}): those of {', '.join(rules)}" if rules else ""
    return "\n".join([*counts(rows), line, *faults(rows, comparison), PLACES]) + "\n"


def claims(job: Any) -> None:
    """Judge every claim."""
    findings = read_findings(path for path in job.input if path.endswith(".json"))
    claims = [c for path, known in job.params.settings.items() for c in read_claims(path, known)]
    rows = [judged(claim, findings) for claim in claims]
    print(*unexpected(rows), sep="\n", file=sys.__stderr__)  # at once, and again at the end
    write(job, {job.output[0]: json.dumps(rows, indent=1, ensure_ascii=False) + "\n"})


def expected(job: Any) -> None:
    """Name each verdict that is not the expected one, and fail if there is one."""
    rows = json.loads(Path(job.input.claims).read_text("utf-8"))
    comparison = [*csv.DictReader(Path(job.input.comparison).read_text("utf-8").splitlines())]
    text = summary(rows, comparison)
    if faults(rows, comparison):
        stop(text.rstrip())  # the log has it, which the Snakefile shows at the end
    print(text, end="")
    write(job, {job.output[0]: text})


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        (claims if snakemake.rule == "claims" else expected)(snakemake)
