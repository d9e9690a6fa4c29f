"""What the manifest says of a run."""

import hashlib
import subprocess
from dataclasses import replace

import pytest

from replication.provenance import Job
from replication.rules import manifest
from replication.rules.manifest import environment, git_state, own_folders

JOB = Job("peaks", "Snakefile:1", (), (), (), (), (), {}, None, {}, False)


@pytest.fixture
def run(tmp_path, monkeypatch):
    """A step that makes a table, and a figure drawn from it."""
    monkeypatch.chdir(tmp_path)
    texts = {"results/peaks.csv": "1\n", "results/costs.csv": "2\n", "figures/peaks.svg": "3\n"}
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "uv.lock").write_text("lock")
    step = replace(
        JOB,
        scripts=("src/peaks.py",),
        outputs=("results/peaks.csv", "results/costs.csv"),
        logs=("results/logs/peaks.log",),
    )
    figure = replace(
        JOB,
        rule="figure",
        scripts=("figures/peaks.py",),
        inputs=("results/peaks.csv",),
        outputs=("figures/peaks.svg",),
    )
    return [step, figure]


def sha256(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def test_every_output_has_checksum_and_rule_but_what_differs_each_run(run):
    found = manifest.main(run, ["results/costs.csv"], ["uv.lock"])
    assert found["outputs"] == {
        "figures/peaks.svg": {"sha256": sha256("3\n"), "rule": "figure"},
        "results/peaks.csv": {"sha256": sha256("1\n"), "rule": "peaks"},
    }
    assert found["left_out"] == ["results/costs.csv", "results/logs", "results/manifest.json"]
    assert found["sources"] == {"uv.lock": sha256("lock")}


def test_folder_with_sources_in_it_is_not_the_workflows_own(run):
    assert own_folders(run) == ["results"]


def test_every_output_of_the_workflow_but_the_costs_is_listed(jobs, monkeypatch):
    monkeypatch.setattr(manifest, "checksum", lambda path: "")
    monkeypatch.setattr(manifest, "git_state", dict)
    listed = manifest.main(jobs, ["results/costs.csv"], [])
    made = {path for job in jobs for path in job.outputs}
    assert made - set(listed["outputs"]) == {"results/costs.csv", "results/manifest.json"}
    assert "paper/report.pdf" in listed["outputs"]
    assert listed["folders"] == ["results"]


def test_archive_without_git_has_no_commit(tmp_path):
    assert git_state(tmp_path) == {"commit": None, "dirty": None}


def test_archive_inside_another_repository_has_no_commit(tmp_path):
    subprocess.run(["git", "init", "-q", tmp_path], check=True)
    inside = tmp_path / "archive"
    inside.mkdir()
    assert git_state(inside) == {"commit": None, "dirty": None}


def test_commit_is_told_and_whether_the_tree_differs(tmp_path):
    def git(*words):
        who = ["-c", "user.name=x", "-c", "user.email=x@x.org", "-c", "commit.gpgsign=false"]
        command = ["git", "-C", tmp_path, *who, *words]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()

    git("init", "-q")
    (tmp_path / "file").write_text("1")
    git("add", "file")
    git("commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert git_state(tmp_path) == {"commit": commit, "dirty": False}
    (tmp_path / "file").write_text("2")
    assert git_state(tmp_path) == {"commit": commit, "dirty": True}


def test_versions_of_the_packages_that_compute_are_told():
    found = environment()
    assert {"numpy", "scipy", "numba", "snakemake", "topheavy"} <= set(found["packages"])
    assert found["python"].startswith("3.")
    assert found["platform"]
