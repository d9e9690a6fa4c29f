"""One run at a time in a folder, and a lock that a killed run left behind.

Snakemake's lock is a list of files, which a killed run cannot remove. The operating system ends a
lock of its own with the process that holds it, and so tells the one from the other.
"""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from snakemake.exceptions import CliException

from replication.workflow.internals import hold_while_locked

HOLDER = Path(".snakemake/run")
LIVE = "a run is going on here (process {}); expected none: wait for its end, or end it by Ctrl-C"
KILLED = "a run was killed here and left the folder locked; expected no lock: make unlock"


@contextmanager
def alone() -> Iterator[None]:
    """Hold the folder for this process, or raise a CliException if another one does."""
    HOLDER.parent.mkdir(exist_ok=True)
    with HOLDER.open("a+", encoding="utf-8") as holder:
        try:
            fcntl.flock(holder, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise CliException(LIVE.format(HOLDER.read_text(encoding="utf-8"))) from None
        holder.truncate(0)
        holder.write(str(os.getpid()))
        holder.flush()
        yield


@cache  # once for each process, which may read several Snakefiles
def one_run_at_a_time() -> None:
    """Let Snakemake refuse a second run, and `make unlock` beside a run."""
    hold_while_locked(alone, KILLED)
