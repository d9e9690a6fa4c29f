"""Whatever is missing, failed or interrupted is made again by the plain command."""

import os
import re
import shutil
import signal
from pathlib import Path

import pytest
import yaml

from tests.replication.begun import Run

ROOT = Path(__file__).parents[3]

SNAKEFILE = f"""
FIGURES = {{"figures/line": ["counts"]}}


include: "{ROOT}/src/replication/common.smk"


rule all:
    default_target: True
    input:
        everything,


rule counts:
    output:
        table="results/tables/counts.csv",
        findings="results/findings/counts.json",
    script:
        "src/steps/counts.py"


rule figure:
    input:
        tables=lambda wildcards: [f"results/tables/{{t}}.csv" for t in FIGURES[wildcards.figure]],
    output:
        "{{figure}}.svg",
    log:
        "results/logs/{{figure}}.log",
    wildcard_constraints:
        figure="|".join(FIGURES),
    script:
        "{{wildcards.figure}}.py"


rule claims:
    input:
        ledger="ledger.json",
        findings="results/findings/counts.json",
        drawn=[f"{{figure}}.svg" for figure in FIGURES],
    output:
        "results/claims.json",
    script:
        "src/steps/judging.py"


complete(workflow)
"""

COUNTS = """'''counts'''
from replication.workbench import run
from figures.beside import NUMBER


def main():
    return [{"n": NUMBER}], {"n": {"value": NUMBER, "error": 0.0}}


if __name__ == "__main__":
    run(snakemake, lambda job: main())
"""

FIGURE = """
from pathlib import Path
from replication.workbench import run

if __name__ == "__main__":
    run(snakemake, lambda job: Path(job.input.tables[0]).read_text())
"""

CLAIMS = """'''claims'''
import json
from pathlib import Path
from replication.workbench import run


def judge(job):
    found = json.loads(Path(job.input.findings).read_text())
    name = json.loads(Path(job.input.ledger).read_text())
    Path(job.output[0]).write_text(json.dumps(found[name]["value"]))


if __name__ == "__main__":
    run(snakemake, judge)
"""

PROFILE = yaml.safe_load((ROOT / "profiles/default/config.yaml").read_text(encoding="utf-8"))


OPTIONS = ["--scheduler=greedy", "--rerun-triggers", *PROFILE["rerun-triggers"]]


def make(root):
    """Run the workflow; return its exit status, and which rules ran."""
    status, said = Run(root, "--cores=1", *OPTIONS).communicate()
    told = r"(?: s  |^Error in rule )(counts|figure|claims):?$"
    return status, set(re.findall(told, said, flags=re.MULTILINE))


def edit(root, name, old, new):
    path = root / name
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.fixture(scope="module")
def finished(tmp_path_factory, plant):
    files = {
        "Snakefile": SNAKEFILE,
        "src/steps/counts.py": COUNTS,
        "figures/beside.py": "NUMBER = 1\n",
        "src/steps/judging.py": CLAIMS,
        "figures/line.py": FIGURE,
        "ledger.json": '"n"',
    }
    root = plant(tmp_path_factory.mktemp("finished"), files)
    assert make(root) == (0, {"counts", "figure", "claims"})
    assert (root / "results/claims.json").read_text() == "1"
    return root


@pytest.fixture
def tree(finished, tmp_path):
    """The finished tree, in a folder of its own."""
    root = tmp_path / "tree"
    shutil.copytree(finished, root)  # with the times of the files
    return root


def test_touched_files_rerun_nothing(tree):
    for path in tree.rglob("*"):
        if path.suffix in (".py", ".json") and "results" not in path.parts:
            path.touch()
    assert make(tree) == (0, set())


def test_change_in_an_imported_module_reruns_what_depends_on_it(tree):
    edit(tree, "figures/beside.py", "1", "2")
    assert make(tree) == (0, {"counts", "figure", "claims"})
    assert (tree / "results/claims.json").read_text() == "2"


def test_module_that_is_loaded_behind_the_declared_ones_fails_the_run(tree):
    (tree / "figures/hidden.py").write_text("")
    edit(tree, "src/steps/counts.py", "return", "exec('import ' + 'figures.hidden')\n    return")
    assert make(tree)[0] == 1
    log = (tree / "results/logs/counts.log").read_text()
    assert "rule counts loaded figures/hidden.py, which is not among its inputs" in log


@pytest.mark.parametrize("kind", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_step_is_made_again(tree, begin, kind):
    slow = "import time, pathlib; pathlib.Path('began').touch(); time.sleep(60)\n    return"
    edit(tree, "src/steps/counts.py", "return", slow)
    edit(tree, "figures/beside.py", "1", "3")
    run = begin(*OPTIONS, until="began", folder=tree)
    os.killpg(run.process.pid, kind)  # as a terminal does
    assert run.communicate(timeout=60)[0] != 0
    edit(tree, "src/steps/counts.py", slow, "return")
    assert make(tree) == (0, {"counts", "figure", "claims"})
    assert (tree / "results/claims.json").read_text() == "3"
