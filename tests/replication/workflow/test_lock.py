"""A second run and `make unlock` are refused beside a run, and not after a killed one."""

import os
import signal

from replication.workflow.lock import KILLED, LIVE

SNAKEFILE = """
from replication.workflow.lock import one_run_at_a_time
one_run_at_a_time()
rule slow:
    output: "slow"
    shell: "touch begun; sleep 100; touch slow"
"""


def test_folder_is_one_run_s_until_that_ends(tmp_path, begin, ran):
    (tmp_path / "Snakefile").write_text(SNAKEFILE)
    run = begin(until="begun")
    for options in ([], ["--unlock"]):
        status, text = ran(*options)
        assert status == 1
        assert LIVE.format(run.process.pid) in text
    assert ran("--dry-run")[0] == 0
    os.killpg(run.process.pid, signal.SIGKILL)
    run.communicate()
    status, text = ran("--rerun-incomplete")
    assert status == 1
    assert KILLED in text
    assert ran("--unlock")[0] == 0
    assert KILLED not in ran("--rerun-incomplete", "--dry-run")[1]
    assert not [*(tmp_path / ".snakemake" / "locks").glob("*")]
