"""Record which functions of library and studies a step calls; a row of the ledger names only these.

The first call of a function records its name and restores the function, so that later calls cost
nothing. A function that numba has compiled is not recorded; the Python function that calls it is.
"""

import ast
import functools
import os
import pkgutil
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType, ModuleType

OF_NO_ROW = ("replication", "steps")
"""The packages whose functions no row of a ledger may name (claims.schema.yaml)."""

DRAWS = "findings"
"""The function of a step that draws findings from its tables; what filled the tables is noted."""

PLACES = {path.name: "src" for path in Path("src").glob("*") if path.name not in OF_NO_ROW}
PLACES |= {"studies": "."}
"""The packages whose functions are noted, and the folder that each lies in, from the root."""

LIBRARIES = frozenset(PLACES) - {"studies"}
"""The packages that the steps take their code from."""


@contextmanager
def noted(modules: Iterable[tuple[str, ModuleType]]) -> Iterator[set[str]]:
    """Record the public functions and classes of modules that are called inside this context.

    It yields the full names, such as `lib.shapes.Body.mass`, a set that grows with the calls: each
    begins with the dotted name that a module is given with. A class is called when an object of it
    is made.
    """
    called: set[str] = set()
    waiting = {}
    try:
        for place, module in modules:
            for name, function in _functions(module):
                if function in waiting:  # the default of a field is a function of its class, too
                    continue
                waiting[function] = function.__code__
                _note_first_call(function, f"{place}.{name}", called)
        yield called
    finally:
        for function, code in waiting.items():
            _restore(function, code)


def library(declared: Iterable[str]) -> Iterator[tuple[str, ModuleType]]:
    """Yield the modules of library and studies that a rule declares, and the script of a study.

    Modules of the library that the step would load only later are loaded now.
    """
    for path in sorted(declared):
        name = _module_name(path)
        if name.split(".")[0] in LIBRARIES or name in sys.modules:
            yield name, pkgutil.resolve_name(f"{name}:")
    script = sys.modules["__main__"]
    if name := _module_name(os.path.relpath(getattr(script, "__file__", None) or "script")):
        yield name, script


def definition(name: str, root: str | Path = ".") -> str:
    """Return the full name of the object behind a public name, without importing it.

    `lib.simulate` is `lib.simulate.simulate`. A function goes before a module of its
    name, as in `citations.resolve`; within a package of its name, a longer name goes on.

    Raises
    ------
    ValueError
        When the repository defines no such function, class or method.
    """
    module, *parts = name.split(".")
    while parts and _place(module, root).is_dir():
        inner = f"{module}.{parts[0]}"
        within = len(parts) > 1 and _place(inner, root).is_dir()  # a package beside its function
        if not within and (source := _sources(_place(module, root), module).get(parts[0])):
            module = source
        else:
            module, parts = inner, parts[1:]
    file = _place(module, root).with_suffix(".py")
    body = _parsed(file.read_text(encoding="utf-8")) if file.is_file() else []
    for part in parts:
        found = [
            n for n in body if isinstance(n, ast.FunctionDef | ast.ClassDef) and n.name == part
        ]
        body = found[-1].body if found else []
    if not (parts and body):
        raise ValueError(f"{name} is no function or class of the repository")
    return ".".join([module, *parts])


@functools.cache  # many rows name functions of the same file
def _parsed(text: str) -> list[ast.stmt]:
    return ast.parse(text).body


def _place(module: str, root: str | Path) -> Path:
    top, *parts = module.split(".")
    in_src = top not in OF_NO_ROW and Path(root, "src", top).is_dir()
    return Path(root, "src" if in_src else ".", top, *parts)


def _module_name(path: str) -> str:
    """Return the dotted name of a Python file of the packages, "" of any other file."""
    for package, base in PLACES.items():
        if path.endswith(".py") and Path(path).is_relative_to(Path(base, package)):
            parts = Path(path).relative_to(base).with_suffix("").parts
            return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
    return ""


@functools.cache
def _sources(package: Path, name: str) -> dict[str, str]:
    """Return from which module a package takes each of its public names."""
    texts = [package / "__init__.pyi", package / "__init__.py"]
    nodes = [
        node
        for path in texts
        if path.is_file()
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.ImportFrom)
    ]
    return {
        alias.name: f"{name}.{node.module}" if node.level else str(node.module)
        for node in nodes
        for alias in node.names
    }


def _functions(module: ModuleType) -> Iterator[tuple[str, FunctionType]]:
    """Yield the public functions that a module defines, and the makers of its public classes."""
    for name, member in list(vars(module).items()):
        if name.startswith("_") or getattr(member, "__module__", None) != module.__name__:
            continue
        if name == DRAWS:
            continue
        if isinstance(member, type):
            if isinstance(maker := vars(member).get("__init__"), FunctionType):
                yield name, maker
            for inner, part in list(vars(member).items()):
                if not inner.startswith("_") and (function := _plain(part)):
                    yield f"{name}.{inner}", function
        elif function := _plain(member):
            yield name, function


def _plain(member: object) -> FunctionType | None:
    """Return the Python function of a member, under a cache, a property or a classmethod."""
    if isinstance(member, functools._lru_cache_wrapper):
        member = member.__wrapped__
    elif isinstance(member, property):
        member = member.fget
    elif isinstance(member, classmethod | staticmethod):
        member = member.__func__
    return member if isinstance(member, FunctionType) else None


def _stub(*args, _first_call, **keywords):  # type: ignore[no-untyped-def]
    return _first_call()(*args, **keywords)


def _note_first_call(function: FunctionType, name: str, called: set[str]) -> None:
    """Replace the code of a function by one that records its name, then restores the original.

    The function object stays the same, so that every reference to it is noted. Its defaults are
    left alone: threads may call it at any moment of this.
    """
    code = function.__code__

    def first_call() -> FunctionType:
        called.add(name)
        _restore(function, code)
        return function

    function.__kwdefaults__ = {**(function.__kwdefaults__ or {}), "_first_call": first_call}
    function.__code__ = _stub.__code__.replace(co_freevars=code.co_freevars)


def _restore(function: FunctionType, code: object) -> None:
    function.__code__ = code  # type: ignore[assignment]
    keywords = {k: v for k, v in (function.__kwdefaults__ or {}).items() if k != "_first_call"}
    function.__kwdefaults__ = keywords or None
