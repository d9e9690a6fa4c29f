"""Another paper: what `make paper` makes is complete and consistent, without this one."""

import os
import re
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
    """The files of a paper, without its machine."""
    machine = folder / update.MACHINE
    return [p for p in folder.rglob("*") if p.is_file() and machine not in p.parents]


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
