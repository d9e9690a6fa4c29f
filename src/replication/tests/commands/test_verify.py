"""A finished tree against its RO-Crate."""

import hashlib

import pytest

from replication.commands.verify import main
from replication.origin.recorded import Crate


@pytest.fixture
def tree(tmp_path):
    """A tree as a run leaves it, and its crate."""
    files = {
        "results/tables/peaks.csv": "a,b\n1,2\n",
        "results/logs/peaks.log": "said\n",
        "results/costs.csv": "rule,seconds\n",
        "figures/peaks.svg": "<svg/>\n",
        "figures/peaks.py": "draw()\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    made = ("results/tables/peaks.csv", "figures/peaks.svg")
    return tmp_path, Crate(
        checksums={
            name: hashlib.sha256(files[name].encode()).hexdigest()
            for name in (*made, "figures/peaks.py")
        },
        rules=dict.fromkeys(made, "peaks"),
        left_out=("results/costs.csv", "results/logs"),
        version="",
    )


def test_tree_as_the_run_left_it_is_without_fault(tree):
    root, crate = tree
    assert main(crate, root) == []


def test_one_changed_byte_names_the_table(tree):
    root, crate = tree
    (root / "results/tables/peaks.csv").write_text("a,b\n1,3\n")
    (fault,) = main(crate, root)
    assert fault.startswith("results/tables/peaks.csv changed after rule peaks made it")


def test_missing_file_names_the_rule_that_makes_it(tree):
    root, crate = tree
    (root / "figures/peaks.svg").unlink()
    assert main(crate, root) == ["figures/peaks.svg is missing; rule peaks makes it"]


@pytest.mark.parametrize("name", ["results/new/other.csv", "results/x.txt", "figures/other.svg"])
def test_extra_file_is_named(tree, name):
    root, crate = tree
    (root / name).parent.mkdir(exist_ok=True)
    (root / name).write_text("?")
    assert main(crate, root) == [f"{name} is extra: no rule made it"]


def test_changed_input_is_named(tree):
    root, crate = tree
    (root / "figures/peaks.py").write_text("draw(2)\n")
    (fault,) = main(crate, root)
    assert fault.startswith("figures/peaks.py changed after the run: its SHA-256 is ")


@pytest.mark.parametrize("name", ["results/logs/claim.log", "results/costs.csv", "figures/new.py"])
def test_logs_costs_and_what_the_run_did_not_read_are_not_the_crates(tree, name):
    root, crate = tree
    (root / name).write_text("other than before")
    assert main(crate, root) == []
