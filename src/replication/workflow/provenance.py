"""The jobs of the workflow, and the version of its source."""

import os
import pickle
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from replication.inputs.strict_yaml import read_yaml
from replication.workflow.internals import planned, script_of

ALL_TRIGGERS = ["mtime", "input", "params", "code", "software-env"]
"""What makes a run repeat a job, where the default profile says nothing else."""

NOTES, NOTED = Path(".snakemake/jobs.pickle"), "JOBS_OF_THE_RUN"
"""Where a run notes its jobs, and the variable by which its jobs know of it."""


@dataclass(frozen=True)
class Job:
    """One job of the workflow: a rule with its wildcards filled in. Paths are from the root."""

    rule: str
    place: str = ""  # file and line of the rule
    scripts: tuple[str, ...] = ()  # one, or none
    inputs: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    logs: tuple[str, ...] = ()  # with the benchmark
    findings: tuple[str, ...] = ()  # outputs that contain findings
    params: Mapping[str, Any] = field(default_factory=dict)  # numbers from the config
    pending: bool = False  # whether Snakemake would run it now


def workflow_jobs(
    root: str | Path = ".",
    config: Mapping[str, Any] | None = None,
    targets: Iterable[str] | None = None,
) -> list[Job]:
    """Return every job that the targets need, from the Snakefile; nothing is run.

    The entries of `config` replace those of the config file. Targets are rules or files; by default
    every rule that can be requested by name.
    """
    profile = Path(root, "profiles", "default", "config.yaml")
    known = read_yaml(profile) if profile.is_file() else {}
    triggers = known.get("rerun-triggers", ALL_TRIGGERS)
    with planned(Path(root), config or {}, targets, triggers) as workflow:
        return [_job(job, workflow) for job in workflow.dag.jobs]


def note_jobs(workflow: Any) -> None:
    """Note the jobs of a run that begins, for those of its jobs that ask `noted_jobs`."""
    jobs = [replace(_job(job, workflow), params={}) for job in workflow.dag.jobs]
    NOTES.write_bytes(pickle.dumps(jobs))
    os.environ[NOTED] = str(NOTES.resolve())


def noted_jobs() -> list[Job]:
    """Return the jobs of the run that this process is part of; none if it noted none."""
    path = os.environ.get(NOTED)
    return pickle.loads(Path(path).read_bytes()) if path else []


def makers(jobs: Iterable[Job]) -> dict[str, Job]:
    """Return, for each output, the job that makes it."""
    return {path: job for job in jobs for path in job.outputs}


def source_version(folder: str | Path = ".") -> str:
    """Return the commit, with "-dirty" behind it where the tree differs; "" without a repository.

    A repository further up, into which a source archive was unpacked, is not this one.
    """

    def git(*words: str) -> str:
        command = ["git", "-C", str(folder), *words]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    try:
        if Path(git("rev-parse", "--show-toplevel")).resolve() != Path(folder).resolve():
            return ""
        return git("rev-parse", "HEAD") + ("-dirty" if git("status", "--porcelain") else "")
    except (OSError, subprocess.CalledProcessError):
        return ""


def _job(job: Any, workflow: Any) -> Job:
    rule = job.rule
    snakefile = str(rule.snakefile)
    line = workflow.linemaps[snakefile][rule.lineno]
    scripts = ()
    if rule.script or rule.notebook:
        script = job.format_wildcards(rule.script or rule.notebook)
        scripts = (_relative(script_of(rule, script)),)
    return Job(
        rule=rule.name,
        place=f"{_relative(snakefile)}:{line}",
        scripts=scripts,
        inputs=tuple(map(str, job.input)),
        outputs=tuple(map(str, job.output)),
        logs=tuple(map(str, [*job.log, *([job.benchmark] if job.benchmark else [])])),
        findings=tuple(str(path) for name, path in job.output.items() if name == "findings"),
        params=dict(job.params.items()),
        pending=bool(workflow.dag.needrun(job)),
    )


def _relative(path: str) -> str:
    return os.path.relpath(path.removeprefix("file://"))
