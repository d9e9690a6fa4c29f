"""Compile the report, which reads results/ itself: the same bytes each time."""

import json
from pathlib import Path
from typing import Any

from replication.judging.digits import of_judged
from replication.judging.ledger import read_judged
from replication.pages.captions import alternative, read_captions
from replication.pages.typeset import compiled
from replication.workbench import run


def work(job: Any) -> None:
    captions = read_captions(job.input.captions)
    studies = job.params.studies
    options = {
        "studies": ",".join(studies),
        "articles": ",".join(
            name for name in studies if Path(f"studies/{name}/article.typ").is_file()
        ),
        "numbers": json.dumps(of_judged(read_judged("results/claims.json"))),
        "alternatives": json.dumps({path: alternative(entry) for path, entry in captions.items()}),
    }
    pdf = compiled(job.input.source, dict.fromkeys(job.input), options)
    Path(job.output[0]).write_bytes(pdf)


if __name__ == "__main__":
    run(snakemake, work)
