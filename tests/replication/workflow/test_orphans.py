"""Nothing lies about: each script is run, each output is used, by Snakemake's own reading."""

import re
from collections.abc import Iterable
from pathlib import Path

from replication.inputs.parts import edition_of
from replication.tests.test_house import imports
from replication.workflow.provenance import Job
from steps import publish

ROOT = Path(__file__).parents[3]


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
