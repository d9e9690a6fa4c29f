"""A run repeats what changed and nothing else, and writes no result that could be stale.

A copy of the repository with one more quick rule, run by plain Snakemake.
"""

import os
import re

import pytest

from tests.copies import Edits, copied, snakemake

RULE = """

rule tiny:
    input:
        "data/numbers.csv",
    output:
        table="results/tables/tiny.csv",
        findings="results/findings/tiny.json",
    params:
        code=code("src/steps/tiny.py"),
        factor=PAPER["allen"]["factor"],
    log:
        "results/logs/tiny.log",
    script:
        "../src/steps/tiny.py"
"""
SCRIPT = """
from replication.step import run, truth
from topheavy import Column


def compute(numbers, factor):
    return numbers * factor


def findings(tiny, factor):
    return {"positive": truth((tiny.x > 0).all())}


if __name__ == "__main__":
    run(snakemake, compute, findings)
"""
CLAIM = """- {id: tiny_positive, where: here, statement: 'Positive, times {allen[factor]}.',
  finding: tiny.positive}
"""
TABLE = "results/tables/tiny.csv"


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the repository with the rule `tiny`."""
    folder = copied(tmp_path_factory.mktemp("run"))
    (folder / "data" / "numbers.csv").write_text("x\n1.0\n2.0\n", encoding="utf-8")
    (folder / "src" / "steps" / "tiny.py").write_text(SCRIPT, encoding="utf-8")
    (folder / "tests" / "reference").mkdir(exist_ok=True)
    (folder / "tests" / "reference" / "tiny.csv").write_text("x\n2.0\n4.0\n", encoding="utf-8")
    for path, text in (("rules/beyond.smk", RULE), ("paper/claims.yaml", CLAIM)):
        with (folder / path).open("a", encoding="utf-8") as file:
            file.write(text)
    return folder


@pytest.fixture
def edited(tree):
    """A function that edits a file of the tree; the test over, the file is as before."""
    edits = Edits(tree)
    yield edits
    edits.undo()


@pytest.fixture(scope="module")
def finished(tree):
    """Every result is there, empty, and Snakemake takes it as up to date."""
    code, words = snakemake(tree, "--summary")
    assert code == 0, words
    for line in words.splitlines():
        if line.count("\t") > 3 and not line.startswith("output_file"):
            path = tree / line.partition("\t")[0]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch() if path.suffix else path.mkdir(exist_ok=True)
    (tree / ".snakemake" / "metadata").mkdir(parents=True, exist_ok=True)
    code, words = snakemake(tree, "--touch", "--forceall")
    assert code == 0, words
    return tree


PAGE = "results/explorer.html"


@pytest.mark.parametrize(
    "changes",  # none of a set reaches the target of another; files, and what they repeat
    [
        {
            "data/numbers.csv": ("tiny", TABLE),
            "src/steps/beyond/friction.py": ("friction", "results/tables/friction_pulses.csv"),
            "src/explorer/page.js": ("explorer", PAGE),
            "notebooks/play.ipynb": ("notebook_play", "results/notebooks/play.html"),
            "figures/style.mplstyle": ("paper_figures", "figures/where.svg"),
            "figures/captions.yaml": ("site", "results/verdicts.md"),
            "tests/reference/tiny.csv": ("comparison", "results/comparison.csv"),
            "paper/report.typ": ("report", "paper/report.pdf"),
        },
        {
            "src/topheavy/bodies/structures.py": ("tiny", TABLE),
            "data/records/el_centro_1940_NS.AT2": ("explorer", PAGE),
            "figures/where.py": ("paper_figures", "figures/where.svg"),
            "paper/claims.yaml": ("claims", "results/claims.json"),
            "paper/references.bib": ("supplement", "paper/supplement.pdf"),
        },
        {"config/config.yaml": ("vase", "figures/vase.svg")},  # also after a job has died
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_change_repeats_the_rule_also_when_the_file_is_older(finished, edited, changes):
    for path in changes:
        text = (finished / path).read_text("utf-8")
        edited(path, text, text.replace("longest: 2.0", "longest: 2.1") + "\n")
        os.utime(finished / path, (0, 0))
    rules, targets = zip(*changes.values(), strict=True)
    lost = [*finished.glob("results/tables/vase*.csv")] if "vase" in rules else []
    for path in lost:  # as Snakemake does when a job fails: the old picture is there
        path.rename(path.with_suffix(".gone"))
    code, words = snakemake(finished, "--dry-run", *targets)
    for path in lost:
        path.with_suffix(".gone").rename(path)
    assert code == 0, words
    for rule in rules:
        assert re.search(rf"^{rule} +1$", words, re.MULTILINE), rule


def test_change_elsewhere_repeats_nothing_and_a_mistake_is_told_before_any_job(finished, edited):
    edited("src/topheavy/risk/curve.py", '"""', '""" ')
    edited("src/documents/draw.py", '"""', '""" ')
    code, words = snakemake(finished, "--dry-run", TABLE, PAGE, "results/tables/vase.csv")
    assert code == 0, words
    assert "Nothing to be done" in words
    edited("rules/beyond.smk", "data/numbers.csv", "results/tables/tinny.csv")
    code, words = snakemake(finished, "--dry-run", TABLE)
    assert code == 1
    assert "tiny (src/steps/tiny.py) reads results/tables/tinny.csv, which no rule makes" in words


def test_step_that_loads_an_undeclared_module_stops_and_writes_nothing(tree, edited):
    load = "    __import__('topheavy.risk')\n    return numbers"
    edited("src/steps/tiny.py", "    return numbers", load)
    code, words = snakemake(tree, TABLE)
    assert code == 1
    assert "rule tiny loaded src/topheavy/risk/" in words
    assert not (tree / TABLE).exists()


def test_results_of_elsewhere_are_refused(finished):
    metadata = finished / ".snakemake" / "metadata"
    metadata.rename(finished / "elsewhere")
    code, words = snakemake(finished, "--dry-run", TABLE)
    (finished / "elsewhere").rename(metadata)
    assert code == 1
    assert "results/ was made elsewhere" in words
