"""The last lines of a run: the summary when all is there, how to go on when it is not."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from replication.workflow.closing import GO_ON
from replication.workflow.stopping import SAYS

STEPS = Path(__file__).parents[4] / "src" / "steps"
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


@pytest.fixture
def start(tmp_path):
    """Begin a run of two rules, with the given work in the first."""
    (tmp_path / "Snakefile").write_text(SNAKEFILE, encoding="utf-8")

    def begin(work, *options, imports=""):
        step, text = tmp_path / "step.py", STEP.replace("WORK", work).replace("IMPORTS", imports)
        if not step.exists() or step.read_text(encoding="utf-8") != text:
            step.write_text(text, encoding="utf-8")
        return subprocess.Popen(
            [sys.executable, "-m", "replication.commands.run", "--cores", "1", *options],
            cwd=tmp_path,
            env=os.environ | {"PYTHONPATH": str(STEPS)},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    return begin


def test_summary_comes_last_also_when_there_is_nothing_to_do(start):
    for expected in ("3 of 3 steps (100%) done", "Nothing to be done"):
        run = start("pass")
        said, _ = run.communicate(timeout=120)
        assert run.returncode == 0
        assert expected in said
        assert said.count("paper: 3 confirmed") == 1
        assert said.endswith("paper: 3 confirmed\n")


def test_dry_run_and_a_part_of_the_run_have_no_last_lines(start):
    for options in (["--dry-run"], ["begun"]):
        said, _ = start("pass", *options).communicate(timeout=120)
        assert "paper:" not in said
        assert GO_ON not in said


def test_failed_run_says_how_to_go_on(start):
    run = start("raise RuntimeError('too stocky')")
    said, _ = run.communicate(timeout=120)
    assert run.returncode == 1
    assert "too stocky" in said
    assert said.endswith(GO_ON)


def test_verdict_that_failed_the_run_stands_at_its_end(start):
    run = start("raise SystemExit('claim a is refuted; expected confirmed')")
    said, _ = run.communicate(timeout=120)
    assert said.endswith(f"claim a is refuted; expected confirmed\n{GO_ON}")
    run = start("raise RuntimeError('too stocky')")  # the log of the verdict is old by now
    said, _ = run.communicate(timeout=120)
    assert "claim a" not in said


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("during", ["work", "imports", "reading"])
def test_interrupted_run_says_so_in_one_line(start, tmp_path, number, during):
    waiting = "Path('ready').touch(); time.sleep(100)"
    if during == "reading":
        (tmp_path / "Snakefile").write_text(f"import time\nfrom pathlib import Path\n{waiting}")
    run = start(waiting if during == "work" else "pass", imports=waiting * (during == "imports"))
    while not (tmp_path / "ready").exists():
        assert run.poll() is None
        time.sleep(0.1)
    os.killpg(run.pid, number)  # as Ctrl-C does, to all processes of the terminal
    said, _ = run.communicate(timeout=60)
    assert run.returncode != 0
    assert not re.search("Traceback|Error|  File ", said)
    assert said.endswith(f"\n{SAYS}\n")
    assert said.count(SAYS) == 1
