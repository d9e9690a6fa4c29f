"""Draw the figures of a part in one process, each from its tables."""

import runpy
import sys
import traceback
from pathlib import Path

import matplotlib as mpl

from replication.config import read_yaml
from replication.drawing import picture
from replication.job import log_to, stop, write
from replication.step import call, tables_of

if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        sys.path.insert(0, "figures")
        captions, tables = read_yaml(snakemake.input.captions), tables_of(snakemake.input)
        params = {name: content for name, content in snakemake.params.items() if name != "code"}
        made = {}
        for script, svg in zip(snakemake.input.scripts, snakemake.output, strict=True):
            draw, about = runpy.run_path(script)["draw"], captions[Path(script).stem]
            try:
                with mpl.rc_context(fname=snakemake.input.style):
                    figure = call(draw, snakemake.rule, tables, params)
                    made[svg] = picture(figure, about["title"], about["alt"])
            except Exception as error:
                traceback.print_exc()
                stop(f"{script}: {type(error).__name__}: {error}")
        write(snakemake, made)
