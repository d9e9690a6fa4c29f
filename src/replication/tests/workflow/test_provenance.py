"""What Snakemake knows of a workflow, on a small one that is run."""

import hashlib
import subprocess
import sys

import pytest

from replication.workflow.provenance import checksum, makers, source_version, workflow_jobs

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
def tree(tmp_path_factory):
    """The small workflow, run once."""
    root = tmp_path_factory.mktemp("workflow")
    for folder in ("in", "scripts"):
        (root / folder).mkdir()
    (root / "Snakefile").write_text(SNAKEFILE)
    (root / "config.yaml").write_text("factor: 2\n")
    (root / "in" / "a.txt").write_text("1\n")
    (root / "scripts" / "a.py").write_text(
        "import shutil\nshutil.copyfile(snakemake.input[0], snakemake.output[0])\n"
    )
    before = workflow_jobs(root)
    command = [sys.executable, "-m", "snakemake", "--cores=1", "--scheduler=greedy", "--quiet=all"]
    subprocess.run(command, cwd=root, check=True, capture_output=True)
    return root, before


def test_jobs_are_known_before_they_ran(tree):
    _, before = tree
    assert {job.rule for job in before} == {"all", "copy", "sum"}
    assert [job.made for job in before] == [None] * 3
    assert all(job.pending for job in before)


def test_job_has_its_wildcards_filled_in_and_its_place(tree):
    root, _ = tree
    copy = makers(workflow_jobs(root))["out/a.copy"]
    line = SNAKEFILE.splitlines().index("rule copy:") + 1
    assert (copy.rule, copy.inputs, copy.logs) == ("copy", ("in/a.txt",), ("logs/a.log",))
    assert copy.scripts == ("scripts/a.py",)
    assert copy.place == f"Snakefile:{line}"


def test_params_and_findings_are_told(tree):
    root, _ = tree
    total = makers(workflow_jobs(root))["out/sum.txt"]
    assert total.params == {"factor": 2}
    assert total.findings == ("out/sum.txt",)


def test_config_can_be_replaced(tree):
    root, _ = tree
    total = makers(workflow_jobs(root, config={"factor": 3}))["out/sum.txt"]
    assert total.params == {"factor": 3}
    assert total.pending


def test_job_is_pending_by_the_triggers_of_the_profile(tree):
    root, _ = tree
    profile = root / "profiles" / "default" / "config.yaml"
    profile.parent.mkdir(parents=True)
    for triggers, pending in (("[mtime, input]", False), ("[mtime, input, params]", True)):
        profile.write_text(f"rerun-triggers: {triggers}\n")
        assert makers(workflow_jobs(root, config={"factor": 3}))["out/sum.txt"].pending == pending
    profile.unlink()


def test_record_of_the_run_has_what_the_inputs_were(tree):
    root, _ = tree
    copy = makers(workflow_jobs(root))["out/a.copy"]
    assert copy.made is not None
    assert not copy.pending
    assert copy.checksums == {"in/a.txt": hashlib.sha256(b"1\n").hexdigest()}
    (root / "in" / "a.txt").write_text("2\n")
    try:
        copy = makers(workflow_jobs(root))["out/a.copy"]
        assert copy.pending
        assert copy.checksums["in/a.txt"] != checksum(root / "in" / "a.txt")
    finally:
        (root / "in" / "a.txt").write_text("1\n")


def test_source_without_git_has_no_version(tmp_path):
    assert source_version(tmp_path) == ""


def test_source_inside_another_repository_has_no_version(tmp_path):
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    inside = tmp_path / "archive"
    inside.mkdir()
    assert source_version(inside) == ""


def test_version_is_the_commit_and_whether_the_tree_differs(tmp_path):
    def git(*words):
        who = ["-c", "user.name=x", "-c", "user.email=x@x.org", "-c", "commit.gpgsign=false"]
        command = ["git", "-C", tmp_path, *who, *words]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    git("init", "-q")
    (tmp_path / "file").write_text("1")
    git("add", "file")
    git("commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert source_version(tmp_path) == commit
    (tmp_path / "file").write_text("2")
    assert source_version(tmp_path) == f"{commit}-dirty"


def test_folder_is_left_as_it_was(tree, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    workflow_jobs(tree[0])
    assert list(tmp_path.iterdir()) == []
    assert tmp_path.cwd() == tmp_path
