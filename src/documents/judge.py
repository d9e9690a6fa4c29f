"""Judge every claim of a run; one claim: python -m documents.judge eq25"""

import json
import sys
from pathlib import Path
from typing import Any

from replication.claims import read_claims
from replication.job import log_to, write
from replication.verdicts import judged, read_findings, unexpected


def work(job: Any) -> None:
    findings = read_findings(path for path in job.input if path.endswith(".json"))
    claims = [c for path, known in job.params.settings.items() for c in read_claims(path, known)]
    rows = [judged(claim, findings) for claim in claims]
    print(*unexpected(rows), sep="\n", file=sys.__stderr__)  # at once, and again at the end
    write(job, {job.output[0]: json.dumps(rows, indent=1, ensure_ascii=False) + "\n"})


def one(name: str) -> str:
    """Return the line of one claim, from results/claims.json or else from the published tables."""
    path = Path("results/claims.json")
    if path.is_file():
        rows = json.loads(path.read_text("utf-8"))
    else:
        from documents.check import published

        rows = published()
    matches = [row for row in rows if row["id"] == name]
    if not matches:
        raise SystemExit(
            f"no claim of the last run has the id {name!r}; expected one of paper/claims.yaml; "
            "for a new one: make reproduce"
        )
    row = matches[0]
    lines = [f"{name}: {row['verdict']}", f"  {row['where']}: {row['statement']}"]
    if row["shown"]:
        lines.append(f"  printed {row['printed']}, computed {row['shown']}")
    if row["differs"]:
        lines.append(f"  our copy differs: {row['differs']}")
    if row["rule"]:
        lines.append(f"  by rule {row['rule']}, finding {row['finding']}")
    return "\n".join([*lines, *([f"  {row['remark']}"] if row["remark"] else [])])


if __name__ == "__main__":
    if "snakemake" in globals():
        with log_to(snakemake.log[0]):
            work(snakemake)
    else:
        print(*map(one, sys.argv[1:]), sep="\n")
