"""What the results of a rule depend on: modules that its script imports, versions, checksums.

A result has a seal: the digest of the code and parameters of the job that wrote it, and a checksum
of its content. Snakemake's own record in .snakemake can be lost or renewed without the result.
"""

import ast
import json
import platform
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import Any

FOLDERS = Path("src"), Path("figures")  # where the modules of this repository are
PACKAGES = {"yaml": "PyYAML", "mujoco": "mujoco-core", "flint": "python-flint"}
"""Packages whose name differs from that of their module."""


def checksums(paths: Iterable[str | Path]) -> dict[str, str]:
    """Return files with their checksums."""
    return {path: _checksum(path) for path in sorted(map(str, paths))}


def imported(*scripts: str) -> set[str]:
    """Return scripts and all modules of the repository that they import, directly or not."""
    modules: set[Path] = set()
    waiting = [Path(script) for script in scripts]
    while waiting:
        if (path := waiting.pop()) not in modules:
            modules.add(path)
            waiting += [file for name in _names(path) for file in _files(name)]
    return set(map(str, modules))


def versions(modules: Iterable[str]) -> dict[str, str]:
    """Return the versions of Python and of the packages that modules import."""
    tops = {name.split(".")[0] for path in modules for name in _names(Path(path))}
    packages = sorted(name for name in tops - sys.stdlib_module_names if not _files(name))
    return {"python": platform.python_version()} | {name: _version(name) for name in packages}


def digest(*contents: Any) -> str:
    """Return a checksum of parameters."""
    return sha256(repr(contents).encode()).hexdigest()[:12]


def is_sealed(path: str, digests: Iterable[str]) -> bool:
    """Return whether a job with one of some digests wrote a result as it is."""
    file = _seal_of(path)
    text = file.read_text("utf-8") if file.is_file() else ""
    digest = text.partition(" ")[0]
    return digest in digests and text == _seal(path, digest)


def write_seal(path: str, digest: str) -> None:
    """Seal a result of a job."""
    _seal_of(path).parent.mkdir(parents=True, exist_ok=True)
    _seal_of(path).write_text(_seal(path, digest), "utf-8")


def _seal_of(path: str) -> Path:
    return Path("results/seals", path.replace("/", "."))


def _seal(path: str, digest: str) -> str:
    content = Path(path).read_bytes() if Path(path).is_file() else b""  # none of a folder
    return f"{digest} {sha256(content).hexdigest()}"


@cache
def _checksum(path: str) -> str:
    return sha256(Path(path).read_bytes()).hexdigest()[:12]


@cache
def _version(module: str) -> str:
    try:
        return version(PACKAGES.get(module, module))
    except ModuleNotFoundError:
        return "not installed"


@cache
def _names(path: Path) -> tuple[str, ...]:
    """Return the dotted names that a module, or a notebook, imports anywhere in it."""
    if path.suffix not in (".py", ".ipynb"):  # a stub says where names are, and imports none
        return ()
    return tuple(_imports(path))


def _imports(path: Path) -> Iterator[str]:
    text, package = path.read_text("utf-8"), list(path.parent.parts[1:])
    if path.suffix == ".ipynb":
        cells = [cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code"]
        text = "\n".join("".join(cell["source"]) for cell in cells)
    tree, aliases = ast.parse(text, path), {}
    for node in _statements(tree):
        if isinstance(node, ast.Import):
            aliases |= {alias.asname or alias.name: alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level] if node.level else []
            base = ".".join([*above, *filter(None, [node.module])])
            yield from (f"{base}.{alias.name}" for alias in node.names)
    yield from aliases.values()
    ours = {name: module for name, module in aliases.items() if _is_package(module)}
    for node in ast.walk(tree) if ours else ():
        match node:  # a name of a package, which may be loaded lazily
            case ast.Attribute(value=ast.Name(id=package_name)) if package_name in ours:
                yield f"{ours[package_name]}.{node.attr}"


def _statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Return all statements, without their expressions: imports are statements."""
    waiting = [tree]
    while waiting:
        yield (node := waiting.pop())
        for block in ("body", "orelse", "finalbody", "handlers", "cases"):
            waiting += inner if isinstance(inner := getattr(node, block, None), list) else []


def _is_package(name: str) -> bool:
    """Return whether a dotted name is a package of this repository."""
    return any(folder.joinpath(*name.split(".")).is_dir() for folder in FOLDERS)


@cache
def _files(name: str) -> tuple[Path, ...]:
    """Return the module of a dotted name and its packages, also where it is loaded lazily."""
    parts = name.split(".")
    files: list[Path] = []
    for size in range(1, len(parts) + 1):
        for base in (folder.joinpath(*parts[:size]) for folder in FOLDERS):
            files += filter(Path.is_file, (base.with_suffix(".py"), base / "__init__.py"))
            stub = base / "__init__.pyi"
            if stub.is_file():
                place = _lazy(stub).get(name)
                files += [stub, *(_files(place) if place else ())]
    return tuple(files)


@cache
def _lazy(stub: Path) -> dict[str, str]:
    """Return where the names are that a package loads lazily (SPEC 1)."""
    package = ".".join(stub.parent.parts[1:])
    places = {f"{package}.{name.split('.')[-1]}": name for name in _imports(stub)}
    return {name: place for name, place in places.items() if name != place}
