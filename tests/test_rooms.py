"""The rooms of the library: few, in floors, and a wall between kernel and second solvers."""

import ast
import importlib
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import topheavy
from tests.cases import ROOT

SOURCE = ROOT / "src" / "topheavy"
SHARED = {"", "bodies", "bodies.structures", "checks", "ground", "ground.shapes", "keywords"}
"""What the kernel and the second solvers may both use: a block's numbers, the names of pulses."""


def name_of(path):
    parts = path.relative_to(SOURCE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in SOURCE.rglob("*.py")}
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in MODULES.items()}
AT_THE_DOOR = {  # which module a name at the front door is from
    alias.name: node.module or alias.name
    for node in ast.parse((SOURCE / "__init__.pyi").read_text(encoding="utf-8")).body
    if isinstance(node, ast.ImportFrom)
    for alias in node.names
}


def imports(module):
    """The modules that a module imports, wherever in it that stands, and the packages of these."""
    for node in ast.walk(TREES[module]):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        else:
            continue
        for name in names:
            first, _, inside = name.partition(".")
            if first == "topheavy":
                inside = AT_THE_DOOR.get(inside, inside)
                inside = inside if inside in MODULES else inside.rpartition(".")[0]
                parts = inside.split(".")
                yield from (".".join(parts[: k + 1]) for k in range(len(parts)))


def reached(start):
    """All modules that are imported when those of a room are."""
    found, left = set(), [name for name in MODULES if name.split(".")[0] == start]
    while left:
        if (name := left.pop()) not in found:
            found.add(name)
            left += imports(name)
    return found


ROOMS = {name.split(".")[0] for name in MODULES} - {""}
ARROWS = {
    (room, used.split(".")[0])
    for name in MODULES
    if (room := name.split(".")[0])
    for used in imports(name)
    if used and used.split(".")[0] != room
}


def test_there_are_few_rooms_on_floors():
    assert len(ROOMS) <= 13
    assert len(ARROWS) <= 40
    floors = {room: {used for user, used in ARROWS if user == room} for room in ROOMS}
    assert {*TopologicalSorter(floors).static_order()} == ROOMS


def test_kernel_and_second_solvers_never_reach_each_other():
    second, kernel = reached("second"), reached("kernel")
    assert len(second) > 10
    assert {name.split(".")[0] for name in second} & {"kernel", "outcomes"} == set()
    assert {name.split(".")[0] for name in kernel} & {"second"} == set()
    assert second & kernel == SHARED - {""}


@pytest.mark.parametrize("name", sorted(name for name in MODULES if "__main__" not in name))
def test_module_is_where_its_path_says_and_no_public_function_hides_it(name):
    path = f"topheavy.{name}".rstrip(".")
    module, found = importlib.import_module(path), topheavy
    for part in path.split(".")[1:]:
        found = getattr(found, part)
    assert found is module
    assert Path(module.__file__) == MODULES[name]


INNERMOST = {("advance", 11), ("short_series", 9), ("only_root", 9)}
"""Compiled functions of the innermost loop: what is grouped there would be stored and loaded."""


def test_functions_take_few_arguments_by_position():
    taken = {
        (node.name, len(node.args.posonlyargs + node.args.args))
        for tree in TREES.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef)
    }
    assert {pair for pair in taken if pair[1] > 8} == INNERMOST
