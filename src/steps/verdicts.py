"""Write the page of all claims and their verdicts, each with links to its script, table and figure."""

import json
from pathlib import Path

from replication.step import log_to, publish

if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        rows = json.loads(Path(snakemake.input.claims).read_text("utf-8"))
        lines = [f"- {row['id']}: {row['statement']} {row['verdict']}" for row in rows]
        publish(snakemake, {snakemake.output[0]: "\n".join(lines) + "\n"})
