"""A run from its start to its last lines: place, lock, progress, closing."""

import logging
import os
import re
import signal
from threading import Thread
from types import SimpleNamespace

import pytest

from replication.commands.run import no_place
from replication.workflow.closing import GO_ON
from replication.workflow.lock import KILLED, LIVE
from replication.workflow.place import check_place
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


TWO_JOBS = """
from replication.workflow.progress import one_line_a_job
one_line_a_job()
rule all:
    input: "a.txt", "b.txt"
rule write:
    output: "{name}.txt"
    log: "{name}.log"
    message: "Writing {wildcards.name}"
    shell: "echo told >{log}; test {wildcards.name} != WRONG && touch {output}"
"""


@pytest.fixture
def told(tmp_path, ran):
    def run(wrong):
        (tmp_path / "Snakefile").write_text(TWO_JOBS.replace("WRONG", wrong))
        return ran("--scheduler=greedy", "--show-failed-logs")

    return run


def test_each_job_has_one_line_with_its_share_and_time(told):
    _, said = told("nobody")
    lines = re.findall(r"^ +(\d) of 3 +\d+\.\d s  (.*)$", said, flags=re.MULTILINE)
    assert [number for number, _ in lines] == ["1", "2", "3"]
    assert {name for _, name in lines} == {"Writing a", "Writing b", "all"}
    assert not re.search("Select jobs|Execute 1|Finished jobid", said)


SLOW_JOB = """
from replication.workflow.lock import one_run_at_a_time
one_run_at_a_time()
rule slow:
    output: "slow"
    shell: "touch begun; sleep 100; touch slow"
"""


def test_folder_is_one_run_s_until_that_ends(tmp_path, begin, ran):
    (tmp_path / "Snakefile").write_text(SLOW_JOB)
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


@pytest.mark.parametrize("character", [" ", "'", '"', "$", "&", ";", "(", "{", "\\", ":"])
def test_path_that_a_shell_would_not_read_as_one_word_is_refused(character):
    python = f"/home/me/a{character}b/.venv/bin/python"
    with pytest.raises(ValueError, match="without quoting that path: move the folder") as told:
        check_place(python)
    assert repr(character) in str(told.value)
    assert python in str(told.value)


def test_folder_that_cannot_be_written_to_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: (str(path), mode) != (tmp, os.W_OK))
    tmp = str(tmp_path)
    with pytest.raises(ValueError, match=f"{tmp} cannot be written to; expected"):
        check_place("/usr/bin/python", tmp)
