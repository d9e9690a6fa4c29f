"""Let SIGTERM end a run as Ctrl-C does."""

import signal
from typing import Any

from snakemake.scheduling.job_scheduler import JobScheduler


def end_on_sigterm() -> None:
    """Let SIGTERM interrupt Snakemake's scheduler.

    Snakemake's own handler takes the scheduler's lock. Python runs a handler in the main thread,
    which may hold this lock: the run would wait for itself, without end and with its folder locked.
    """

    def interrupt(*_: Any) -> None:
        # uv passes on to its child what the whole process group has received already.
        signal.signal(signal.SIGTERM, lambda *_: None)
        raise KeyboardInterrupt

    JobScheduler.exit_gracefully = interrupt
