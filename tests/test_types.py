"""What a user writes passes the strict type checkers, and what is wrong in it does not."""

import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import topheavy

PUBLIC = [name for name in dir(topheavy) if not name.startswith("_")]
TESTS = Path(__file__).parent
CACHE = TESTS.parent / ".mypy_cache" / "user"  # of what the library and its own are, for next time
CHECKERS = {
    "mypy": ["mypy", "--strict", "--warn-unreachable", f"--cache-dir={CACHE}"],
    "basedpyright": ["basedpyright", "--pythonpath", sys.executable],
}
MISTAKES = """\
from topheavy import Column, Pulse, Record, fragility, judge, simulate
column = Column(0.5, 4.0)
pulse = Pulse("one-sine", 0.3, 6.0)
simulate(column, "one-sine")
simulate(pulse, column)
Record("0.02", [0.1, 0.2])
Pulse("one-sine", "0.3", 6.0)
print(judge(column, pulse).peak)
print(simulate(column, pulse).outcome == "fell")
print(pulse.excitation([0.1, 0.2]).real_part)
Pulse("one-sin", 0.3, 6.0)
fragility([column], [pulse], [1.0], "PGD")
"""


@pytest.fixture(scope="module", params=CHECKERS)
def errors(request, tmp_path_factory):
    """The lines with errors in two scripts in a folder of their own, checked as by a user."""
    folder = tmp_path_factory.mktemp("user")
    user = (TESTS / "typed_user.py").read_text(encoding="utf-8")
    strict = json.dumps({"typeCheckingMode": "strict"})
    readme = (TESTS.parent / "README.md").read_text(encoding="utf-8")
    (snippet,) = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    files = {"user.py": user, "mistakes.py": MISTAKES}
    files["readme.py"] = "# pyright: standard\n" + snippet  # plt.show is not typed in full
    (folder / "pyrightconfig.json").write_text(strict, encoding="utf-8")
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", *CHECKERS[request.param], *files]
    environment = {name: value for name, value in os.environ.items() if name != "MYPYPATH"}
    found = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert found.returncode == 1, found.stdout + found.stderr
    return re.findall(r"(\w+\.py):(\d+)\b.*error", found.stdout)


@pytest.mark.sampled(1)
def test_users_script_passes_strict_type_checkers(errors):
    assert [error for error in errors if error[0] != "mistakes.py"] == []


@pytest.mark.sampled(1)
def test_every_mistake_of_a_user_is_found(errors):
    assert {int(line) for name, line in errors if name == "mistakes.py"} == set(range(4, 13))


def test_what_a_public_function_returns_is_public():
    functions = filter(inspect.isfunction, (getattr(topheavy, name) for name in PUBLIC))
    returned = " ".join(str(inspect.signature(one).return_annotation) for one in functions)
    others = {"NDArray", "DataArray", "Dataset", "None"}
    assert set(re.findall(r"[A-Z]\w+", returned)) <= {*dir(topheavy), *others}


def test_users_script_has_every_public_name():
    user = (TESTS / "typed_user.py").read_text(encoding="utf-8")
    assert {name for name in PUBLIC if not re.search(rf"\b{name}\b", user)} == set()
