"""The conda environment and the reasons for each dependency keep up with the lock."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[3]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
LOCK = tomllib.loads((ROOT / "uv.lock").read_text(encoding="utf-8"))
DEFAULT = set(PROJECT["tool"]["uv"]["default-groups"])
OPTIONAL = set(PROJECT["dependency-groups"]) - DEFAULT  # nothing installs them unasked
MACHINE = tomllib.loads((ROOT / "src/replication/pyproject.toml").read_text(encoding="utf-8"))
FOR_CONDA = ROOT / "environment.yml"
CONDA = yaml.safe_load(FOR_CONDA.read_text(encoding="utf-8")) if FOR_CONDA.exists() else None


def name_of(requirement):
    return re.match(r"[\w.-]+", requirement).group().lower()


def declared(left_out=frozenset()):
    """Names in pyproject.toml: the dependencies and every dependency group not left out."""
    groups = [g for name, g in PROJECT["dependency-groups"].items() if name not in left_out]
    groups.append(PROJECT["project"]["dependencies"])
    return {name_of(requirement) for group in groups for requirement in group} - {"replication"}


def needed():
    """Names of all packages that a run or a test needs, those of the machine included."""
    extras = MACHINE["project"]["optional-dependencies"]
    return declared(OPTIONAL) | {name_of(each) for name in DEFAULT for each in extras.get(name, [])}


def pinned_for_conda():
    """Names and versions in environment.yml, those that pip installs included."""
    *packages, python_packages = CONDA["dependencies"]
    pins = [p for p in packages if name_of(p) not in {"python", "pip"}]
    pins += [p for p in python_packages["pip"] if not p.startswith("-")]
    return dict(re.split("=+", pin) for pin in pins)


@pytest.mark.skipif(not CONDA, reason="no environment.yml")
def test_conda_has_what_pyproject_names_in_the_versions_of_the_lock():
    locked = [(package["name"], package.get("version")) for package in LOCK["package"]]
    assert sorted(pinned_for_conda().items()) == sorted(p for p in locked if p[0] in needed())
    (python,) = (p for p in CONDA["dependencies"][:-1] if name_of(p) == "python")
    assert python == "python" + PROJECT["project"]["requires-python"]


def test_what_benchmarks_engines_and_clusters_need_is_not_installed_unasked():
    assert {"bench", "cluster", "crate", "engine"} & set(PROJECT["dependency-groups"]) == OPTIONAL


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
