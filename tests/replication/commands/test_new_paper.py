"""A new paper, and the update of its machine."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

from replication.commands import new_paper, update

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def paper(tmp_path_factory):
    return new_paper.create(tmp_path_factory.mktemp("papers") / "Swinging_far")


def files(folder):
    """The files of a paper, without its machine and what Python compiled of them."""
    machine = folder / update.MACHINE
    found = (path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc")
    return [path for path in found if machine not in path.parents]


def test_readme_names_every_place_of_the_example(paper):
    readme = (paper / "README.md").read_text("utf-8")
    example = re.compile(r"pendulum|period|theory\.motion|swing(?!ing)")
    unnamed = []
    for path in files(paper):
        place = path.relative_to(paper)
        of_example = example.search(f"{place}\n" + path.read_text("utf-8"))
        if not of_example or place.name == "README.md":
            continue
        if not any(f"`{each.as_posix()}`" in readme for each in (place, *place.parents)):
            unnamed.append(str(place))
    assert unnamed == []


def test_example_imports_no_more_than_a_paper_may(paper):
    text = (paper / update.MACHINE / "README.md").read_text("utf-8")
    listed = tuple(re.findall(r"`(replication\.[\w.]+)`", text))
    imported = re.compile(r"^ *from (replication[\w.]*) import (\w+)", re.MULTILINE)
    found = {
        ".".join(names)
        for path in files(paper)
        if path.suffix in {".py", ".smk", ""}
        for names in imported.findall(path.read_text("utf-8"))
    }
    assert found
    assert [name for name in found if not name.startswith(listed)] == []


def test_nothing_of_this_paper_goes_along(paper):
    ours = re.compile(
        r"topheavy(?! founders)|rocking|trilith|overturn|\bMakris|columns under|mujoco|heyoka", re.I
    )
    found = [
        f"{path.relative_to(paper)}: {line}"
        for path in paper.rglob("*")
        if path.is_file() and path.name not in ("uv.lock", "test_new_paper.py")
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines()
        if ours.search(line)
    ]
    assert found == []


def test_lock_has_the_versions_of_ours_and_no_package_too_many(paper):
    lock = tomllib.loads((paper / "uv.lock").read_text("utf-8"))["package"]
    ours = tomllib.loads((ROOT / "uv.lock").read_text("utf-8"))["package"]
    names = [package["name"] for package in lock]
    assert names == sorted(names)
    versions = {(p["name"], p["version"]) for p in lock} - {("swinging-far", "0.1.0")}
    assert versions < {(p["name"], p["version"]) for p in ours}
    assert {"snakemake", "sympy", "pytest"} <= set(names)
    assert not {"topheavy", "heyoka", "mujoco-core", "numba", "xarray"} & set(names)


def python(paper, *command, **environment):
    """Run Python in the folder of the paper."""
    return subprocess.run(
        [sys.executable, *command],
        cwd=paper,
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )


def test_published_edition_is_sound(paper):
    done = python(paper, "-m", "steps.recheck", PYTHONPATH=str(paper / "src"))
    assert "paper: 2 confirmed, 0 qualified, 0 slips, 1 misprint" in done.stdout
    assert done.stdout.endswith("tables, claims and pages agree\n"), done.stdout + done.stderr


def test_first_commit_is_on_the_branch_on_which_its_workflow_runs(paper, tmp_path, monkeypatch):
    (tmp_path / "gitconfig").write_text("[init]\n\tdefaultBranch = trunk\n", encoding="utf-8")
    for name in ("GLOBAL", "SYSTEM"):
        monkeypatch.setenv(f"GIT_CONFIG_{name}", str(tmp_path / "gitconfig"))
    workflow = yaml.safe_load((paper / ".github/workflows/ci.yaml").read_text("utf-8"))
    (branch,) = workflow[True]["push"]["branches"]  # YAML 1.1 reads on as true
    head = tmp_path / ".git/refs/heads" / branch
    (tmp_path / update.MACHINE).mkdir(parents=True)
    (tmp_path / update.MACHINE / "VERSION").write_text("1.0.0", encoding="utf-8")
    assert "git knows no author, so type: git config" in new_paper.first_commit(tmp_path)
    assert not head.exists()
    for name in ("AUTHOR_NAME", "AUTHOR_EMAIL", "COMMITTER_NAME", "COMMITTER_EMAIL"):
        monkeypatch.setenv(f"GIT_{name}", "a@b.c")
    assert f"committed on the branch {branch}" in new_paper.first_commit(tmp_path)
    assert head.exists()
    assert re.fullmatch(r"[0-9a-f]{40}\n", (tmp_path / update.TREE).read_text("utf-8"))


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("full", "is not empty"),
        ("with space", "has the character ' '"),
        ("___", "expected one with letters"),
        ("numpy", "is not the name of a package"),
        (str(ROOT / "other"), "which lies in"),
        ("", "is not empty"),
    ],
)
def test_folder_that_cannot_be_one_is_refused_and_left_alone(tmp_path, name, told):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").touch()
    before = files(tmp_path)
    with pytest.raises(ValueError, match=told):
        new_paper.create(tmp_path / name)
    assert files(tmp_path) == before
    assert not (ROOT / "other").exists()


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
def older_paper(tmp_path, machine, plant):
    """A paper with the machine 1.0.0."""
    home = shutil.ignore_patterns(*(Path(path).name for path in update.AT_HOME))
    folder = tmp_path / "paper"
    shutil.copytree(machine("1.0.0") / PLACE, folder / PLACE, ignore=home)
    plant(folder, {"README.md": f"The machine, [1.0.0]({PLACE}/CHANGES.md).\n"})
    git(folder, "init", "--quiet", "--initial-branch=main")
    update.record(folder)
    commit(folder)
    return folder


def updated(older_paper, source, by=None, **fails):
    """Run the command of a tree (the paper's) in a paper; uv and make write down their words."""
    for name, text in TOOLS.items():
        tool = older_paper.parent / name
        tool.write_text(f"#!/bin/sh\n{text}exit {fails.get(name, 0)}\n", encoding="utf-8")
        tool.chmod(0o755)
    return subprocess.run(
        [
            sys.executable,
            "-I",
            "-S",
            (by or older_paper) / PLACE / "commands" / "update.py",
            str(source),
        ],
        cwd=older_paper,
        env=os.environ | {"PATH": f"{older_paper.parent}:{os.environ['PATH']}", "UV": "uv"},
        capture_output=True,
        text=True,
    )


def tree(folder):
    return {str(p): p.read_bytes() for p in (folder / "src").rglob("*") if p.is_file()}


@pytest.mark.parametrize("by", ["folder", "url"])
def test_newer_machine_is_taken_locked_and_checked_and_once_more_at_one_version(
    older_paper, newer, machine, by
):
    source = newer.as_uri() if by == "url" else newer
    done = updated(older_paper, source)
    assert done.returncode == 0, done.stderr
    assert "The machine: 1.0.0 → 1.1.0" in done.stdout
    assert ("Newer." in done.stdout, "First." in done.stdout) == (True, False)
    assert (older_paper / PLACE / "part.py").read_text() == "V = '1.1.0'\n"
    assert not any((older_paper / path).exists() for path in update.AT_HOME)
    assert "The machine, [1.1.0](src/" in (older_paper / "README.md").read_text()
    assert "lock --quiet\nrun " in (older_paper / "locked").read_text()
    assert (older_paper / "checked").read_text().split()[1::2] == ["check"]
    commit(older_paper)
    assert "nothing to do" in updated(older_paper, source).stdout
    assert updated(older_paper, machine("1.1.0", "again")).returncode == 0
    assert (older_paper / PLACE / "part.py").read_text() == "V = 'again'\n"


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
def test_machine_that_is_not_as_it_was_taken_is_kept(
    older_paper, newer, spoil, committed, said, shallow
):
    if shallow:
        git(older_paper.parent, "clone", "--quiet", "--depth=1", older_paper.as_uri(), "shallow")
        older_paper = older_paper.parent / "shallow"
    spoil(older_paper / PLACE)
    if committed:
        commit(older_paper)
    before = tree(older_paper)
    done = updated(older_paper, newer, by=newer)
    assert done.returncode == 1
    assert "nothing is changed" in done.stderr
    assert said in done.stderr
    assert tree(older_paper) == before


def test_without_a_lock_nothing_is_changed_and_a_check_that_fails_is_told(older_paper, newer):
    before = tree(older_paper)
    assert (
        "uv cannot lock the packages; nothing is changed"
        in updated(older_paper, newer, uv=2).stderr
    )
    assert tree(older_paper) == before
    done = updated(older_paper, newer, make=2)
    assert done.returncode == 1
    assert "the machine is 1.1.0 now; make check fails as said above" in done.stderr


def test_changes_begin_with_the_version_of_the_machine():
    place = UPDATE.parents[1]
    changes = (place / "CHANGES.md").read_text("utf-8")
    assert update.news(changes, "0").startswith((place / "VERSION").read_text("utf-8").strip())
