"""A finished tree against its manifest."""

import hashlib

import pytest

from replication.commands.verify import main


@pytest.fixture
def tree(tmp_path):
    """A tree as a run leaves it, and its manifest."""
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
    outputs = {
        name: {"sha256": hashlib.sha256(files[name].encode()).hexdigest(), "rule": "peaks"}
        for name in ("results/tables/peaks.csv", "figures/peaks.svg")
    }
    left_out = ["results/costs.csv", "results/logs"]
    return tmp_path, {"outputs": outputs, "folders": ["results"], "left_out": left_out}


def test_tree_as_the_run_left_it_is_without_fault(tree):
    root, manifest = tree
    assert main(manifest, root) == []


def test_one_changed_byte_names_the_table(tree):
    root, manifest = tree
    (root / "results/tables/peaks.csv").write_text("a,b\n1,3\n")
    (fault,) = main(manifest, root)
    assert fault.startswith("results/tables/peaks.csv changed after rule peaks made it")


def test_missing_file_names_the_rule_that_makes_it(tree):
    root, manifest = tree
    (root / "figures/peaks.svg").unlink()
    assert main(manifest, root) == ["figures/peaks.svg is missing; rule peaks makes it"]


@pytest.mark.parametrize("name", ["results/new/other.csv", "results/x.txt", "figures/other.svg"])
def test_extra_file_is_named(tree, name):
    root, manifest = tree
    (root / name).parent.mkdir(exist_ok=True)
    (root / name).write_text("?")
    assert main(manifest, root) == [f"{name} is extra: no rule made it"]


@pytest.mark.parametrize("name", ["results/logs/claim.log", "results/costs.csv", "figures/new.py"])
def test_logs_costs_and_sources_are_not_the_manifests(tree, name):
    root, manifest = tree
    (root / name).write_text("other than before")
    assert main(manifest, root) == []
