"""The installed packages that results may depend on, with their versions."""

import platform
from collections.abc import Iterable, Mapping
from importlib import metadata
from typing import Any


def installed(lock: Mapping[str, Any], groups: Iterable[str] = ()) -> dict[str, str]:
    """Return the version of Python and of every installed package that a run may use, by name.

    These are the dependencies of the project and of these packages. What only tests or benchmarks
    use is not among them: its presence makes no difference. Results may depend on optional groups
    of pyproject.toml, too.
    """
    packages = {package["name"]: package for package in lock["package"]}
    (project,) = (each for each in lock["package"] if each["source"].get("editable") == ".")
    waiting = list(project["dependencies"])
    for group in groups:
        waiting += project["dev-dependencies"][group]
    needed: set[str] = set()
    while waiting:
        link = waiting.pop()
        package = packages[link["name"]]
        for extra in link.get("extra", []):
            waiting += package["optional-dependencies"][extra]
        if package["name"] not in needed:
            needed.add(package["name"])
            waiting += package.get("dependencies", [])
    versions = {name: version for name in sorted(needed) if (version := _version(name))}
    return {"python": platform.python_version()} | versions


def _version(name: str) -> str:
    """Return the version of a package, or "" where it is not installed."""
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""
