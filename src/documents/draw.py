"""Draw the figures of a part in one process, each from its tables."""

import runpy
import sys
import traceback
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from replication.config import read_yaml
from replication.drawing import picture
from replication.job import log_to, stop, write
from replication.step import call, tables_of


def scripts_of_figures() -> list[str]:
    """Return the scripts that draw a figure each."""
    scripts = sorted(Path("figures").glob("*.py"))
    return [str(path) for path in scripts if "\ndef draw(" in path.read_text("utf-8")]


def figure_of(script: str, tables: Mapping[str, Any], params: Mapping[str, Any]) -> Figure:
    """Return the figure of a script, which takes tables and parameters by name."""
    if "figures" not in sys.path:
        sys.path.insert(0, "figures")  # palette.py
    return call(runpy.run_path(script)["draw"], script, tables, params)


def pictures(
    scripts: Iterable[str],
    tables: Mapping[str, Any],
    params: Mapping[str, Any],
    captions: Mapping[str, Any],
    style: str,
) -> Iterator[str]:
    """Yield the picture of each script."""
    for script in scripts:
        about = captions[Path(script).stem]
        try:
            with mpl.rc_context(fname=style):
                yield picture(figure_of(script, tables, params), about["title"], about["alt"])
        except Exception as error:
            traceback.print_exc()
            stop(f"{script}: {type(error).__name__}: {error}")


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        inputs, params = snakemake.input, dict(snakemake.params.items())
        captions = read_yaml(inputs.captions)
        svgs = pictures(inputs.scripts, tables_of(inputs), params, captions, inputs.style)
        write(snakemake, dict(zip(snakemake.output, svgs, strict=True)))
