"""Another machine takes the place of an unchanged one, or none does and the reason is said."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from replication.commands import update

UPDATE = Path(update.__file__)
CHANGES = """# Changes

## 1.1.0

Newer.

## 1.0.0

First.

## Before 1.0.0

1. Begin anew.
"""
TOOLS = {"uv": 'echo "$@" >> locked\n', "make": 'echo "$@" >> checked\n'}


@pytest.fixture
def machine(tmp_path, plant):
    """Make a tree with a machine of one module beside the command."""

    def make(version):
        files = {"VERSION": f"{version}\n", "CHANGES.md": CHANGES, "part.py": f"V = '{version}'\n"}
        files["commands/update.py"] = UPDATE.read_bytes()
        plant(tmp_path / version / update.MACHINE, files)
        return tmp_path / version

    return make


@pytest.fixture
def newer(machine):
    return machine("1.1.0")


@pytest.fixture
def paper(tmp_path, machine, plant):
    """A paper with the machine 1.0.0."""
    update.copy_machine(machine("1.0.0") / update.MACHINE, tmp_path / "paper" / update.MACHINE)
    readme = "The machine, [1.0.0](src/replication/CHANGES.md).\n"
    return plant(tmp_path / "paper", {"README.md": readme})


def updated(paper, source, by=None, **fails):
    """Run the command of a tree (the paper's) in a paper; uv and make write down their words."""
    for name, text in TOOLS.items():
        tool = paper.parent / name
        tool.write_text(f"#!/bin/sh\n{text}exit {fails.get(name, 0)}\n", encoding="utf-8")
        tool.chmod(0o755)
    script = (by or paper) / update.MACHINE / "commands" / "update.py"
    return subprocess.run(
        [sys.executable, "-I", "-S", script, source],
        cwd=paper,
        env=os.environ | {"PATH": f"{paper.parent}:{os.environ['PATH']}", "UV": "uv"},
        capture_output=True,
        text=True,
    )


def tree(folder):
    return {str(p): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize("by", ["folder", "url"])
def test_newer_machine_is_taken_locked_and_checked(paper, newer, by):
    source = str(newer)
    if by == "url":
        git = ["git", "-C", newer, "-c", "user.name=a", "-c", "user.email=a@b"]
        for words in (["init", "-q"], ["add", "."], ["commit", "-qm", "x"]):
            subprocess.run([*git, *words], check=True)
        source = newer.as_uri()
    done = updated(paper, source)
    assert done.returncode == 0, done.stderr
    assert "The machine: 1.0.0 → 1.1.0" in done.stdout
    assert "Newer." in done.stdout
    assert "First." not in done.stdout
    place = paper / update.MACHINE
    assert (place / "part.py").read_text() == "V = '1.1.0'\n"
    assert update.changed(place) == []
    assert "The machine, [1.1.0](src/" in (paper / "README.md").read_text()
    assert (paper / "locked").read_text() == "lock --quiet\n"
    assert (paper / "checked").read_text().split()[1::2] == ["pages", "check"]
    assert updated(paper, source).returncode == 0  # the same once more


def change(place):
    (place / "part.py").write_text("V = 'mine'\n")
    (place / "mine.py").touch()
    (place / "CHANGES.md").unlink()


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (change, "/CHANGES.md was changed by hand\n"),
        (change, "/mine.py was changed by hand\n"),
        (change, "/part.py was changed by hand\n"),
        (lambda place: (place / "VERSION").unlink(), "expected 1.0.0 or later.\n1. Begin anew."),
        (lambda place: (place / "SHA256SUMS").unlink(), "has no SHA256SUMS; expected a paper"),
    ],
)
def test_machine_that_is_not_as_it_was_copied_is_kept(paper, newer, spoil, said):
    spoil(paper / update.MACHINE)
    before = tree(paper)
    done = updated(paper, newer, by=newer)
    assert done.returncode == 1
    assert "nothing is changed" in done.stderr
    assert said in done.stderr
    assert tree(paper) == before


def test_older_or_changed_machine_is_not_taken(paper, newer, machine, tmp_path):
    older = machine("0.9.10")
    assert "FROM has version 0.9.10; expected at least 1.0.0" in updated(paper, older).stderr
    other = tmp_path / "other" / update.MACHINE
    update.copy_machine(newer / update.MACHINE, other)
    (other / "part.py").write_text("V = 'mine'\n")
    assert "was changed by hand: part.py" in updated(paper, tmp_path / "other").stderr


@pytest.mark.parametrize("source", ["", ".", "nowhere"])
def test_what_is_no_other_machine_is_refused(paper, source):
    done = updated(paper, source)
    assert done.returncode == 1
    assert f"FROM is '{source}'; expected another folder, or a repository" in done.stderr


def test_without_a_lock_nothing_is_changed_and_a_check_that_fails_is_told(paper, newer):
    before = tree(paper)
    done = updated(paper, newer, uv=2)
    assert "uv cannot lock the packages; nothing is changed" in done.stderr
    (paper / "locked").unlink()
    assert tree(paper) == before
    done = updated(paper, newer, make=2)
    assert done.returncode == 1
    assert "the machine is 1.1.0 now; make pages fails as it says above" in done.stderr


def test_changes_begin_with_the_version_of_the_machine():
    place = UPDATE.parents[1]
    changes = (place / "CHANGES.md").read_text("utf-8")
    assert update.news(changes, "0").startswith(update.version(place))
    assert "\n## Before 1.0.0\n" in changes
