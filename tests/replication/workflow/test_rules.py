"""Rules: the code of their scripts, what completes them, results that nobody makes or uses."""

import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest
from snakemake.exceptions import WorkflowError

from replication.inputs.parts import edition_of
from replication.pages.captions import check_captions
from replication.tests.test_house import imports
from replication.workflow.code import code, undeclared
from replication.workflow.provenance import Job, makers, workflow_jobs
from replication.workflow.unmade import made_by, refuse_unmade
from steps import publish

ROOT = Path(__file__).parents[3]


@pytest.fixture
def tree(tmp_path, plant):
    """A small repository: a lazy package, steps beside each other, a study."""
    files = {
        "src/lib/__init__.py": "import lazy_loader\n"
        "__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)\n",
        "src/lib/__init__.pyi": "from .shapes import Shape\nfrom .forces import force\n"
        "from .files import read\n",
        "src/lib/files/__init__.py": "from lib.files.text import read\n",
        "src/lib/files/text.py": "read = open\n",
        "src/lib/shapes.py": "import math\nShape = math.pi\n",
        "src/lib/forces.py": "from lib.shapes import Shape\nforce = Shape\n",
        "src/lib/inner/__init__.py": "def load():\n    from lib.inner import core\n\n\nload()\n",
        "src/lib/inner/core.py": "CORE = 1\n",
        "src/steps/shared.py": "import lib\nSHARED = lib.Shape\n",
        "studies/one/deep.py": "DEEP = 1\n",
    }
    return plant(tmp_path, files)


def imported_by(tree, text, name="src/steps/step.py"):
    (tree / name).write_text(text)
    return [path for path in code(name, root=tree) if path != name]


LAZY = ["src/lib/__init__.py", "src/lib/__init__.pyi"]
SHAPES = [*LAZY, "src/lib/shapes.py"]
FORCES = [*LAZY, "src/lib/forces.py", "src/lib/shapes.py"]
FILES = [*LAZY, "src/lib/files/__init__.py", "src/lib/files/text.py"]
INNER = [*LAZY, "src/lib/inner/__init__.py", "src/lib/inner/core.py"]
NO_PACKAGES = "from steps.shared import SHARED\nfrom studies.one.deep import DEEP\n"
FOR_TYPES = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from lib import force\n"
CELL = """{"cells": [{"cell_type": "code",
"source": ["%matplotlib inline\\n", "import lib\\n", "lib.Shape"]}]}"""


ALL = "from lib import (\n    Shape,\n)\n\nrule all:\n    input: 'from lib import force'\n"


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("step.py", "from lib import Shape", SHAPES),
        ("step.py", "from lib import read", FILES),
        ("step.py", "from lib.forces import force", FORCES),
        ("step.py", "import lib as l\nprint(l.force)", FORCES),
        ("step.py", "def f():\n    import lib.inner", INNER),
        ("step.py", NO_PACKAGES, [*SHAPES, "src/steps/shared.py", "studies/one/deep.py"]),
        ("step.py", FOR_TYPES, []),
        ("step.py", "import numpy as np\nfrom scipy.integrate import quad\n", []),
        ("play.ipynb", CELL, SHAPES),
        ("Snakefile", ALL, SHAPES),
        ("more.smk", "include: 'x'\nimport lib.forces\n", FORCES),
    ],
)
def test_modules_of_the_repository_that_a_file_imports_are_found(tree, name, text, found):
    assert imported_by(tree, text, f"src/steps/{name}") == found


def test_script_that_is_not_there_is_named(tree):
    with pytest.raises(FileNotFoundError, match=r"nosuch\.py"):
        code("src/steps/nosuch.py", root=tree)


SCRIPT = """
import sys
from replication.workflow.code import code, undeclared
sys.path[:0] = ["src", "src/steps", "."]
import shared
print(undeclared(code("src/steps/shared.py")))
print(undeclared(set(code("src/steps/shared.py")) - {"src/steps/shared.py"}))
import studies.one.deep
print(undeclared(code("src/steps/shared.py")))
"""


def test_module_that_was_loaded_and_not_declared_is_found(tree):
    pytest.importorskip("lazy_loader")
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], cwd=tree, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == ["[]", "['src/steps/shared.py']", "['studies/one/deep.py']"]


