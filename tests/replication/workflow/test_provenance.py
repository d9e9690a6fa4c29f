"""What Snakemake knows of a workflow, on a small one that is run."""

import subprocess
import sys
from dataclasses import replace

import pytest

from replication.workflow import provenance
from replication.workflow.internals import planned
from replication.workflow.provenance import (
    makers,
    note_jobs,
    noted_jobs,
    source_version,
    workflow_jobs,
)

SNAKEFILE = """\
configfile: "config.yaml"

rule all:
    input:
        "out/sum.txt",

rule copy:
    input:
        "in/{name}.txt",
    output:
        "out/{name}.copy",
    log:
        "logs/{name}.log",
    script:
        "scripts/{wildcards.name}.py"

rule sum:
    input:
        "out/a.copy",
    output:
        findings="out/sum.txt",
    params:
        factor=config["factor"],
    shell:
        "cat {input} > {output}"
"""


@pytest.fixture(scope="module")
def tree(tmp_path_factory, plant):
    """The small workflow, run once."""
    copy = "import shutil\nshutil.copyfile(snakemake.input[0], snakemake.output[0])\n"
    files = {"Snakefile": SNAKEFILE, "config.yaml": "factor: 2\n", "in/a.txt": "1\n"}
    root = plant(tmp_path_factory.mktemp("workflow"), files | {"scripts/a.py": copy})
    before = workflow_jobs(root)
    command = [sys.executable, "-m", "snakemake", "--cores=1", "--scheduler=greedy", "--quiet=all"]
    subprocess.run(command, cwd=root, check=True, capture_output=True)
    return root, before


def test_jobs_are_known_before_they_ran(tree, monkeypatch, tmp_path):
    root, before = tree
    assert {job.rule for job in before} == {"all", "copy", "sum"}
    assert all(job.pending for job in before)
    monkeypatch.chdir(tmp_path)
    workflow_jobs(root)
    assert list(tmp_path.iterdir()) == []
    assert tmp_path.cwd() == tmp_path


def test_run_notes_its_jobs(tree, monkeypatch):
    root, before = tree
    monkeypatch.chdir(root)
    monkeypatch.setenv(provenance.NOTED, "")
    assert noted_jobs() == []
    with planned(root, {}, None, ["input"]) as workflow:
        note_jobs(workflow)
    expected = {job.outputs: replace(job, params={}, pending=False) for job in before}
    assert {job.outputs: replace(job, pending=False) for job in noted_jobs()} == expected


def test_config_can_be_replaced_and_job_is_pending_by_the_triggers_of_the_profile(tree, plant):
    root, _ = tree
    profile = "profiles/default/config.yaml"
    for triggers, pending in ((["mtime", "input"], False), (["mtime", "params"], True), ([], True)):
        plant(root, {profile: f"rerun-triggers: {triggers}\n" if triggers else "cores: 1"})
        total = makers(workflow_jobs(root, config={"factor": 3}))["out/sum.txt"]
        assert (total.params, total.pending) == ({"factor": 3}, pending)
    (root / profile).unlink()


def test_version_is_the_commit_and_whether_the_tree_differs(tmp_path):
    def git(*words):
        who = ["-c", "user.name=x", "-c", "user.email=x@x.org", "-c", "commit.gpgsign=false"]
        command = ["git", "-C", tmp_path, *who, *words]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    assert source_version(tmp_path) == ""
    git("init", "-q")
    (tmp_path / "archive").mkdir()
    assert source_version(tmp_path / "archive") == ""  # another repository is above it
    (tmp_path / "file").write_text("1")
    git("add", "file")
    git("commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert source_version(tmp_path) == commit
    (tmp_path / "file").write_text("2")
    assert source_version(tmp_path) == f"{commit}-dirty"
