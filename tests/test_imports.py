"""What may import what: the library no step, and the plain solver nothing of ours."""

import ast
import sys

from tests.cases import ROOT

LIBRARY = ROOT / "src" / "topheavy"
AUDIT = ROOT / "src" / "audit.py"


def imported(path):
    """The names that a file imports, wherever in it that stands."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def first_names(folder):
    return {name.split(".")[0] for path in folder.rglob("*.py") for name in imported(path)}


def test_library_imports_no_step():
    assert first_names(LIBRARY).isdisjoint({"derivation", "steps", "replication", "figures"})


def test_the_plain_solver_shares_no_line_with_the_library_and_three_bodies_with_neither():
    assert first_names(LIBRARY).isdisjoint({"audit"})
    names = {name.split(".")[0] for name in imported(AUDIT)}
    assert names <= {*sys.stdlib_module_names, "numpy", "scipy"}
    assert AUDIT.read_text(encoding="utf-8").count("\n") <= 850
    shared = lines(AUDIT) & set().union(*map(lines, LIBRARY.rglob("*.py")))
    assert [line for line in shared if len(line) > 40] == []
    bodies = " ".join(imported(ROOT / "src/steps/shared/three_bodies.py"))
    assert not any(name in bodies for name in ("audit", "shared.plain", "topheavy.kernel"))


def lines(path):
    return {line.strip() for line in path.read_text(encoding="utf-8").splitlines()}
