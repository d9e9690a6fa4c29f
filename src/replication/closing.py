"""Print the last lines of a run, after Snakemake's output: the verdicts, or how to continue."""

import atexit
from pathlib import Path
from typing import Any

from snakemake_interface_executor_plugins.settings import ExecMode

SUMMARY = Path("results/summary.txt")
GO_ON = (
    "The run did not finish. Run the same command again, after mending what failed, if anything "
    "did:\nwhat is finished is kept, and what was half written is made anew.\n"
)


def close(workflow: Any) -> None:
    """Print the last lines when this process ends."""
    atexit.register(lambda: print(last_lines(workflow), end="", flush=True))


def last_lines(workflow: Any) -> str:
    """Return the verdicts if every result exists; otherwise return how to continue the run.

    Parameters
    ----------
    workflow : snakemake.workflow.Workflow
        As a Snakefile has it; parts of a run that was never begun have nothing to say.
    """
    if workflow.scheduler is None or workflow.dryrun or workflow.exec_mode != ExecMode.DEFAULT:
        return ""
    dag = workflow.dag
    if not all(map(dag.finished, dag.needrun_jobs(exclude_finished=False))):
        return GO_ON
    is_all = "all" in {rule.name for rule in dag.targetrules}
    return SUMMARY.read_text(encoding="utf-8") if is_all else ""
