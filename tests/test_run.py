"""A run repeats what changed and nothing else, and writes no result that could be stale.

A copy of the repository with two more quick rules, run by plain Snakemake.
"""

import json
import os
import re
from base64 import urlsafe_b64decode, urlsafe_b64encode
from contextlib import chdir

import pytest

from replication.sources import write_seal
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


rule reader:
    input:
        "results/tables/tiny.csv",
    output:
        table="results/reader.csv",
    params:
        code=code("src/steps/reader.py"),
    log:
        "results/logs/reader.log",
    script:
        "../src/steps/reader.py"
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
READER = """
from replication.step import run


def compute(tiny):
    return tiny


if __name__ == "__main__":
    run(snakemake, compute)
"""
CLAIM = """- {id: tiny_positive, where: here, statement: 'Positive, times {allen[factor]}.',
  finding: tiny.positive}
"""
TABLE = "results/tables/tiny.csv"


def record_of(path):
    """Return where Snakemake keeps its record of a result."""
    return f".snakemake/metadata/{urlsafe_b64encode(path.encode()).decode()}"


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the repository with the rule `tiny`."""
    folder = copied(tmp_path_factory.mktemp("run"))
    (folder / "data" / "numbers.csv").write_text("x\n1.0\n2.0\n", encoding="utf-8")
    (folder / "src" / "steps" / "tiny.py").write_text(SCRIPT, encoding="utf-8")
    (folder / "src" / "steps" / "reader.py").write_text(READER, encoding="utf-8")
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
    """Every result is there, empty and sealed, and Snakemake takes it as up to date."""
    code, words = snakemake(tree, "--summary")
    assert code == 0, words
    for line in words.splitlines():
        if line.count("\t") > 3 and not line.startswith("output_file"):
            path = tree / line.partition("\t")[0]
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch() if path.suffix else path.mkdir(exist_ok=True)
    edits = Edits(tree)
    edits("Snakefile", "if foreign := sorted(strays())", "if foreign := []")
    code, words = snakemake(tree, "--touch", "--forceall")
    assert code == 0, words
    edits.undo()
    for path in (tree / ".snakemake" / "metadata").iterdir():
        text = path.read_text("utf-8")
        digest = re.search(rf"'rule {json.loads(text)['rule']}': '(\w+)'", text)[1]
        with chdir(tree):
            write_seal(urlsafe_b64decode(path.name).decode(), digest)
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


def test_results_that_the_job_on_record_did_not_write_are_refused(finished, edited):
    """One has lost its record, one has that of another code, one was edited."""
    lost, renewed, changed = TABLE, "results/tables/vase.csv", "results/tables/friction_pulses.csv"
    for path in (record_of(lost), record_of(renewed), changed):
        edited(path, "", "")  # restored
    (finished / record_of(lost)).unlink()
    text = (finished / record_of(renewed)).read_text("utf-8")
    other = re.sub(r"('rule vase': ')\w+", r"\1" + 12 * "0", text)
    (finished / record_of(renewed)).write_text(other, "utf-8")
    (finished / changed).write_text("x\n3.0\n", "utf-8")
    os.utime(finished / changed, (0, 0))
    code, words = snakemake(finished, "--dry-run", "figures/where.svg")
    assert code == 1
    (named,) = re.findall("not what a job wrote here .*: rm (.*), or make clean", words)
    assert {*named.split()} == {lost, renewed, changed}


def test_results_of_a_job_that_died_are_made_again(finished, edited):
    edited(record_of(TABLE), "", "")
    edited(TABLE, "", "")
    (finished / TABLE).write_text("x\n3.0\n", "utf-8")
    mark = finished / record_of(TABLE).replace("metadata", "incomplete")
    mark.parent.mkdir(exist_ok=True)
    mark.write_text("{}", "utf-8")
    code, words = snakemake(finished, "--dry-run", TABLE)
    mark.unlink()
    assert code == 0, words
    assert re.search("^tiny +1$", words, re.MULTILINE)


def test_step_that_loads_an_undeclared_module_stops_and_writes_nothing(tree, edited):
    load = "    __import__('topheavy.risk')\n    return numbers"
    edited("src/steps/tiny.py", "    return numbers", load)
    code, words = snakemake(tree, TABLE)
    assert code == 1
    assert "rule tiny loaded src/topheavy/risk/" in words
    assert not (tree / TABLE).exists()


def test_step_stops_where_a_module_was_changed_after_the_run_began(tree, edited):
    path = "src/topheavy/bodies/structures.py"
    edited(path, "", "")  # restored
    edited(
        "src/steps/tiny.py",
        "    return numbers",
        f"    open('{path}', 'a').write('#')\n    return numbers",
    )
    code, words = snakemake(tree, TABLE)
    assert code == 1
    assert f"{path} was changed after the run began: run again" in words
    assert not (tree / TABLE).exists()


def test_step_stops_where_an_input_is_not_what_its_rule_wrote_for_this_run(tree, edited):
    spoil = (
        f"    open('{TABLE}', 'a').write('9.0')\n    return tiny"  # as a process of a dead run does
    )
    edited("src/steps/reader.py", "    return tiny", spoil)
    code, words = snakemake(tree, "results/reader.csv")
    assert code == 1
    assert f"rule reader reads {TABLE}, which its rule did not write" in words
    assert not (tree / "results/reader.csv").exists()
