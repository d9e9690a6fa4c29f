"""What is compiled is kept between processes."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import topheavy
from topheavy.kernel.compiled import state, writable_folder

PACKAGE, OTHER = Path(topheavy.__file__).parent, "bodies/free_rocking.py"


ASK = """
from topheavy.kernel.history import is_straight
is_straight(WAVE)
print(sum(is_straight.stats.cache_hits.values()))
"""


def asked(folder, wave="1"):
    command = [sys.executable, "-c", ASK.replace("WAVE", wave)]
    environment = os.environ | {"NUMBA_CACHE_DIR": str(folder)}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=True)


def test_next_process_finds_what_one_has_compiled_and_any_that_compiles_says_so(tmp_path):
    runs = [asked(tmp_path, wave) for wave in ("1", "1", "1.0")]  # of another type: compiled anew
    assert [int(run.stdout) for run in runs] == [0, 1, 0]
    for run in (runs[0], runs[2]):
        assert re.fullmatch(rf"This call compiles .* kept in {tmp_path}.*\n", run.stderr)
    assert runs[1].stderr == ""


@pytest.mark.parametrize("changed", ["kernel/rest.py", "kernel/step.py", "ground/shapes.py", OTHER])
def test_change_of_any_source_is_another_state(tmp_path, changed):
    package = tmp_path / "topheavy"
    shutil.copytree(PACKAGE, package)

    def now(folder):
        return state(folder / "kernel", folder / "ground/shapes.py", folder / OTHER)

    before = now(package)
    assert before == now(PACKAGE)
    (package / changed).write_bytes((package / changed).read_bytes() + b"\n")
    assert now(package) != before


def test_without_a_folder_to_write_to_nothing_is_kept(monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    done = asked(tmp_path / "file")
    assert (done.stdout, done.stderr.count("cannot be kept")) == ("0\n", 1)

    def no_home():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(Path, "home", no_home)
    with pytest.warns(UserWarning, match="Could not determine home .* set NUMBA_CACHE_DIR"):
        assert writable_folder() is None
