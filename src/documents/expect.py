"""Count the verdicts, name each that is not the expected one, and fail if there is one."""

import csv
import json
from pathlib import Path

from replication.job import log_to, stop, write
from replication.verdicts import counts, unexpected

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


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        rows = json.loads(Path(snakemake.input.claims).read_text("utf-8"))
        comparison = [
            *csv.DictReader(Path(snakemake.input.comparison).read_text("utf-8").splitlines())
        ]
        text = summary(rows, comparison)
        if faults(rows, comparison):
            stop(text.rstrip())  # the log has it, which the Snakefile shows at the end
        print(text, end="")
        write(snakemake, {snakemake.output[0]: text})
