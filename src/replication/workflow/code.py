"""Find what a rule needs: files of the repository that a script imports, results a notebook reads.

Snakemake repeats a rule when its script changes, but not when an imported module changes. `code`
finds these modules when Snakemake reads the Snakefile. After a job, `undeclared` finds the modules
that the job loaded and that its rule did not declare.
"""

import ast
import json
import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

RESULT = re.compile(r"results/(?:tables/\w+\.csv|findings/\w+\.json)")
"""What a notebook may read of a run."""

IMPORT = re.compile(r"^(?:from [\w.]+ )?import (?:\([^)]*\)|.*)", re.MULTILINE)
"""An import statement of a Snakefile."""

ROOTS = ("src", ".")
"""Folders in which imported names are looked up, from the root of the repository, in this order."""

BELOW = re.compile(r"^[ \t]+(?:from|import)\b|\bimport_module\b", re.MULTILINE)
"""What a file has that imports below its top level, or by a call."""

SCRIPT = sys.modules["__main__"]
"""The script of the job. Libraries give it a second name, or take its own for themselves."""


def code(*scripts: str | Path, root: str | Path = ".") -> list[str]:
    """Return scripts, and the files of the repository that they import, directly or not.

    A name that a package loads lazily (SPEC 1: its `__init__.pyi` says from where) counts as an
    import of the module that defines it, and not of the whole package. Scripts are Python files,
    notebooks or Snakefiles; they are in the answer, as Snakemake compares the contents of inputs,
    and of the script of a rule only the time. All paths are from the root, and sorted.

    Raises
    ------
    FileNotFoundError
        When there is no such script.
    ValueError
        When a module imports one whose name is only known when it runs.
    """
    return list(_code(frozenset(map(Path, scripts)), Path(root)))


@cache
def _code(scripts: frozenset[Path], root: Path) -> list[str]:
    found, waiting = set(scripts), list(scripts)
    while waiting:
        for path in _read(root, waiting.pop())[0] - found:
            found.add(path)
            if path.suffix != ".pyi":
                waiting.append(path)
    return sorted(map(str, found))


def imported(root: str | Path, script: str | Path) -> frozenset[Path]:
    """Return the files of the repository that one file imports itself, from the root."""
    return _read(Path(root), Path(script))[0]


def docstring(script: str | Path, root: str | Path = ".") -> str:
    """Return the docstring of a Python file, from the root; empty without one."""
    return _read(Path(root), Path(script))[1]


def results_read(notebook: str | Path) -> list[str]:
    """Return the tables and findings that a notebook names, from the root, sorted."""
    return sorted(set(RESULT.findall(Path(notebook).read_text(encoding="utf-8"))))


def undeclared(declared: Iterable[str], root: str | Path = ".") -> list[str]:
    """Return the files of the repository that this process has imported and that are not declared.

    A declared path is from the root, or absolute.
    """
    root = Path(root).resolve()
    known = {(root / path).resolve() for path in declared}
    loaded = {
        Path(file).resolve()
        for module in list(sys.modules.values())
        if module is not SCRIPT and (file := getattr(module, "__file__", None))
    }
    ours = (path.relative_to(root) for path in loaded - known if path.is_relative_to(root))
    # Environments and Snakemake's copies of scripts lie in hidden folders.
    return sorted(str(path) for path in ours if not path.parts[0].startswith("."))


@cache
def _read(root: Path, path: Path) -> tuple[frozenset[Path], str]:
    """Return what one file imports itself, packages above it included, and its docstring."""
    text = _text(root, path)
    tree = ast.parse(text, str(path))
    plain = (each for node in tree.body if isinstance(node, ast.Import) for each in node.names)
    deep = BELOW.search(text) or any(_files(root, each.name, "") for each in plain)
    nodes = _nodes(tree) if deep else tree.body  # most files import at their top alone
    names = _names(nodes, path, _package(path))
    files = frozenset(file for name in names for file in _files(root, *name))
    return files, ast.get_docstring(tree) or ""


def _text(root: Path, path: Path) -> str:
    """Return a file as far as Python can read it."""
    text = (root / path).read_text(encoding="utf-8")
    if path.suffix == ".ipynb":
        cells = (cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code")
        lines = "\n".join("".join(cell["source"]) for cell in cells).splitlines()
        text = "\n".join(line for line in lines if not line.startswith(("%", "!")))
    elif path.suffix != ".py":  # a Snakefile, of which Python can read these statements alone
        text = "\n".join(IMPORT.findall(text))
    return text


def _package(path: Path) -> str:
    """Return the package that a file of a root lies in, for its relative imports."""
    for base in map(Path, ROOTS):
        if path.is_relative_to(base):
            return ".".join(path.parent.relative_to(base).parts)
    return ""


def _names(nodes: Iterable[ast.AST], path: Path, package: str) -> Iterator[tuple[str, str]]:
    """Yield every import as a module and a name in it; the name is "" for the module itself."""
    whole: dict[str, str] = {}  # what a name of this file stands for: `import lib as l`
    attributes = []
    for node in nodes:
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield alias.name, ""
                whole[alias.asname or alias.name] = alias.name
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) - node.level + 1]
            module = ".".join([*(above if node.level else []), *filter(None, [node.module])])
            for alias in node.names:
                yield module, alias.name
        elif isinstance(node, ast.Attribute):
            attributes.append(node)
        elif isinstance(node, ast.Call) and _called(node) == "import_module":
            if not (node.args and isinstance(node.args[0], ast.Constant)):
                raise ValueError(
                    f"{path}:{node.lineno}: the name of an imported module is only known when this "
                    "runs; expected an import statement, so that a change of it reruns its users"
                )
            yield node.args[0].value, ""
    for node in attributes:
        if isinstance(node.value, ast.Name) and node.value.id in whole:
            yield whole[node.value.id], node.attr


def _called(node: ast.Call) -> str:
    """Return the last name of what is called."""
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def _nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes below a node, except imports that serve only type annotations."""
    waiting = [tree]
    while waiting:
        for node in ast.iter_child_nodes(waiting.pop()):
            if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
                continue
            yield node
            waiting.append(node)


@cache
def _files(root: Path, module: str, name: str) -> tuple[Path, ...]:
    """Return the files that are read when a name is imported from a module."""
    return tuple(_modules(root, module, name))


def _modules(root: Path, module: str, name: str) -> Iterator[Path]:
    if not module:
        return
    parts = module.split(".")
    for base in ROOTS:
        folder = Path(base, *parts)
        plain = folder.with_name(f"{folder.name}.py")
        if (root / plain).is_file():
            yield from _above(root, base, parts[:-1])
            yield plain
            return
        if (root / folder).is_dir():
            yield from _above(root, base, parts)
            if not (root / folder / f"{name}.py").is_file():
                yield from _lazy(root, module, folder, name)
            elif name != "__init__":
                yield folder / f"{name}.py"
            return


def _above(root: Path, base: str, packages: Sequence[str]) -> Iterator[Path]:
    """Yield the `__init__` files that run before what is in a package."""
    for depth in range(len(packages)):
        for kind in ("__init__.py", "__init__.pyi"):
            path = Path(base, *packages[: depth + 1], kind)
            if (root / path).is_file():
                yield path


def _lazy(root: Path, package: str, folder: Path, name: str) -> Iterator[Path]:
    """Yield the module from which a package loads a name when it is first used."""
    stub = folder / "__init__.pyi"
    if not (root / stub).is_file():
        return
    for node in ast.parse((root / stub).read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom) and name in {alias.name for alias in node.names}:
            yield from _files(root, f"{package}.{node.module}", name)
