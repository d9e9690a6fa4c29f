"""A run repeats what changed and nothing else, and writes no result that could be stale.

A copy of the repository with a study of one quick rule, run by plain Snakemake.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FILES = {
    "study.smk": """
class Inputs(Study):
    factor: Positive


INPUTS = SETTINGS["tiny"] = read_config("studies/tiny/config.yaml", Inputs)


rule tiny:
    input:
        "studies/tiny/numbers.csv",
    output:
        table="results/tables/tiny.csv",
        findings="results/findings/tiny.json",
    params:
        code=code("studies/tiny/tiny.py", *SMALL) | STEP | library("bodies"),
        factor=INPUTS["factor"],
    log:
        "results/logs/tiny.log",
    script:
        "tiny.py"
""",
    "tiny.py": """
from replication.step import run, truth


def compute(numbers, factor):
    return numbers * factor


def findings(tiny, factor):
    return {"positive": truth((tiny.x > 0).all())}


if __name__ == "__main__":
    run(snakemake, compute, findings)
""",
    "config.yaml": "factor: 2.0\n",
    "numbers.csv": "x\n1.0\n2.0\n",
    "claims.yaml": "- {id: tiny_positive, where: here, statement: 'Positive, times {factor}.', "
    "rule: tiny, finding: positive, expected: confirmed}\n",
    "section.typ": "= Tiny\n",
}
TABLE = "results/tables/tiny.csv"


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    """A copy of the repository, in a folder whose name has a space, with the study `tiny`."""
    folder = tmp_path_factory.mktemp("a copy") / "topheavy"
    skipped = shutil.ignore_patterns(".*", "docs", "results", "reference", "__pycache__", "*.svg")
    shutil.copytree(ROOT, folder, ignore=skipped)
    study = folder / "studies" / "tiny"
    study.mkdir()
    for name, text in FILES.items():
        (study / name).write_text(text, encoding="utf-8")
    config = folder / "config" / "config.yaml"
    text = config.read_text(encoding="utf-8")
    config.write_text(text.replace("studies: [", "studies: [tiny, ", 1), encoding="utf-8")
    assert snakemake(folder, TABLE).returncode == 0
    return folder


def snakemake(tree, *words, **variables):
    command = [sys.executable, "-m", "snakemake", "--cores", "1", *words]
    path = f"{tree / 'src'}{os.pathsep}{tree}"
    env = {k: v for k, v in os.environ.items() if k != "RUN"} | {"PYTHONPATH": path} | variables
    return subprocess.run(command, cwd=tree, env=env, capture_output=True, text=True, timeout=120)


def has_run(tree, *words):
    run = snakemake(tree, TABLE, *words)
    assert run.returncode == 0, run.stdout + run.stderr
    return "Nothing to be done" not in run.stdout + run.stderr


def edit(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture
def edited(tree):
    """A function that edits a file of the tree; the test over, the file is as before."""
    kept = {}

    def change(path, old, new):
        kept.setdefault(tree / path, (tree / path).read_text(encoding="utf-8"))
        edit(tree / path, old, new)

    yield change
    for path, text in kept.items():
        path.write_text(text, encoding="utf-8")


def test_second_run_has_nothing_to_do(tree):
    assert not has_run(tree)


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("studies/tiny/config.yaml", "2.0", "3.0"),
        ("studies/tiny/tiny.py", "numbers * factor", "numbers * factor * 1"),
        ("src/topheavy/bodies/structures.py", '"""', '""" '),
        ("src/replication/step.py", '"""', '""" '),
    ],
)
def test_change_repeats_the_rule_also_when_the_file_is_older(tree, edited, path, old, new):
    has_run(tree)
    edited(path, old, new)
    os.utime(tree / path, (0, 0))
    assert has_run(tree)


@pytest.mark.parametrize("path", ["src/topheavy/risk/curve.py", "src/steps/draw.py"])
def test_change_elsewhere_repeats_nothing(tree, edited, path):
    has_run(tree)
    edited(path, '"""', '""" ')
    assert not has_run(tree)


def test_module_that_the_rule_does_not_name_stops_the_step(tree, edited):
    edited(
        "studies/tiny/tiny.py", "    return numbers", "    import topheavy.risk\n    return numbers"
    )
    run = snakemake(tree, TABLE)
    assert run.returncode != 0
    assert "rule tiny loaded src/topheavy/risk/" in run.stdout + run.stderr
    assert "Name it in `code`, or its folder by library(…)" in run.stdout + run.stderr


@pytest.mark.parametrize(
    ("path", "old", "new", "message"),
    [
        (
            "studies/tiny/tiny.py",
            "return numbers * factor",
            'return {"good": truth(True)}',
            "studies/tiny/tiny.py: compute returned {'good'",
        ),
        (
            "studies/tiny/tiny.py",
            "def compute(numbers,",
            "def compute(nmbers,",
            "compute takes 'nmbers'; rule tiny has the inputs numbers and the parameters factor",
        ),
        (
            "studies/tiny/tiny.py",
            "truth((tiny.x > 0).all())",
            "1.0",
            "the finding 'positive' is 1.0; expected value(…) or truth(…)",
        ),
        (
            "studies/tiny/study.smk",
            '"studies/tiny/numbers.csv"',
            '"results/tables/tinny.csv"',
            "rule tiny (studies/tiny/study.smk) reads results/tables/tinny.csv, which no rule",
        ),
        (
            "studies/tiny/study.smk",
            '"studies/tiny/tiny.py"',
            '"studies/tiny/tinny.py"',
            "a rule names the file studies/tiny/tinny.py, which is not there",
        ),
        (
            "studies/tiny/config.yaml",
            "factor",
            "facter",
            "studies/tiny/config.yaml: unknown key 'facter'; did you mean 'factor'?",
        ),
        (
            "studies/tiny/claims.yaml",
            "{factor}",
            "{facter}",
            "claim tiny_positive has {facter}, which is no key of the config; expected one of",
        ),
        (
            "config/config.yaml",
            "studies: [tiny, ",
            "studies: [tinny, ",
            "config/config.yaml: studies has 'tinny'; expected the name of a folder in studies/",
        ),
        ("config/config.yaml", "relative: ", "relatve: ", "did you mean 'relative'?"),
    ],
)
def test_mistake_is_told_with_its_file(tree, edited, path, old, new, message):
    edited(path, old, new)
    run = snakemake(tree, TABLE)
    assert run.returncode != 0
    assert message in run.stdout + run.stderr
    assert not list(tree.glob("results/*/*.new"))


def test_step_whose_run_has_ended_writes_nothing(tree, edited):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    edited("Snakefile", "str(os.getpid())", f'"{ended.pid}"')
    edited("studies/tiny/config.yaml", "2.0", "5.0")
    run = snakemake(tree, TABLE)
    assert run.returncode != 0
    assert "the run that began this step has ended: nothing is written" in run.stdout + run.stderr
    assert not list(tree.glob("results/*/*.new"))


def test_results_of_elsewhere_are_refused(tree):
    metadata = tree / ".snakemake" / "metadata"
    metadata.rename(tree / "elsewhere")
    run = snakemake(tree, TABLE)
    (tree / "elsewhere").rename(metadata)
    assert run.returncode != 0
    assert "results/ was made elsewhere" in run.stdout + run.stderr


def test_snakemake_lists_few_rules(tree):
    listed = snakemake(tree, "--list").stdout.split("\n")
    assert 15 < len([line for line in listed if line and not line.startswith(" ")]) <= 36
