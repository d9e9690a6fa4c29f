"""Compile the report, which reads results/ itself: the same bytes each time."""

from pathlib import Path
from typing import Any

from replication.pages.captions import read_captions
from replication.pages.typeset import compiled, options_of
from replication.workbench import run


def work(job: Any) -> None:
    options = options_of(job.params.studies, read_captions(job.input.captions))
    pdf = compiled(job.input.source, dict.fromkeys(job.input), options)
    Path(job.output[0]).write_bytes(pdf)


if __name__ == "__main__":
    run(snakemake, work)
