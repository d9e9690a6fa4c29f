"""SIGTERM ends a run whatever its scheduler does at that moment, and leaves no lock behind."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

# Snakemake writes that a job is finished while it holds the lock of its scheduler.
SNAKEFILE = """
import time
from pathlib import Path
from snakemake.logging import logger
from replication.workflow.stopping import end_on_sigterm

end_on_sigterm()

def hold(record):
    if workflow.scheduler is not None and workflow.scheduler._lock.locked():
        Path("held").touch()
        time.sleep(3)
    return True

logger.addFilter(hold)
rule all:
    input: "second"
rule first:
    output: "first"
    shell: "touch {output}"
rule second:
    input: "first"
    output: "second"
    shell: "sleep 100; touch {output}"
"""


def test_run_that_is_asked_to_end_while_its_scheduler_is_busy_ends(tmp_path):
    (tmp_path / "Snakefile").write_text(SNAKEFILE, encoding="utf-8")
    run = subprocess.Popen(
        [sys.executable, "-m", "snakemake", "--cores", "1"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        while not Path(tmp_path, "held").exists():
            assert run.poll() is None
            time.sleep(0.1)
        os.killpg(run.pid, signal.SIGTERM)
        run.terminate()  # as uv does, once more
        said, _ = run.communicate(timeout=60)
    finally:
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
    assert run.returncode == 1, said
    assert "Traceback" not in said
    assert not (tmp_path / "second").exists()
    assert not [*(tmp_path / ".snakemake" / "locks").glob("*")]
