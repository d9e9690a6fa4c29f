"""The parsed workflow, which many tests read; small trees, and runs in them."""

import os
import signal
import subprocess
import sys
import time
from functools import partial
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

    def start(*options, until=None, module="snakemake", folder=tmp_path):
        runs.append(
            subprocess.Popen(
                [sys.executable, "-m", module, "--cores=1", *options],
                cwd=folder,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                start_new_session=True,  # as a terminal, whose signals reach all processes
                preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),  # under nohup
            )
        )
        while until and not (folder / until).exists():
            assert runs[-1].poll() is None, runs[-1].communicate()[0]
            time.sleep(0.1)
        return runs[-1]

    yield start
    for run in runs:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
        run.communicate()


@pytest.fixture
def ran(begin):
    """Let Snakemake run to its end; return its status and what it said."""

    def end(*options, **where):
        run = begin(*options, **where)
        said, _ = run.communicate(timeout=120)
        return run.returncode, said

    return end
