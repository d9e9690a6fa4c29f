"""Let Ctrl-C, a closed terminal and SIGTERM end a run and its jobs with one line."""

import logging
import os
import signal
import time
from contextlib import suppress
from typing import Any, NoReturn

import psutil

from replication.workflow.internals import on_signal

SAYS = "Interrupted. The same command goes on: what is finished is kept."

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
"""Those that `interrupt` answers."""

QUIET = "set -euo pipefail; trap '' INT; "
"""How the shell of a job begins: one that still imports its modules would print where it was."""

PAUSE = 0.2
"""s: an error that is logged waits so long for the handler of a signal."""


def interrupt(*_: Any) -> NoReturn:
    """Print one line, end the jobs, and let Snakemake clean up without a word.

    Snakemake's own handler of SIGTERM takes the scheduler's lock. Python runs a handler in the main
    thread, which may hold this lock: the run would wait for itself, with its folder locked.
    """
    for number in SIGNALS:
        # uv passes on to its child what the whole process group has received already.
        signal.signal(number, lambda *_: None)
    os.write(2, f"\n{SAYS}\n".encode())
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
    for job in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            job.terminate()
    raise KeyboardInterrupt


def end_on_sigterm() -> None:
    """Let SIGTERM interrupt Snakemake's scheduler, and `interrupt` precede errors."""
    from snakemake.logging import logger

    on_signal(interrupt)
    logger.addFilter(after_signals)


def after_signals(record: logging.LogRecord) -> bool:
    """Let an error wait: a signal may have ended its job, and `interrupt` silences the rest."""
    if record.levelno >= logging.ERROR:
        time.sleep(PAUSE)
    return True
