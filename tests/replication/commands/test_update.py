"""Another machine takes the place of an unchanged one, or none does and the reason is said."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from replication.commands import update

UPDATE = Path(update.__file__)
CHANGES = "# Changes\n\n## 1.1.0\n\nNewer.\n\n## 1.0.0\n\nFirst.\n"
TOOLS = {"uv": 'echo "$@" >> locked\n', "make": 'echo "$@" >> checked\n'}
PLACE = update.MACHINE


def git(folder, *words):
    who = ("-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "commit.gpgsign=false")
    done = subprocess.run(["git", *who, *words], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def commit(folder):
    git(folder, "init", "--quiet", "--initial-branch=main")
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--allow-empty", "--message=x")


@pytest.fixture
def machine(tmp_path, plant):
    """Make a repository with a machine of one module, the command, and what stays at home."""

    def make(version, text=None):
        files = {"VERSION": f"{version}\n", "CHANGES.md": CHANGES, "template/a.py": "a = 1\n"}
        files |= {"part.py": f"V = '{text or version}'\n", "commands/new_paper.py": "b = 1\n"}
        files["commands/update.py"] = UPDATE.read_bytes()
        folder = tmp_path / (text or version)
        plant(folder / PLACE, files)
        commit(folder)
        return folder

    return make


@pytest.fixture
def newer(machine):
    return machine("1.1.0")


@pytest.fixture
def paper(tmp_path, machine, plant):
    """A paper with the machine 1.0.0."""
    home = shutil.ignore_patterns(*(Path(path).name for path in update.AT_HOME))
    folder = tmp_path / "paper"
    shutil.copytree(machine("1.0.0") / PLACE, folder / PLACE, ignore=home)
    plant(folder, {"README.md": f"The machine, [1.0.0]({PLACE}/CHANGES.md).\n"})
    git(folder, "init", "--quiet", "--initial-branch=main")
    update.record(folder)
    commit(folder)
    return folder


def updated(paper, source, by=None, **fails):
    """Run the command of a tree (the paper's) in a paper; uv and make write down their words."""
    for name, text in TOOLS.items():
        tool = paper.parent / name
        tool.write_text(f"#!/bin/sh\n{text}exit {fails.get(name, 0)}\n", encoding="utf-8")
        tool.chmod(0o755)
    return subprocess.run(
        [sys.executable, "-I", "-S", (by or paper) / PLACE / "commands" / "update.py", str(source)],
        cwd=paper,
        env=os.environ | {"PATH": f"{paper.parent}:{os.environ['PATH']}", "UV": "uv"},
        capture_output=True,
        text=True,
    )


def tree(folder):
    return {str(p): p.read_bytes() for p in (folder / "src").rglob("*") if p.is_file()}


@pytest.mark.parametrize("by", ["folder", "url"])
def test_newer_machine_is_taken_locked_and_checked_and_once_more_at_one_version(
    paper, newer, machine, by
):
    source = newer.as_uri() if by == "url" else newer
    done = updated(paper, source)
    assert done.returncode == 0, done.stderr
    assert "The machine: 1.0.0 → 1.1.0" in done.stdout
    assert ("Newer." in done.stdout, "First." in done.stdout) == (True, False)
    assert (paper / PLACE / "part.py").read_text() == "V = '1.1.0'\n"
    assert not any((paper / path).exists() for path in update.AT_HOME)
    assert "The machine, [1.1.0](src/" in (paper / "README.md").read_text()
    assert "lock --quiet\nrun " in (paper / "locked").read_text()
    assert (paper / "checked").read_text().split()[1::2] == ["check"]
    commit(paper)
    assert "nothing to do" in updated(paper, source).stdout
    assert updated(paper, machine("1.1.0", "again")).returncode == 0
    assert (paper / PLACE / "part.py").read_text() == "V = 'again'\n"


def change(place):
    (place / "part.py").write_text("V = 'mine'\n")
    (place / "mine.py").touch()
    (place / "CHANGES.md").unlink()


@pytest.mark.parametrize(
    ("spoil", "committed", "said"),
    [
        *((change, False, f"{name} was changed by hand\n") for name in ("part.py", "mine.py")),
        (change, True, "and not that of .machine was changed by hand\n"),
        (lambda place: (place / "VERSION").unlink(), True, "and not that of .machine was changed"),
        (lambda place: (place.parents[1] / ".machine").unlink(), True, "there is no .machine; exp"),
    ],
)
@pytest.mark.parametrize("shallow", [False, True])
def test_machine_that_is_not_as_it_was_taken_is_kept(paper, newer, spoil, committed, said, shallow):
    if shallow:
        git(paper.parent, "clone", "--quiet", "--depth=1", paper.as_uri(), "shallow")
        paper = paper.parent / "shallow"
    spoil(paper / PLACE)
    if committed:
        commit(paper)
    before = tree(paper)
    done = updated(paper, newer, by=newer)
    assert done.returncode == 1
    assert "nothing is changed" in done.stderr
    assert said in done.stderr
    assert tree(paper) == before


def test_without_a_lock_nothing_is_changed_and_a_check_that_fails_is_told(paper, newer):
    before = tree(paper)
    assert "uv cannot lock the packages; nothing is changed" in updated(paper, newer, uv=2).stderr
    assert tree(paper) == before
    done = updated(paper, newer, make=2)
    assert done.returncode == 1
    assert "the machine is 1.1.0 now; make check fails as said above" in done.stderr


def test_changes_begin_with_the_version_of_the_machine():
    place = UPDATE.parents[1]
    changes = (place / "CHANGES.md").read_text("utf-8")
    assert update.news(changes, "0").startswith((place / "VERSION").read_text("utf-8").strip())
