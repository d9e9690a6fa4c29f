"""Two fresh runs of the small workflow give the same bytes."""

from pathlib import Path

import pytest

from replication.provenance import checksum
from replication.tree_copy import copy_tree, run

DIFFERS = {"costs.csv", "manifest.json"}  # what a run took, and on which commit
OUTPUTS = ("results/tables", "results/findings", "results/notebooks", "figures", "paper", "results")


def run_fresh(tree: Path) -> dict[str, str]:
    """Run the small workflow in a copy of the tree; return the checksum of every output."""
    copy_tree(tree)
    command = ["-m", "snakemake", "--cores", "2", "--configfile", "config/quick.yaml"]
    code, said = run(tree, *command, "--quiet", "all")
    assert code == 0, said[-3000:]
    return {
        str(path.relative_to(tree)): checksum(path)
        for folder in OUTPUTS
        for path in sorted((tree / folder).iterdir())
        if path.is_file() and path.name not in DIFFERS
    }


@pytest.fixture(scope="module")
def two_runs(tmp_path_factory):
    return [run_fresh(tmp_path_factory.mktemp(name)) for name in ("one", "two")]


def test_two_fresh_runs_give_the_same_bytes(two_runs):
    one, other = two_runs
    assert {name for name in {*one, *other} if one.get(name) != other.get(name)} == set()


def test_what_is_compared_is_the_whole_run(two_runs):
    names = set(two_runs[0])
    assert {"paper/report.pdf", "figures/spectra.svg", "results/notebooks/play.html"} <= names
    assert {"results/claims.json", "results/tables/spectra.csv", "results/animation.gif"} <= names
