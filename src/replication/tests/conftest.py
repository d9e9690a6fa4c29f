"""The parsed workflow, which many tests read."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def jobs():
    """Every job of the workflow, by Snakemake's own reading of the Snakefile."""
    from replication.workflow.provenance import workflow_jobs

    return workflow_jobs(ROOT)


@pytest.fixture(scope="session")
def claims(jobs):
    """The rows of the ledger, from whatever files the Snakefile takes them."""
    return [job.params["claim"] for job in jobs if "claim" in job.params]
