"""What may import what: the library no step, kernel and second solvers never each other."""

import ast
import sys

import pytest

import topheavy
from tests.cases import ROOT

LIBRARY = ROOT / "src" / "topheavy"
PATHS = {
    ".".join(path.relative_to(LIBRARY.parent).with_suffix("").parts).removesuffix(".__init__"): path
    for path in LIBRARY.rglob("*.py")
}


def imported(path):
    """The names that a file imports, wherever in it that stands."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def reached(room):
    """The modules of the library that those of a room import, these too, and so on."""
    found, left = set(), [name for name in PATHS if name.startswith(f"topheavy.{room}")]
    while left:
        if (name := left.pop()) in PATHS and name not in found:
            found.add(name)
            left += [*imported(PATHS[name]), name.rpartition(".")[0]]
        elif name.startswith("topheavy.") and name not in found:  # in a module, or at the door
            of = getattr(topheavy, name.removeprefix("topheavy."), None)
            left.append(getattr(of, "__module__", name.rpartition(".")[0]))
    return found


def first_names(folder):
    return {name.split(".")[0] for path in folder.rglob("*.py") for name in imported(path)}


def test_library_imports_no_step():
    assert first_names(LIBRARY).isdisjoint({"steps", "replication", "studies", "figures"})


def test_checker_imports_only_the_standard_library():
    assert first_names(LIBRARY / "proven" / "checking") <= sys.stdlib_module_names


@pytest.mark.parametrize(("room", "other"), [("kernel", "second"), ("second", "kernel")])
def test_kernel_and_second_solvers_never_reach_each_other(room, other):
    assert len(reached(room)) > 10
    assert [name for name in reached(room) if name.startswith(f"topheavy.{other}")] == []
