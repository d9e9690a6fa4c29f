"""What a run prints while it goes on: one line for each job that is done."""

import logging
import time
from typing import Any

from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

NOISE = ("Select jobs to execute...", "Execute ", "Assuming unrestricted shared", "host: ")
"""How the lines begin that tell of Snakemake's own work."""


class OneLineAJob(logging.Formatter):
    """Puts one line in place of those that Snakemake prints for each job.

    The line has how many jobs are done, the time that this one took, and its message. Errors,
    warnings and the list of jobs pass as they are.
    """

    def __init__(self, others: logging.Formatter | None) -> None:
        super().__init__()
        self.others = others or logging.Formatter()
        self.begun: dict[int, tuple[float, str]] = {}
        self.done: list[int] = []

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is printed, and note what the line of a job needs."""
        fields = vars(record)
        match fields.get("event"):
            case LogEvent.JOB_INFO:
                name = fields["rule_msg"] or fields["rule_name"]
                self.begun[fields["jobid"]] = time.monotonic(), str(name)
            case LogEvent.JOB_FINISHED:
                self.done.append(fields["job_id"])
            case LogEvent.PROGRESS:
                return bool(self.done)
            case LogEvent.WORKFLOW_STARTED:
                pass
            case _:
                return not str(record.msg or "").strip().startswith(NOISE)
        return False

    def format(self, record: logging.LogRecord) -> str:
        """Return the lines of the jobs that were done since the last record of progress."""
        if vars(record).get("event") != LogEvent.PROGRESS:
            return self.others.format(record)
        jobs, self.done = self.done, []
        return "\n".join(self._line(job, vars(record)) for job in jobs)

    def _line(self, job: int, fields: dict[str, Any]) -> str:
        begun, name = self.begun.pop(job, (time.monotonic(), f"job {job}"))
        seconds = time.monotonic() - begun
        return f"{fields['done']:4d} of {fields['total']}  {seconds:6.1f} s  {name}"


def one_line_a_job() -> None:
    """Let Snakemake print one line for each job, in a terminal and in a pipe alike.

    Its own log in .snakemake/log keeps all lines.
    """
    for handler in logger.handlers:
        if not isinstance(handler, logging.FileHandler):
            line = OneLineAJob(handler.formatter)
            handler.setFormatter(line)
            handler.addFilter(line)