def test_nothing_of_this_repository_is_undeclared_where_all_is_declared():
    assert "src/replication/workflow/code.py" in undeclared([], root=ROOT)
    everything = [str(path) for path in ROOT.glob("**/*.py")]
    assert undeclared(everything, root=ROOT) == []


SNAKEFILE = """\
from replication.workflow.completion import complete, findings_made

rule all:
    input:
        "results/plain.csv",
        expand("results/{n}_each.json", n=["a", "b"]),

rule plain:
    output:
        "results/plain.csv",
    script:
        "steps/plain.py"

rule each:
    input:
        data="data.txt",
    output:
        findings="results/{n}_each.json",
    wildcard_constraints:
        n="a|b",
    script:
        "steps/{wildcards.n}.py"

rule logged:
    input:
        "steps/plain.py",
    output:
        "results/logged.csv",
    log:
        "own/place.log",
    script:
        "steps/plain.py"
"""


@pytest.fixture
def made(tmp_path, plant, monkeypatch):
    """The job that makes each output, of a small workflow with an ending."""
    monkeypatch.chdir(tmp_path)
    plain = '"""Draw {a} line.\n\nTwice."""\nimport steps.used'
    steps = {"steps/plain.py": plain, **{f"steps/{name}.py": "" for name in ("used", "a", "b")}}
    plant(tmp_path, steps | {"data.txt": "1"})

    def read(ending="\ncomplete(workflow)\n"):
        (tmp_path / "Snakefile").write_text(SNAKEFILE + ending)
        return makers(workflow_jobs(tmp_path, targets=["all", "logged"]))

    return read


def test_script_and_its_modules_are_inputs_and_log_and_benchmark_have_the_name_of_the_rule(made):
    job = made()["results/plain.csv"]
    assert sorted(job.inputs) == ["steps/plain.py", "steps/used.py"]
    assert job.logs == ("results/logs/plain.log", "results/benchmarks/plain.tsv")


def test_script_with_a_wildcard_is_an_input_of_its_own_job(made):
    jobs = made()
    for name in "ab":
        job = jobs[f"results/{name}_each.json"]
        assert job.inputs == ("data.txt", f"steps/{name}.py")
        logs = f"results/logs/each_{name}.log", f"results/benchmarks/each_{name}.tsv"
        assert job.logs == logs


def test_rule_without_a_script_is_refused(made):
    shell = '\nrule shell:\n    output:\n        "out.txt"\n    shell:\n        "touch {output}"\n'
    with pytest.raises((ValueError, WorkflowError), match=r"rule shell makes out\.txt without a s"):
        made(f"{shell}\ncomplete(workflow)\n")


class Output(str):
    """An output of a rule as Snakemake has it: a path that can have wildcards."""

    def match(self, path):
        return re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", self), path)


class Rule:
    def __init__(self, name, inputs=(), output=()):
        self.name, self.input, self.output = name, inputs, [Output(path) for path in output]


CURVE = Rule("curve", ["src/steps/curve.py"], ["results/tables/curve.csv"])


@pytest.mark.parametrize(
    ("inputs", "tables", "told"),
    [
        (["results/tables/curv.csv"], [], r"^rule report reads \S+/curv.csv, which .* 'curve'\?$"),
        (
            ["results/findings/curv.json", "report.typ", "format.typ"],
            [],
            r"^rule report \(report.typ\) reads results/findings/cu",
        ),
        ([], ["ol"], "a figure reads results/tables/ol.csv.* one of curve"),
        (["results/tables/old.csv"], [], "delete ref/old.csv if the workflow no longer"),
    ],
)
def test_result_that_no_rule_makes_is_refused_with_its_reader(
    tmp_path, plant, monkeypatch, inputs, tables, told
):
    texts = {"report.typ": '#let curve = found("curv")', "format.typ": "nothing", "ref/old.csv": ""}
    monkeypatch.chdir(plant(tmp_path, texts))
    with pytest.raises(ValueError, match=told):
        refuse_unmade([CURVE, Rule("report", inputs)], tables, Path("ref"))


CAPTIONS = {"results/tables/curve.csv": {"claims": ["eq_1"]}}


