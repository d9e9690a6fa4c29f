"""What is given to make reaches the commands word for word, or is refused in one line."""

import shutil
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def make(tmp_path):
    """Run make with a uv that prints what it is asked to run."""
    of_machine = (f"src/replication/make/{name}.mk" for name in ("machine", "kill"))
    for name in ("Makefile", *of_machine, "tests/faults/faults.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    uv = tmp_path / "uv"
    uv.write_text('#!/bin/sh\nfor word; do printf "<%s>" "$word"; done\n', encoding="utf-8")
    uv.chmod(0o755)

    def run(*words, **environment):
        return subprocess.run(
            ["make", f"UV={uv}", *words],
            cwd=tmp_path,
            env={"PATH": "/usr/local/bin:/usr/bin:/bin", **environment},
            capture_output=True,
            text=True,
        )

    return run


CODE = ["$(shell touch F)", "a'; touch F; '", 'a"; touch F; "', "`touch F`", "$$(touch F)", "a b"]


@pytest.mark.parametrize("code", CODE)
@pytest.mark.parametrize(
    ("target", "name"),
    [
        ("trace", "ITEM"),
        ("study", "NAME"),
        ("kill-table", "FAULTS"),
        ("audit", "CONFIG"),
        ("paper", "TO"),
    ],
)
def test_argument_is_passed_word_for_word_and_never_run(make, tmp_path, target, name, code):
    for ran in (make(target, f"{name}={code}"), make(target, **{name: code})):
        assert f"<{code}>" in ran.stdout.replace("<--faults=", "<")
        assert not (tmp_path / "F").exists()


@pytest.mark.parametrize(
    ("target", "name"),
    [
        ("reproduce", "CORES"),
        ("verify-grid", "CELLS"),
        ("kill-table", "ROTATE"),
        ("fuzz", "MINUTES"),
        ("fuzz", "SEED"),
    ],
)
@pytest.mark.parametrize("value", ["0", "-1", "abc", "1.5", "2; touch F"])
def test_what_is_no_whole_number_is_refused(make, tmp_path, target, name, value):
    ran = make(target, f"{name}={value}")
    assert ran.returncode == 2
    assert ran.stdout == ""
    assert ran.stderr.startswith(f"{name} is '{value}'; expected a whole number from 1 on\n")
    assert not (tmp_path / "F").exists()


def test_verify_starts_no_python_of_the_folder(make):
    assert "<python><find><--system>" in make("verify").stderr


def test_signal_to_make_alone_reaches_the_run(make, tmp_path):
    (tmp_path / "uv").write_text("#!/bin/sh\necho $$\nexec sleep 60\n", encoding="utf-8")
    command = ["make", "--no-print-directory", f"UV={tmp_path}/uv", "reproduce"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as run:
        number = int(run.stdout.readline())
        run.terminate()
        run.wait(timeout=10)
    until = time.monotonic() + 10.0
    while Path(f"/proc/{number}").exists() and time.monotonic() < until:
        time.sleep(0.05)
    assert not Path(f"/proc/{number}").exists()
