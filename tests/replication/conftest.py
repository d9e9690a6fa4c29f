"""The parsed workflow, which many tests read; small trees, and runs in them."""

import os
import signal
import time
from pathlib import Path

import pytest

from tests.replication.begun import Run

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def jobs():
    """Every job of the workflow, by Snakemake's own reading of the Snakefile."""
    from replication.workflow.provenance import workflow_jobs

    return workflow_jobs(ROOT)


@pytest.fixture(scope="session")
def claims(jobs):
    """The rows of the ledger, from whatever files the Snakefile takes them."""
    return [job.params["claim"] for job in jobs if "claim" in job.params]


@pytest.fixture(scope="session")
def plant():
    """Write files of a folder, given as texts or bytes by their paths; return the folder."""

    def write(root, files):
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return root

    return write


@pytest.fixture
def begin(tmp_path):
    """Begin Snakemake in a folder, and wait until a file is there; no run outlasts the test."""
    runs = []

    def start(*options, until=None, folder=tmp_path, **given):
        runs.append(run := Run(folder, "--cores=1", *options, **given))
        while until and not (folder / until).exists():
            assert run.process.is_alive(), run.communicate()
            time.sleep(0.02)
        return run

    yield start
    for run in runs:
        if run.process.is_alive():
            os.killpg(run.process.pid, signal.SIGKILL)
            run.process.join()


@pytest.fixture
def ran(begin):
    """Let Snakemake run to its end; return its status and what it said."""
    return lambda *options, **where: begin(*options, **where).communicate()