@pytest.mark.parametrize(
    ("captions", "figures", "told"),
    [
        (CAPTIONS, ["figures/curve.svg"], "^figures/curve.svg has no caption; expected one in"),
        ({"figures/old.svg": {"claims": []}}, [], "have figures/old.svg, which no rule makes"),
        ({"results/tables/curve.csv": {"claims": ["eq1"]}}, [], "names 'eq1'; did you mean 'eq_1'"),
    ],
)
def test_captions_and_results_that_do_not_fit_are_refused(captions, figures, told):
    check_captions(CAPTIONS, [], ["eq_1"], made_by([CURVE]))
    with pytest.raises(ValueError, match=told):
        check_captions(captions, figures, ["eq_1"], made_by([CURVE]))


LISTS = {"all", "crate"}  # rules that take everything
READ = {".svg", ".pdf", ".html", ".ipynb", ".gif", ".png", ".jsonl"}
ENDS = {
    "results/summary.txt",
    "results/origins.json",
    "results/costs.csv",
    "results/ro-crate-metadata.json",
}


def unused_outputs(jobs: Iterable[Job]) -> list[str]:
    """The outputs that are no input of another job, not published and not meant for a reader."""
    used = {path for job in jobs if job.rule not in LISTS for path in job.inputs} | ENDS
    editions = (edition_of(path.name, ROOT) for path in (ROOT / "studies").iterdir())
    published = [*publish.TABLES, *publish.SOURCES]
    published += [name for edition in editions for name in edition.tables]
    used |= {f"results/tables/{name}.csv" for name in published}
    made = (path for job in jobs for path in job.outputs if Path(path).suffix not in READ)
    return sorted(path for path in made if path not in used)


def unused_scripts(
    jobs: Iterable[Job], files: Iterable[str], makefile: str, snakefiles: str
) -> list[str]:
    """Those of the files that no job runs or reads, no target of the Makefile runs, none imports.

    A used script may import them, or a Snakefile; these two come as text.
    """
    files = set(files)
    dotted = {path: path.removesuffix(".py").removeprefix("src/") for path in files}
    modules = {name.replace("/", "."): path for path, name in dotted.items()}
    imported = re.findall(r"^from ([\w.]+) import", snakefiles, flags=re.MULTILINE)
    imported += re.findall(r"python -m ([\w.]+)", makefile)
    listed = (job for job in jobs if job.rule not in LISTS)
    waiting = {path for job in listed for path in (*job.scripts, *job.inputs)}
    waiting |= {path for job in jobs for path in job.scripts}
    waiting |= {modules[name] for name in imported if name in modules}
    used: set[str] = set()
    while waiting:
        path = waiting.pop()
        used.add(path)
        if path in files:
            names = set(imports(ROOT / path))
            names |= {name.rpartition(".")[0] for name in names}
            waiting |= {modules[name] for name in names if name in modules} - used
    return sorted(files - used)


def snakefiles(jobs: Iterable[Job]) -> str:
    """The text of all files that have rules."""
    paths = {job.place.rpartition(":")[0] for job in jobs} | {"src/replication/common.smk"}
    return "\n".join((ROOT / path).read_text(encoding="utf-8") for path in paths)


def scripts_beside(jobs: Iterable[Job]) -> list[str]:
    """Every script in the folders that scripts of rules lie in."""
    folders = {Path(script).parent for job in jobs for script in job.scripts}
    machine = (path.relative_to(ROOT) for path in (ROOT / "src" / "replication").rglob("*.py"))
    folders |= {path.parent for path in machine if not OTHER & {*path.parts}}
    found = [path for folder in folders for path in (ROOT / folder).glob("*.py")]
    return [str(path.relative_to(ROOT)) for path in found if path.name != "__init__.py"]


OTHER = {"ci", "template", "tests"}  # of the machine, run by others
MAKEFILES = ("Makefile", "src/replication/make/machine.mk")
MAKEFILE = "".join((ROOT / name).read_text(encoding="utf-8") for name in MAKEFILES)


def test_every_output_is_used_or_reported(jobs):
    assert unused_outputs(jobs) == []


def test_every_script_is_run_or_imported(jobs):
    assert unused_scripts(jobs, scripts_beside(jobs), MAKEFILE, snakefiles(jobs)) == []


def test_every_rule_has_a_job(jobs):
    named = re.findall(r"^(?:rule|checkpoint) (\w+):", snakefiles(jobs), flags=re.MULTILINE)
    assert set(named) - {job.rule for job in jobs} == set()
