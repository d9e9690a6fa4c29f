"""A second run and `make unlock` are refused beside a run, and not after a killed one."""

import os
import signal
import subprocess
import sys
import time

from replication.workflow.lock import KILLED, LIVE

SNAKEFILE = """
from replication.workflow.lock import one_run_at_a_time
one_run_at_a_time()
rule slow:
    output: "slow"
    shell: "touch begun; sleep 100; touch slow"
"""


def test_folder_is_one_run_s_until_that_ends(tmp_path):
    (tmp_path / "Snakefile").write_text(SNAKEFILE, encoding="utf-8")
    command = [sys.executable, "-m", "snakemake", "--cores", "1"]

    def said(*options):
        done = subprocess.run([*command, *options], cwd=tmp_path, capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    run = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        while not (tmp_path / "begun").exists():
            assert run.poll() is None
            time.sleep(0.1)
        for options in ([], ["--unlock"]):
            status, text = said(*options)
            assert status == 1
            assert LIVE.format(run.pid) in text
        assert said("--dry-run")[0] == 0
    finally:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
    status, text = said("--rerun-incomplete")
    assert status == 1
    assert KILLED in text
    assert said("--unlock")[0] == 0
    assert KILLED not in said("--rerun-incomplete", "--dry-run")[1]
    assert not [*(tmp_path / ".snakemake" / "locks").glob("*")]
