"""Draw the figures of a part in one process, each from its tables."""

import runpy
import sys
import traceback
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl

from replication.config import read_yaml
from replication.drawing import picture
from replication.job import log_to, stop, write
from replication.step import call, tables_of


def drawn(
    scripts: Iterable[str],
    tables: Mapping[str, Any],
    params: Mapping[str, Any],
    captions: Mapping[str, Any],
    style: str,
) -> Iterator[str]:
    """Yield the picture of each script; it takes tables and parameters by name."""
    sys.path.insert(0, "figures")
    for script in scripts:
        draw, about = runpy.run_path(script)["draw"], captions[Path(script).stem]
        try:
            with mpl.rc_context(fname=style):
                yield picture(call(draw, script, tables, params), about["title"], about["alt"])
        except Exception as error:
            traceback.print_exc()
            stop(f"{script}: {type(error).__name__}: {error}")


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        inputs, params = snakemake.input, dict(snakemake.params.items())
        captions = read_yaml(inputs.captions)
        pictures = drawn(inputs.scripts, tables_of(inputs), params, captions, inputs.style)
        write(snakemake, dict(zip(snakemake.output, pictures, strict=True)))
