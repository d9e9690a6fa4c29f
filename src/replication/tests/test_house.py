"""Who may import whom, and from where: the walls of the house."""

import ast
import json
import re
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[3]
PACKAGES = sorted(path.name for path in (ROOT / "src").iterdir() if any(path.glob("*.py")))
LIBRARIES = [name for name in PACKAGES if name not in ("replication", "steps")]
SCRIPTS = ("steps", "figures", "studies")
"""What uses the libraries and the machine, and is imported by neither."""


def files(*folders: str, root: Path = ROOT) -> list[Path]:
    """Python files, notebooks, rules of folders, but for the machine's template and tests."""
    found = [path for folder in folders for path in (root / folder).rglob("*")]
    endings = (".py", ".pyi", ".ipynb", ".smk")
    return [p for p in found if p.suffix in endings and _seen(p, root)]


def _seen(path: Path, root: Path) -> bool:
    other = (ROOT / "src/replication/template", ROOT / "src/replication/tests")
    inside = path.relative_to(root).parts
    return not any(part.startswith(".") for part in inside) and not {*path.parents} & {*other}


def imports(path: Path) -> Iterator[str]:
    """The modules that a file imports, and a name with each that could be a module."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".smk":  # no Python as a whole
        for found in re.finditer(r"^\s*(?:from|import) ([\w.]+)", text, re.MULTILINE):
            yield found[1]
        return
    if path.suffix == ".ipynb":
        cells = (cell for cell in json.loads(text)["cells"] if cell["cell_type"] == "code")
        text = "\n".join("".join(cell["source"]) for cell in cells)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
            yield from (arg.value for arg in node.args[:1] if isinstance(arg, ast.Constant))


def importers(paths: list[Path], *packages: str) -> list[str]:
    """The files that import one of the packages, with what they import."""
    return [
        f"{path.relative_to(ROOT)} imports {name}"
        for path in paths
        for name in imports(path)
        if name.split(".")[0] in packages
    ]


def test_library_and_machine_are_there():
    assert LIBRARIES
    assert len(files("src/replication")) > 20


def test_machine_imports_no_library_and_no_script():
    assert importers(files("src/replication"), *LIBRARIES, *SCRIPTS) == []


@pytest.mark.parametrize("library", LIBRARIES)
def test_machine_does_not_name_the_library(library):
    named = [
        p for p in files("src/replication") if re.search(rf"\b{library}\b", p.read_text("utf-8"))
    ]
    assert named == []


@pytest.mark.parametrize("library", LIBRARIES)
def test_library_imports_neither_machine_nor_script(library):
    others = [name for name in LIBRARIES if name != library]
    assert importers(files(f"src/{library}"), "replication", *others, *SCRIPTS) == []


def arrows() -> set[tuple[str, str]]:
    """The rooms of the machine, modules and packages at its top, in pairs: one imports another.

    A pair of equals stands for the room itself.
    """
    pairs = set()
    for path in (path for path in files("src/replication") if path.suffix == ".py"):
        room = path.relative_to(ROOT / "src" / "replication").parts[0].removesuffix(".py")
        used = {name.split(".")[1] for name in imports(path) if name.startswith("replication.")}
        pairs |= {(room, other) for other in {room, *used}}
    return pairs


def test_machine_has_few_rooms_and_few_ways_between_them_and_none_leads_back():
    pairs = {(user, used) for user, used in arrows() if user != used}
    left = {user for user, _ in arrows()}
    assert len(left) <= 12
    assert len(pairs) <= 40
    while lowest := {room for room in left if not any((room, used) in pairs for used in left)}:
        left -= lowest
    assert left == set(), f"these rooms import each other: {sorted(left)}"


def test_studies_and_figures_use_the_stable_surface_of_the_machine():
    tests = {"tests", "benchmarks"}
    paths = files("figures", "studies")
    scripts = [path for path in paths if not tests & {*path.relative_to(ROOT).parts}]
    surface = (" replication.workbench.", " replication.drawing.")
    found = importers(scripts, "replication")
    assert found
    assert [line for line in found if not any(name in f"{line}." for name in surface)] == []


def test_figure_scripts_compute_no_physics():
    assert importers(files("figures"), *LIBRARIES) == []
    assert importers([p for p in files("studies") if p.parent.name == "figures"], *LIBRARIES) == []


def test_nothing_imports_a_study_but_the_study_itself_and_those_that_name_it_in_needs():
    outside = files("src", "figures", "notebooks", "benchmarks", "tests")
    assert importers(outside, "studies") == []
    for config in sorted(ROOT.glob("studies/*/config.yaml")):
        study = config.parent.name
        known = [study, *yaml.safe_load(config.read_text("utf-8")).get("needs", [])]
        found = importers(files(f"studies/{study}"), "studies")
        assert [x for x in found if not any(f" studies.{name}." in x for name in known)] == []


@pytest.mark.parametrize("package", PACKAGES)
def test_what_is_imported_lies_in_this_folder(package):
    """An editable install is an absolute path: a copy of this folder could run the original."""
    places = [Path(place).resolve() for place in find_spec(package).submodule_search_locations]
    assert places == [ROOT / "src" / package]
