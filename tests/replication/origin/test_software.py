"""The versions of the packages that a run may use."""

import platform
import tomllib
from importlib import metadata
from pathlib import Path

from replication.origin.software import installed

ROOT = Path(__file__).parents[3]
LOCK = {
    "package": [
        {
            "name": "peaks",
            "source": {"editable": "."},
            "dependencies": [{"name": "numpy"}, {"name": "jsonschema", "extra": ["format"]}],
            "dev-dependencies": {"dev": [{"name": "pytest"}], "engine": [{"name": "sympy"}]},
        },
        {"name": "numpy", "source": {}, "dependencies": [{"name": "nowhere-installed"}]},
        {"name": "nowhere-installed", "source": {}},
        {
            "name": "jsonschema",
            "source": {},
            "dependencies": [{"name": "attrs"}],
            "optional-dependencies": {"format": [{"name": "idna"}], "other": [{"name": "ruff"}]},
        },
        *({"name": name, "source": {}} for name in ("attrs", "idna", "pytest", "ruff", "sympy")),
    ]
}


def test_installed_dependencies_are_told_and_none_of_tests():
    names = ["python", "attrs", "idna", "jsonschema", "numpy"]
    assert list(installed(LOCK)) == names
    assert list(installed(LOCK, ["engine"])) == [*names, "sympy"]


def test_versions_are_those_that_are_installed():
    found = installed(LOCK)
    assert found["python"] == platform.python_version()
    assert found["numpy"] == metadata.version("numpy")


def test_packages_that_compute_are_among_ours():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    lock = tomllib.loads((ROOT / "uv.lock").read_text(encoding="utf-8"))
    groups = project["tool"]["replication"]["groups"]
    found = installed(lock, groups)
    assert {"numpy", "scipy", "snakemake", "rocrate"} <= set(found)
    assert not {"pytest", "ruff", "roc-validator"} & set(found)
    assert set(groups) <= set(project["dependency-groups"])
