"""Compile the report, which reads results/ itself: the same bytes each time."""

from pathlib import Path

import typst
from workbench import log_to

if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        pdf = typst.compile(
            snakemake.input.source,
            root=".",
            ignore_system_fonts=True,
            pdf_standards=["a-2b"],
            sys_inputs={"studies": ",".join(snakemake.params.studies)},
        )
        Path(snakemake.output[0]).write_bytes(pdf)
