"""What a user writes passes a strict type checker, and what is wrong in it does not."""

import inspect
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
CHECKER = [sys.executable, "-m", "mypy", "--strict", "--warn-unreachable", f"--cache-dir={CACHE}"]
MISTAKES = """\
from topheavy import Column, Pulse, Record, fragility, judge, simulate
column = Column(0.5, 4.0)
pulse = Pulse("one-sine", 0.3, angular_frequency=6.0)
simulate(column, "one-sine")
simulate(pulse, column)
Record("0.02", [0.1, 0.2])
Pulse("one-sine", "0.3", angular_frequency=6.0)
print(judge(column, pulse).peak)
print(simulate(column, pulse).outcome == "fell")
print(pulse.excitation([0.1, 0.2]).real_part)
Pulse("one-sin", 0.3, angular_frequency=6.0)
fragility([column], [pulse], [1.0], "PGD")
Pulse("one-sine", 0.3, 6.0)
"""


@pytest.fixture(scope="module")
def errors(tmp_path_factory):
    """The lines with errors in three scripts in a folder of their own, checked as by a user."""
    folder = tmp_path_factory.mktemp("user")
    readme = (TESTS.parent / "README.md").read_text(encoding="utf-8")
    (snippet,) = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    user = (TESTS / "typed_user.py").read_text(encoding="utf-8")
    files = {"user.py": user, "readme.py": snippet, "mistakes.py": MISTAKES}
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    environment = {name: value for name, value in os.environ.items() if name != "MYPYPATH"}
    command = [*CHECKER, *files]
    answer = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert answer.returncode == 1, answer.stdout + answer.stderr
    return re.findall(r"(\w+\.py):(\d+)\b.*error", answer.stdout)


def test_users_script_passes_the_strict_type_checker(errors):
    assert [error for error in errors if error[0] != "mistakes.py"] == []


def test_every_mistake_of_a_user_is_found(errors):
    assert {int(line) for name, line in errors if name == "mistakes.py"} == set(range(4, 14))


def test_what_a_public_function_returns_is_public():
    functions = filter(inspect.isfunction, (getattr(topheavy, name) for name in PUBLIC))
    returned = " ".join(
        str(inspect.signature(function).return_annotation) for function in functions
    )
    others = {"NDArray", "DataArray", "Dataset", "None"}
    assert set(re.findall(r"[A-Z]\w+", returned)) <= {*dir(topheavy), *others}


def test_users_script_has_every_public_name():
    user = (TESTS / "typed_user.py").read_text(encoding="utf-8")
    assert {name for name in PUBLIC if not re.search(rf"\b{name}\b", user)} == set()
