"""What depends on what: read off the parsed workflow, and off dry runs of a copy."""

import os
import re
from pathlib import Path

import pytest
from snakemake.api import SnakemakeApi
from snakemake.settings.enums import Quietness
from snakemake.settings.types import OutputSettings, ResourceSettings

from replication.commands.new_study import SKELETON
from replication.kill.tree_copy import copy_tree
from replication.workflow.code import code
from tests.replication.begun import Run

ROOT = Path(__file__).parents[3]


LAST = {"all", "crate"}  # rules that take everything


def is_notebook(path):
    return path.startswith("notebooks/")


def test_everything_that_a_run_makes_or_reads_is_asked_for(jobs):
    asked = next(set(job.inputs) for job in jobs if job.rule == "all")
    run = [job for job in jobs if not job.rule.startswith("claim_")]
    read = {path for job in run if job.rule not in LAST for path in job.inputs}
    assert read | {path for job in run for path in job.outputs} <= asked


def test_every_module_is_an_input_of_each_job_whose_script_imports_it(jobs):
    gaps = {
        (job.rule, path)
        for job in jobs
        for script in (*job.scripts, *filter(is_notebook, job.inputs))
        if job.rule not in LAST
        for path in set(code(script, root=ROOT)) - set(job.inputs)
    }
    assert gaps == set()


STUDIES = {path.parent.name for path in ROOT.glob("studies/*/study.smk")} - {SKELETON}


def test_only_shards_leave_the_machine_that_runs_snakemake():
    with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
        workflow = api.workflow(
            resource_settings=ResourceSettings(cores=1), snakefile=ROOT / "Snakefile", workdir=ROOT
        )._workflow
        rules = {rule.name for rule in workflow.rules if not rule.norun}
        sent = rules - workflow._localrules
    assert "spectra_shard" in sent
    assert sent == {rule for rule in rules if rule.endswith("_shard")}


def snakemake(root, *options):
    env = os.environ | {"PYTHONPATH": str(root / "src")}
    status, said = Run(root, "--cores=1", "--scheduler=greedy", *options, env=env).communicate()
    assert status == 0, said
    return said


@pytest.fixture(scope="module")
def finished(jobs, tmp_path_factory):
    """A copy of the tree in which every output is there, and made, as Snakemake knows it."""
    root = tmp_path_factory.mktemp("finished")
    copy_tree(root)
    for job in jobs:
        for path in job.outputs:
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).touch()
    snakemake(root, "--touch", "--forceall", "--quiet", "all")
    return root


def rerun(root, path, old="", new=None):
    """Return the rules that a dry run would run after a change of a file, and take it back."""
    before, times = (root / path).read_text(encoding="utf-8"), (root / path).stat()
    assert old in before
    changed = before + "\n" if new is None else before.replace(old, new, 1)
    (root / path).write_text(changed, encoding="utf-8")
    try:
        stats = snakemake(root, "--dry-run", "--quiet", "rules").partition("Reasons")[0]
        return set(re.findall(r"^(\w+) +\d+$", stats, flags=re.MULTILINE)) - {"total"}
    finally:
        (root / path).write_text(before, encoding="utf-8")
        os.utime(root / path, ns=(times.st_atime_ns, times.st_mtime_ns))


JUDGED = {"claims", "verdict", "costs", "report", "supplement"}


def test_touched_files_whose_bytes_are_the_same_rerun_nothing(finished):
    """As after a checkout or a copy: all is newer than the results."""
    times = {path: path.stat() for path in finished.rglob("*") if is_source(path, finished)}
    assert len(times) > 500
    for path in times:
        path.touch()
    try:
        assert "Nothing to be done" in snakemake(finished, "--dry-run")
    finally:
        for path, stat in times.items():
            os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))


def is_source(path, root):
    """Whether a file is no result of the workflow, nor one of Snakemake's own."""
    place = path.relative_to(root)
    made = place.parts[0] in (".snakemake", "results") or path.suffix in (".svg", ".pdf")
    return path.is_file() and not made


SOME = sorted(STUDIES)[:1]  # one is enough: all are included in the same way


def of_study(rule):
    return rule.startswith(tuple(f"{study}_" for study in STUDIES))


@pytest.mark.parametrize(
    ("path", "rules"),
    [
        *((f"studies/{study}/section.typ", {"report", "supplement"}) for study in SOME),
        *((f"studies/{study}/config.yaml", None) for study in SOME),  # its readers may differ
        (
            "src/topheavy/second/three_bodies.py",
            {"compare", "figure", "statements", "uplift_limits", *JUDGED},
        ),
    ],
)
def test_change_of_a_module_reruns_its_users_and_nothing_else(finished, jobs, path, rules):
    found = rerun(finished, path) - LAST
    users = {job.rule for job in jobs if path in job.inputs} - LAST
    if rules is None:
        rules = {rule for rule in users if not of_study(rule)}
    assert {rule for rule in found if not of_study(rule)} == rules
    assert set(filter(of_study, found)) == set(filter(of_study, users))


def test_changed_structure_reruns_what_names_it(finished):
    path = "config/config.yaml"
    text = (finished / path).read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if line.startswith("  bridge:"))
    found = rerun(finished, path, line, line.replace("0.75", "0.85"))
    assert "spectra_dimensional" in found
    assert not {"mass_ratio", "trilith", "heavier", "spectra_shard"} & found


OF_NO_JOB = {
    "src/topheavy/outcomes/record_map.py": "for users; the page draws its own map of a record",
}


def test_every_module_of_library_and_studies_is_the_input_of_some_job(jobs):
    if gone := {path.stem for path in ROOT.glob("tests/reference/studies/*.yaml")} - STUDIES:
        pytest.skip(f"{', '.join(sorted(gone))} left, and with it what it alone used")
    used = {path for job in jobs for path in (*job.inputs, *job.scripts)}
    modules = {
        str(path.relative_to(ROOT))
        for pattern in ("src/topheavy/**/*.py", "studies/*/*.py", "studies/*/steps/*.py")
        for path in ROOT.glob(pattern)
        if not path.name.startswith("__") and "skeleton" not in path.relative_to(ROOT).parts
        if path.name != "headlines.py"  # make check reads it
    }
    assert modules - used == set(OF_NO_JOB)
