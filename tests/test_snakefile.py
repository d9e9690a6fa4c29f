"""What the Snakefile sets in Snakemake is still there."""

import inspect
from pathlib import Path

from snakemake.scheduling.job_scheduler import JobScheduler

ROOT = Path(__file__).parents[1]


def test_limit_that_the_snakefile_takes_off_is_one_of_snakemake():
    assert "workflow.scheduler.job_rate_limiter = None" in (ROOT / "Snakefile").read_text("utf-8")
    assert "if self.job_rate_limiter is not None" in inspect.getsource(JobScheduler)
