"""Two fresh runs of the small workflow give the same bytes."""

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DIFFERS = {"costs.csv", "manifest.json"}  # what a run took, and on which commit
OUTPUTS = ("results/tables", "results/findings", "results/notebooks", "figures", "paper", "results")


def copy_of_the_tree(to: Path) -> Path:
    """Copy what git tracks or would track; without git, what is there but for the run's own."""
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    if listed.returncode != 0:
        own = shutil.ignore_patterns(".*", "results", "__pycache__", "*.svg", "report.pdf")
        shutil.copytree(ROOT, to, ignore=own)
        shutil.copytree(ROOT / "docs", to / "docs", dirs_exist_ok=True)
        return to
    for name in listed.stdout.splitlines():
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, to / name)
    return to


def run(tree: Path) -> dict[str, str]:
    """Run the small workflow in a tree; return the checksum of every output."""
    source = {"PYTHONPATH": str(tree / "src")}  # the library of that tree, not the installed one
    command = [sys.executable, "-m", "snakemake", "--cores", "2"]
    command += ["--configfile", "config/quick.yaml", "--quiet", "all"]
    done = subprocess.run(
        command, cwd=tree, env=os.environ | source, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-3000:]
    return {
        str(path.relative_to(tree)): hashlib.sha256(path.read_bytes()).hexdigest()
        for folder in OUTPUTS
        for path in sorted((tree / folder).iterdir())
        if path.is_file() and path.name not in DIFFERS
    }


@pytest.fixture(scope="module")
def two_runs(tmp_path_factory):
    return [run(copy_of_the_tree(tmp_path_factory.mktemp(name))) for name in ("one", "two")]


def test_two_fresh_runs_give_the_same_bytes(two_runs):
    one, other = two_runs
    assert {name for name in {*one, *other} if one.get(name) != other.get(name)} == set()


def test_what_is_compared_is_the_whole_run(two_runs):
    names = set(two_runs[0])
    assert {"paper/report.pdf", "figures/spectra.svg", "results/notebooks/play.html"} <= names
    assert {"results/claims.json", "results/tables/spectra.csv", "results/animation.gif"} <= names
