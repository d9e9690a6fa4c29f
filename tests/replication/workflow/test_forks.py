"""A script that is a fork finds what it would find without, and ends as it would end."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from select import select

import pytest

from replication.workflow import fork_client, fork_server
from replication.workflow.forks import FEW

SCRIPT = """
import json, os, signal, sys
from pathlib import Path
print(json.dumps({
    "name": __name__, "file": __file__, "words": sys.argv, "first": sys.path[0],
    "folder": os.getcwd(), "variable": os.environ.get("OF_THE_JOB"),
    "ended_by": signal.getsignal(signal.SIGTERM) == signal.SIG_DFL,
    "repository": [name for name in sys.modules if name.split(".")[0] == "replication"],
}))
Path("who.json").write_text(json.dumps([os.getpid(), os.getppid(), "numpy" in sys.modules]))
"""


@pytest.fixture
def server(tmp_path_factory):
    """Begin the process of the forks, and wait until it is ready."""
    address = tmp_path_factory.mktemp("forks") / "socket"
    process = subprocess.Popen(
        [sys.executable, "-P", fork_server.__file__, address], stdin=subprocess.PIPE
    )
    process.address = address
    while not address.exists():
        assert process.poll() is None
        time.sleep(0.01)
    yield process
    process.kill()
    process.communicate()


@pytest.fixture
def ask(tmp_path):
    """Begin a script by the client, as the shell of a job does."""

    def start(text, address, threads="1"):
        script = tmp_path / ".snakemake" / "scripts" / "tmp1.step.py"
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(text, encoding="utf-8")
        return subprocess.Popen(
            [sys.executable, "-IS", fork_client.__file__, str(address), script],
            cwd=tmp_path,
            env=os.environ | {"OMP_NUM_THREADS": threads, "OF_THE_JOB": "α"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    return start


@pytest.fixture
def who(tmp_path):
    """Return the pid of the script that was begun, that of its parent, and if it was prepared."""

    def wait():
        path = tmp_path / "who.json"
        until = time.monotonic() + 60
        while not path.exists() or not path.read_text():
            assert time.monotonic() < until
            time.sleep(0.01)
        return json.loads(path.read_text())

    return wait


def test_fork_finds_what_a_script_finds_without_forks(server, ask, who, tmp_path):
    said, _ = ask(SCRIPT, server.address).communicate()
    assert who()[2]
    (tmp_path / "who.json").unlink()
    plain = ask(SCRIPT, tmp_path / "nothing")
    assert plain.communicate()[0] == said
    assert who() == [plain.pid, os.getpid(), False]
    found = json.loads(said)
    assert found["variable"] == "α"
    assert found["repository"] == []


def test_rule_with_several_threads_has_a_python_of_its_own(server, ask, who):
    ask(SCRIPT, server.address, threads="2").communicate()
    assert not who()[2]


def test_fork_ends_with_its_client_and_others_go_on(server, ask, who):
    client = ask(f"{SCRIPT}\nimport time; time.sleep(30)", server.address)
    ends = os.pidfd_open(who()[0])
    client.kill()
    client.wait()
    ended, _, _ = select([ends], [], [], 20.0)
    client.communicate()
    os.close(ends)
    assert ended
    other = ask("raise SystemExit(4)", server.address)
    other.communicate()
    assert other.returncode == 4


def test_client_tells_when_nobody_waits_for_its_script(server, ask, who):
    client = ask(f"{SCRIPT}\nimport time; time.sleep(30)", server.address)
    pid, parent, _ = who()
    os.kill(parent, signal.SIGKILL)
    client.wait()
    os.kill(pid, signal.SIGKILL)
    assert fork_client.ENDED in client.communicate()[1]
    assert client.returncode == 1


SNAKEFILE = """
from replication.workflow.forks import start_scripts_as_forks
onstart: start_scripts_as_forks(workflow)
rule all:
    input: expand("made/{n}", n=range(N))
rule one:
    output: "made/{n}"
    log: "logs/{n}"
    script: "one.py"
"""
ONE = """
import os
import sys
import time
from pathlib import Path
from replication.workbench import run
while WAITS and not [*Path().glob("forks-*/socket")]:
    time.sleep(0.05)
if snakemake.wildcards.n == "11":
    sys.path.insert(0, ".")
    import beside
begun = len([*Path().glob("forks-*")])
run(snakemake, lambda job: f"{'numpy' in sys.modules} {begun}")
"""


@pytest.mark.parametrize(("number", "forked"), [(FEW - 1, False), (FEW + 4, True)])  # and `all`
def test_run_of_many_jobs_forks_them(ran, plant, tmp_path, number, forked):
    files = {
        "Snakefile": SNAKEFILE.replace("N)", f"{number})"),
        "one.py": ONE.replace("WAITS", str(forked)),
        "beside.py": "",
    }
    plant(tmp_path, files)
    status, said = ran("--keep-going", env=os.environ | {"TMPDIR": str(tmp_path)})
    made = [path.read_text().split() for path in tmp_path.glob("made/*")]
    assert {begun for _, begun in made} == {str(int(forked))}
    assert any(prepared == "True" for prepared, _ in made) == forked
    logs = [path.read_text() for path in tmp_path.glob("logs/*")]
    assert len(made) == sum("peak memory: " in log for log in logs) == number - forked
    assert (status, "rule one loaded beside.py" in said) == (int(forked), forked)
    commands = re.findall(r"Command '(.*)' returned", said)
    assert all(len(command) < 300 for command in commands)
    assert not [*tmp_path.glob("forks-*")]
