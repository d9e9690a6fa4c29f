"""Snakemake with its own arguments, which Ctrl-C ends with one line at any moment."""

import os
import shutil
import signal
import sys
from pathlib import Path

from replication.workflow.stopping import QUIET, SIGNALS, interrupt

ROOM = 200
"""MB on the disk: below this a run does not begin."""


def no_place(folder: Path = Path()) -> str | None:
    """Return why a run cannot be made in a folder, or None."""
    if not os.access(folder, os.W_OK):
        return f"{folder.resolve()} cannot be written; expected a folder of your own: copy it"
    free = shutil.disk_usage(folder).free // 1_000_000
    if free < ROOM:
        return f"{folder.resolve()}: {free} MB free on the disk; expected {ROOM}: make room"
    return None


if __name__ == "__main__":
    for number in SIGNALS:
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:  # as under nohup
            signal.signal(number, interrupt)
    if reason := no_place():
        sys.exit(reason)
    from snakemake.cli import main
    from snakemake.shell import shell

    shell.prefix(QUIET)
    sys.exit(main())
