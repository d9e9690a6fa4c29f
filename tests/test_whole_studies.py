"""A study is whole: no file outside its folder names it, but for the list of the config."""

import re
import subprocess
from collections.abc import Iterable
from pathlib import Path

import pytest

from replication.commands.new_study import SKELETON
from replication.inputs.strict_yaml import read_yaml

ROOT = Path(__file__).parents[1]
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
    own = "tests/test_whole_studies.py"
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


SHARED = re.compile(r"^\s*from steps(?!\.shared\b)\S* import", re.MULTILINE)
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
    assert {file for file, text in texts.items() if SHARED.search(text)} <= OF_A_STEP
