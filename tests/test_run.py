"""A run repeats what changed and nothing else, and writes no result that could be stale.

A copy of the repository with a study of one quick rule, run by plain Snakemake.
"""

import os
import subprocess
import sys

import pytest

from tests.copies import Edits, copied, snakemake

FILES = {
    "study.smk": """
from replication.config import Positive, Study


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
        code=code("studies/tiny/tiny.py"),
        factor=INPUTS["factor"],
    log:
        "results/logs/tiny.log",
    script:
        "tiny.py"
""",
    "tiny.py": """
from replication.step import run, truth
from topheavy import Column


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
    """A copy of the repository with the study `tiny`, and its table."""
    folder = copied(tmp_path_factory.mktemp("run"))
    study = folder / "studies" / "tiny"
    study.mkdir()
    for name, text in FILES.items():
        (study / name).write_text(text, encoding="utf-8")
    Edits(folder)("config/config.yaml", "studies: [", "studies: [tiny, ")
    return folder


@pytest.fixture
def edited(tree):
    """A function that edits a file of the tree; the test over, the file is as before."""
    edits = Edits(tree)
    yield edits
    edits.undo()


@pytest.fixture
def done(tree):
    """The table is there and up to date."""
    code, told = snakemake(tree, TABLE)
    assert code == 0, told


def repeats(tree):
    code, told = snakemake(tree, "--dry-run", TABLE)
    assert code == 0, told
    return "Nothing to be done" not in told


@pytest.mark.usefixtures("done")
def test_change_elsewhere_repeats_nothing(tree, edited):
    edited("src/topheavy/risk/curve.py", '"""', '""" ')
    edited("src/steps/draw.py", '"""', '""" ')
    assert not repeats(tree)


@pytest.mark.usefixtures("done")
@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("studies/tiny/config.yaml", "2.0", "3.0"),
        ("studies/tiny/numbers.csv", "1.0", "1.5"),
        ("studies/tiny/tiny.py", "numbers * factor", "numbers * factor * 1"),
        ("src/topheavy/bodies/structures.py", '"""', '""" '),
    ],
)
def test_change_repeats_the_rule_also_when_the_file_is_older(tree, edited, path, old, new):
    edited(path, old, new)
    os.utime(tree / path, (0, 0))
    assert repeats(tree)


@pytest.mark.parametrize(
    ("path", "old", "new", "message"),
    [
        (
            "studies/tiny/study.smk",
            '"studies/tiny/numbers.csv"',
            '"results/tables/tinny.csv"',
            "rule tiny (studies/tiny/tiny.py) reads results/tables/tinny.csv, which no rule",
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
def test_mistake_is_told_with_its_file_before_any_job(tree, edited, path, old, new, message):
    edited(path, old, new)
    code, told = snakemake(tree, "--dry-run", TABLE)
    assert code == 1
    assert message in told


@pytest.mark.parametrize(
    ("path", "old", "new", "messages"),
    [
        (
            "studies/tiny/tiny.py",
            "    return numbers",
            "    __import__('topheavy.risk')\n    return numbers",
            [
                "rule tiny loaded src/topheavy/risk/",
                "Import it by a statement, or name it in `code`",
            ],
        ),
        (
            "studies/tiny/tiny.py",
            "def compute(numbers,",
            "def compute(nmbers,",
            ["compute takes 'nmbers'; rule tiny has the inputs numbers and the parameters factor"],
        ),
        (
            "Snakefile",
            "str(os.getpid())",
            "ENDED",
            ["the run that began this step has ended: nothing is written"],
        ),
    ],
    ids=["undeclared module", "unknown name", "ended run"],
)
def test_step_stops_and_writes_nothing(tree, edited, path, old, new, messages):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    edited(path, old, new.replace("ENDED", f'"{ended.pid}"'))
    edited("studies/tiny/config.yaml", "2.0", "5.0")
    code, told = snakemake(tree, TABLE)
    assert code == 1
    assert all(message in told for message in messages)
    assert not list(tree.glob("results/*/*.new"))


@pytest.mark.usefixtures("done")
def test_results_of_elsewhere_are_refused(tree):
    metadata = tree / ".snakemake" / "metadata"
    metadata.rename(tree / "elsewhere")
    code, told = snakemake(tree, "--dry-run", TABLE)
    (tree / "elsewhere").rename(metadata)
    assert code == 1
    assert "results/ was made elsewhere" in told
