"""Rooms of the library, and studies that are whole: what may import and name what."""

import ast
import importlib
import re
import subprocess
from collections.abc import Iterable
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import topheavy
from replication.commands.new_study import SKELETON
from replication.inputs.strict_yaml import read_yaml
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


FREE = re.compile(
    r"docs/|tests/reference/|codecheck\.yml$"  # what commands write
    r"|.*\.(md|bib|ipynb)$|paper/(claims|words|assumptions)\.yaml$"  # prose
    r"|uv\.lock$|src/explorer/uplot/"  # by others
    r"|config/config\.yaml$"  # the list `studies`
)
"""Files that may name studies."""


EXCEPTIONS = {
    "paper/limits.yaml": "one list of the limits of the paper's and of the studies' claims",
    "profiles/slurm/test/run": "the test of the cluster runs one study, as a user does",
    "profiles/slurm/test/small.yaml": "the test of the cluster runs one study, as a user does",
}
"""Files that still name studies, and why."""


MADE = {"results", "__pycache__", "dist"}
"""Folders that a run or Python makes."""


def studies() -> set[str]:
    """Return the studies that are there, or were published; not the one that others begin as."""
    there = {path.parent.name for path in ROOT.glob("studies/*/config.yaml")}
    published = {path.stem for path in ROOT.glob("tests/reference/studies/*.yaml")}
    return (there | published) - {SKELETON}


def named(text: str, names: Iterable[str]) -> list[str]:
    """Return how a text names studies as an identifier, a path or a key, and not in prose."""
    found: set[str] = set()
    for name in names:
        pattern = (
            rf"studies[/.]{name}\b|\b{name}_[a-z]\w*|[\"']{name}[\"']|\b{name.upper()}\b"
            rf"|\[{name}[],]|, {name}\]|^ *{name}:"
        )
        found |= {match[0] for match in re.finditer(pattern, text, re.MULTILINE)}
    return sorted(found)


def source() -> list[str]:
    """Return the files that git tracks or would track; without git, those not hidden or made."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    names = listed.stdout.splitlines()
    if listed.returncode:
        paths = (path.relative_to(ROOT) for path in ROOT.rglob("*"))
        names = [path.as_posix() for path in paths if not MADE.intersection(path.parts)]
        names = [name for name in names if not re.search(r"(^|/)\.(?!ci|github)", name)]
    return [name for name in names if (ROOT / name).is_file()]


def naming(files: Iterable[str], names: Iterable[str]) -> dict[str, list[str]]:
    """Return those of the files that name studies, and how."""
    names = set(names)
    texts = {file: (ROOT / file).read_text("utf-8", errors="replace") for file in files}
    found = {file: named(text, names) for file, text in texts.items()}
    return {file: how for file, how in found.items() if how}


def test_no_file_outside_names_a_study():
    own = "tests/test_rooms.py"
    outside = [
        file
        for file in source()
        if not (file.startswith("studies/") or FREE.match(file) or file == own)
    ]
    found = naming(outside, studies())
    assert {file: how for file, how in found.items() if file not in EXCEPTIONS} == {}
    done = sorted(set(EXCEPTIONS) - set(found))
    assert done == [], f"strike {', '.join(done)} from EXCEPTIONS: they name no study any more"


@pytest.mark.parametrize(
    "study", sorted(path.parent.name for path in ROOT.glob("studies/*/study.smk"))
)
def test_study_names_no_other_but_those_that_it_needs(study):
    needed = read_yaml(ROOT / "studies" / study / "config.yaml").get("needs", [])
    files = [file for file in source() if file.startswith(f"studies/{study}/")]
    files = [file for file in files if not file.endswith((".md", "claims.yaml"))]
    assert naming(files, studies() - {study, *needed}) == {}


IMPORT_OF_STEPS = re.compile(r"^\s*from steps(?!\.shared\b)\S* import", re.MULTILINE)
OF_A_STEP = {
    "studies/reversals/subjects.py",  # the structures that a step compares
    "studies/certainty/subjects.py",  # the exchange of parameters that a step defines
    "studies/certainty/steps/shares.py",
}


def test_studies_import_of_the_steps_what_is_shared():
    modules = [
        file for file in source() if re.match(r"studies/\w+/(steps/|figures/|\w+\.py)", file)
    ]
    texts = {file: (ROOT / file).read_text("utf-8") for file in modules if file.endswith(".py")}
    assert {file for file, text in texts.items() if IMPORT_OF_STEPS.search(text)} <= OF_A_STEP
