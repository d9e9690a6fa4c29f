"""The last lines of a run: the summary when all is there, how to go on when it is not."""

import logging
import os
import re
import signal
from threading import Thread
from types import SimpleNamespace

import pytest

from replication.commands.run import no_place
from replication.workflow.closing import GO_ON
from replication.workflow.stopping import SAYS, SIGNALS, after_signals

SNAKEFILE = """
from replication.workflow.closing import close
from replication.workflow.stopping import end_on_sigterm
close(workflow)
end_on_sigterm()
rule all:
    input: "results/summary.txt"
rule summary:
    input: "begun"
    output: "results/summary.txt"
    shell: "echo 'paper: 3 confirmed' > {output}"
rule begun:
    output: "begun"
    log: "log"
    script: "step.py"
"""
STEP = """
import time
from pathlib import Path
IMPORTS
from replication.workbench import log_to
with log_to(snakemake.log[0]):
    WORK
    Path(snakemake.output[0]).touch()
"""
WAITING = "Path('ready').touch(); time.sleep(100)"


@pytest.fixture
def step(tmp_path, plant):
    """Write a workflow of two rules, with the given work in the first."""

    def write(work, imports=""):
        text = STEP.replace("WORK", work).replace("IMPORTS", imports)
        plant(tmp_path, {"Snakefile": SNAKEFILE, "step.py": text})

    return write


def test_failed_run_says_how_to_go_on_and_which_verdict_failed_it(step, ran):
    step("raise SystemExit('claim a is refuted; expected confirmed')")
    assert ran()[1].endswith(f"claim a is refuted; expected confirmed\n{GO_ON}")
    step("raise RuntimeError('too stocky')")  # the log of the verdict is old by now
    status, said = ran()
    assert status == 1
    assert "too stocky" in said
    assert "claim a" not in said
    assert said.endswith(GO_ON)


@pytest.mark.parametrize(
    ("number", "during"),
    [*((each, "work") for each in SIGNALS), (SIGNALS[0], "imports"), (SIGNALS[1], "reading")],
)
def test_interrupted_run_says_so_in_one_line(step, begin, tmp_path, number, during):
    step(WAITING if during == "work" else "pass", imports=WAITING * (during == "imports"))
    if during == "reading":
        (tmp_path / "Snakefile").write_text(f"import time\nfrom pathlib import Path\n{WAITING}")
    run = begin(module="replication.commands.run", until="ready")
    os.killpg(run.process.pid, number)  # as Ctrl-C does, to all processes of the terminal
    status, said = run.communicate(timeout=60)
    assert status != 0
    assert not re.search("Traceback|Error|  File ", said)
    assert said.endswith(f"\n{SAYS}\n")
    assert said.count(SAYS) == 1


def test_run_does_not_begin_where_it_cannot_write(tmp_path, monkeypatch):
    assert no_place(tmp_path) is None
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=12_300_000))
    assert no_place(tmp_path).endswith("12 MB free on the disk; expected 200: make room")
    monkeypatch.setattr("os.access", lambda *_: False)
    assert no_place(tmp_path).startswith(f"{tmp_path} cannot be written; expected a folder of")


def test_signal_is_handled_before_the_error_of_the_job_that_it_ended():
    order = []
    error = logging.makeLogRecord({"levelno": logging.ERROR})

    def fail():
        os.kill(os.getpid(), signal.SIGTERM)
        order.extend(["error"] * after_signals(error))

    before = signal.signal(signal.SIGTERM, lambda *_: order.append("signal"))
    try:
        job = Thread(target=fail)
        job.start()
        job.join()
    finally:
        signal.signal(signal.SIGTERM, before)
    assert order == ["signal", "error"]
