"""What a run made: every output with its checksum and rule, and what it was made from and with."""

import json
import platform
import subprocess
from collections.abc import Collection, Iterable
from importlib import metadata
from pathlib import Path
from typing import Any

from replication.provenance import Job, checksum, workflow_jobs
from replication.workbench import run

MANIFEST = "results/manifest.json"


def outputs(jobs: Iterable[Job], left_out: Collection[str]) -> dict[str, dict[str, str]]:
    """Return checksum and rule of every output, by its path."""
    return {
        path: {"sha256": checksum(path), "rule": job.rule}
        for path, job in sorted((path, job) for job in jobs for path in job.outputs)
        if path not in left_out
    }


def own_folders(jobs: Collection[Job]) -> list[str]:
    """Return the top folders in which nothing lies but what the workflow wrote."""
    made = {path for job in jobs for path in job.outputs}
    given = {path for job in jobs for path in (*job.inputs, *job.scripts)} - made
    return sorted({Path(path).parts[0] for path in made} - {Path(path).parts[0] for path in given})


def git_state(folder: str | Path = ".") -> dict[str, Any]:
    """Return the commit, and whether the tree differs from it; null where there is no repository.

    A repository further up, into which a source archive was unpacked, is not this one.
    """

    def git(*words: str) -> str:
        command = ["git", "-C", str(folder), *words]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()

    try:
        if Path(git("rev-parse", "--show-toplevel")).resolve() != Path(folder).resolve():
            return {"commit": None, "dirty": None}
        return {"commit": git("rev-parse", "HEAD"), "dirty": bool(git("status", "--porcelain"))}
    except (OSError, subprocess.CalledProcessError):
        return {"commit": None, "dirty": None}


def environment() -> dict[str, Any]:
    """Return Python, the platform, and the version of every package that is installed."""
    packages = {found.name: found.version for found in metadata.distributions()}
    return {
        "python": platform.python_version(),
        "platform": platform.platform(),
        "packages": dict(sorted(packages.items(), key=lambda item: item[0].lower())),
    }


def main(jobs: Collection[Job], differs_each_run: Iterable[str], sources: Iterable[str]) -> dict:
    left_out = {MANIFEST, *differs_each_run}
    logs = {str(Path(path).parent) for job in jobs for path in job.logs}
    return {
        "git": git_state(),
        "sources": {path: checksum(path) for path in sources},
        "environment": environment(),
        "folders": own_folders(jobs),
        "left_out": sorted(left_out | logs),
        "outputs": outputs(jobs, left_out),
    }


def work(job: Any) -> None:
    manifest = main(
        workflow_jobs(config=job.config, targets=["all"]),
        job.params.differs_each_run,
        [job.input.configuration, job.input.lock],
    )
    print(f"{len(manifest['outputs'])} outputs")
    text = json.dumps(manifest, indent=1, ensure_ascii=False)
    Path(job.output[0]).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
