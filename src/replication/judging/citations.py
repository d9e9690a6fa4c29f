"""Find the equations of the paper that a piece of code cites."""

import ast
import functools
import importlib
import inspect
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, is_dataclass
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from replication.judging.calls import LIBRARIES

_NUMBER = r"\(\d+\)"
_LIST = re.compile(rf"\bEqs?\.\s({_NUMBER}(?:\s?(?:–|,|and)\s?(?:Eqs?\.\s)?{_NUMBER})*)")


def equations_in(text: str) -> set[int]:
    """Return the numbers that a text cites: `Eq. (3)`, `Eqs. (4), (7)`, `Eqs. (4)–(9)`."""
    numbers: set[int] = set()
    for found in _LIST.finditer(" ".join(text.split())):
        for first, last in re.findall(r"\((\d+)\)(?:–\((\d+)\))?", found[1]):
            numbers.update(range(int(first), int(last or first) + 1))
    return numbers


def printed_list(numbers: Iterable[int]) -> str:
    """Return numbers as a text cites them: `Eq. (3)`, `Eqs. (3), (23)–(25)`."""
    runs: list[list[int]] = []
    for number in sorted(numbers):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    parts = [
        part
        for run in runs
        for part in ([f"({run[0]})–({run[-1]})"] if len(run) > 2 else [f"({n})" for n in run])
    ]
    return f"Eq{'s' * (sum(map(len, runs)) > 1)}. {', '.join(parts)}"


def resolve(path: str) -> Any:
    """Return the object of a dotted path. A function goes before a module of its name."""
    parent, _, name = path.rpartition(".")
    if not parent:
        return importlib.import_module(path)
    found = resolve(parent)
    if not isinstance(found, ModuleType) and not hasattr(found, name):
        found = importlib.import_module(parent)  # the module behind a function of its name
    return getattr(found, name) if hasattr(found, name) else importlib.import_module(path)


@dataclass(frozen=True)
class Citation:
    """A function or class of the library, its file and line, and the equations that it uses.

    `own` lists the equations that its source cites; `reached` adds those of the functions it calls.
    """

    name: str
    place: str
    own: frozenset[int]
    reached: frozenset[int]


@functools.cache
def cite(path: str, root: Path) -> Citation:
    """Return file, line and cited equations of a function or class, given by its dotted path."""
    found = _plain(resolve(path))
    file = Path(inspect.getsourcefile(found) or "").resolve().relative_to(root.resolve())
    line = inspect.getsourcelines(found)[1]
    own = equations_in(inspect.getsource(found))
    reached = {number for part in _reached(found) for number in equations_in(_source(part))}
    return Citation(path, f"{file}:{line}", frozenset(own), frozenset(own | reached))


def citing(number: int, root: Path) -> Iterator[str]:
    """Yield the functions of the library whose own source cites an equation: name, file, line."""
    for path in sorted(path for name in LIBRARIES for path in (root / "src" / name).rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        lines = text.split("\n")
        for node in ast.walk(ast.parse(text)) if f"({number})" in text else ():
            if isinstance(node, ast.FunctionDef):
                source = "\n".join(lines[node.lineno - 1 : node.end_lineno])
                if number in equations_in(source):
                    yield f"{node.name}  {path.relative_to(root)}:{node.lineno}"


def library_names(script: str | Path) -> list[str]:
    """Return the dotted paths of what a script takes from the library."""
    return _library_names(Path(script).read_text(encoding="utf-8"))


@functools.cache
def _library_names(text: str) -> list[str]:
    names = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in LIBRARIES:
            names += [f"{node.module}.{alias.name}" for alias in node.names]
    return sorted(name for name in set(names) if _is_code(_plain(resolve(name))))


# Functions that a function calls, directly or through others -------------------------------------


def _reached(start: Any) -> set[Any]:
    found, waiting = set(), [start]
    while waiting:
        part = waiting.pop()
        if part not in found:
            found.add(part)
            waiting += _called(part)
    return found


def _called(part: Any) -> Iterator[Any]:
    if inspect.isclass(part):
        for member in vars(part).values():
            function = _plain(getattr(member, "fget", None) or getattr(member, "__func__", member))
            if isinstance(function, FunctionType):
                yield from _called(function)
    elif isinstance(part, FunctionType):
        names = set(_names(part.__code__))
        for value in (part.__globals__.get(name) for name in names):
            if isinstance(value, ModuleType) and value.__name__.split(".")[0] in LIBRARIES:
                for name in names:
                    yield from _code_in(getattr(value, name, None))
            else:
                yield from _code_in(value)


def _code_in(value: Any) -> Iterator[Any]:
    """Yield a function or class, or those that a tuple or an entry of a table holds."""
    if isinstance(value, tuple):
        for part in value:
            yield from _code_in(part)
    elif is_dataclass(value) and not inspect.isclass(value):
        yield from _code_in(tuple(vars(value).values()))
    elif _is_code(found := _plain(value)):
        yield found


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)


def _plain(value: Any) -> Any:
    """Return the function below a cache or a compiler."""
    return inspect.unwrap(getattr(value, "py_func", value)) if callable(value) else value


def _is_code(value: Any) -> bool:
    ours = getattr(value, "__module__", None) or ""
    return (inspect.isclass(value) or isinstance(value, FunctionType)) and (
        ours.split(".")[0] in LIBRARIES
    )


_source = functools.cache(inspect.getsource)
