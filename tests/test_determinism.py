"""Two fresh runs of the small workflow give the same bytes."""

import shutil
from pathlib import Path

import pytest

from replication.provenance import checksum
from replication.tree_copy import copy_tree, run

DIFFERS = {"costs.csv", "manifest.json"}  # what a run took, and on which commit
OUTPUTS = ("results/tables", "results/findings", "results/notebooks", "figures", "paper", "results")
PROOFS = ("results/tables/equations.csv", "results/findings/equations.json")
"""What takes long and depends on no number: each whole run is compared with tests/reference."""


def run_small(tree: Path) -> dict[str, str]:
    """Run the small workflow in a tree; return the checksum of every output."""
    command = ["-m", "snakemake", "--cores", "2", "--configfile", "config/quick.yaml"]
    code, said = run(tree, *command, "--quiet", "all")
    assert code == 0, said[-3000:]
    return {str(path.relative_to(tree)): checksum(path) for path in outputs(tree)}


def outputs(tree: Path) -> list[Path]:
    paths = (path for folder in OUTPUTS for path in sorted((tree / folder).iterdir()))
    return [path for path in paths if path.is_file() and path.name not in DIFFERS]


def keep_the_proofs(tree: Path) -> None:
    """Delete all that a run has made but the proofs."""
    kept = {name: (tree / name).read_bytes() for name in PROOFS}
    shutil.rmtree(tree / "results")
    for path in (*tree.glob("figures/*.svg"), *tree.glob("paper/*.pdf")):
        path.unlink()
    for name, content in kept.items():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_bytes(content)


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    return tmp_path_factory.mktemp("copy") / "tree"


@pytest.fixture(scope="module")
def two_runs(tree):
    """The first compiles the kernel, the second loads what was compiled."""
    copy_tree(tree)
    first = run_small(tree)
    keep_the_proofs(tree)
    return first, run_small(tree)


def test_two_fresh_runs_give_the_same_bytes(two_runs):
    one, other = two_runs
    assert {name for name in {*one, *other} if one.get(name) != other.get(name)} == set()


def test_no_output_depends_on_where_the_tree_lies(two_runs, tree):
    named = {path.name for path in outputs(tree) if bytes(tree) in path.read_bytes()}
    assert named == set()


def test_what_is_compared_is_the_whole_run(two_runs):
    names = set(two_runs[0])
    assert {"paper/report.pdf", "figures/spectra.svg", "results/notebooks/play.html"} <= names
    assert {"results/claims.json", "results/tables/spectra.csv", "results/animation.gif"} <= names
