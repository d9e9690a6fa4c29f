"""Print the last lines of a run, after Snakemake's output: the verdicts, or how to continue."""

import atexit
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from replication.workflow import internals

SUMMARY = Path("results/summary.txt")
GO_ON = (
    "The run did not finish. Run the same command again, after mending what failed, if anything "
    "did:\nwhat is finished is kept, and what was half written is made anew.\n"
)


def close(workflow: Any) -> None:
    """Print the last lines when this process ends."""
    begun = time.time()
    atexit.register(lambda: print(last_lines(workflow, begun), end="", flush=True))


def faults(jobs: Iterable[Any], begun: float) -> Iterator[str]:
    """Yield what jobs that ended this run by a verdict say; their messages stand far above."""
    for log in (Path(str(path)) for job in jobs for path in job.log):
        if log.exists() and log.stat().st_mtime >= begun:
            _, found, said = log.read_text(encoding="utf-8").rpartition("SystemExit: ")
            if found:
                yield said


def last_lines(workflow: Any, begun: float) -> str:
    """Return the verdicts if every result exists; otherwise return how to continue the run.

    The run began at `begun`, s since the epoch: older logs are of other runs.
    """
    if not internals.runs_jobs(workflow):
        return ""
    if waiting := internals.unfinished(workflow):
        return "".join(faults(waiting, begun)) + GO_ON
    return SUMMARY.read_text(encoding="utf-8") if "all" in internals.targets(workflow) else ""
