"""The list for pip and the reasons for each dependency keep up with the lock."""

import itertools
import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
DEFAULT = set(PROJECT["tool"]["uv"]["default-groups"])
OPTIONAL = set(PROJECT["dependency-groups"]) - DEFAULT  # nothing installs them unasked
MACHINE = tomllib.loads((ROOT / "src/replication/pyproject.toml").read_text(encoding="utf-8"))
FOR_PIP = ROOT / "requirements.txt"
FOR_CONDA = ROOT / "environment.yml"


def name_of(requirement):
    return re.match(r"[\w.-]+", requirement).group().lower()


def declared(left_out=frozenset()):
    """Names in pyproject.toml: the dependencies and every dependency group not left out."""
    groups = [g for name, g in PROJECT["dependency-groups"].items() if name not in left_out]
    groups.append(PROJECT["project"]["dependencies"])
    return {name_of(requirement) for group in groups for requirement in group} - {"replication"}


@pytest.mark.skipif(not FOR_PIP.exists(), reason="no requirements.txt")
def test_list_for_pip_is_that_of_the_lock():
    head, _, listed = FOR_PIP.read_text(encoding="utf-8").partition("\n")
    command = re.search(r"uv export .*", head).group().split()
    uv = os.environ.get("UV") or shutil.which("uv") or str(ROOT / ".uv" / "bin" / "uv")
    command[0] = uv
    made = subprocess.run(
        [*command, "--offline", "--quiet"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert listed == made.stdout, f"requirements.txt is older than uv.lock: {head.lstrip('# ')}"
    asked = {word for flag, word in itertools.pairwise(command) if flag == "--group"}
    assert asked | DEFAULT >= set(PROJECT["tool"]["replication"]["groups"])


@pytest.mark.skipif(not FOR_CONDA.exists(), reason="no environment.yml")
def test_conda_has_python_and_pip_which_has_the_list():
    conda = yaml.safe_load(FOR_CONDA.read_text(encoding="utf-8"))
    python = "python" + PROJECT["project"]["requires-python"]
    assert conda["dependencies"] == [python, "pip", {"pip": ["-r requirements.txt"]}]


def test_what_benchmarks_engines_and_clusters_need_is_not_installed_unasked():
    assert {"bench", "cluster", "crate", "engine", "notebooks"} & set(
        PROJECT["dependency-groups"]
    ) == OPTIONAL


def test_run_has_what_the_extras_of_the_library_name():
    groups = PROJECT["dependency-groups"]
    installed = {requirement for name in DEFAULT for requirement in groups[name]}
    installed |= {*MACHINE["project"]["optional-dependencies"]["workflow"]}
    extras = PROJECT["project"].get("optional-dependencies", {})
    assert {requirement for names in extras.values() for requirement in names} <= installed


def test_each_dependency_has_its_reason_in_contributing():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    reasons = re.findall(r"^- `([\w.-]+)`: \S", text, flags=re.MULTILINE)
    assert sorted(reasons) == sorted(declared())
