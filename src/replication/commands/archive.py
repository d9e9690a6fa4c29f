"""One .zip with the source, the lock and all that a finished run made: `make archive`.

The bytes depend on the commit and the run alone. The archive is unpacked into an empty folder,
where `make verify` holds its files against the RO-Crate of the run and SHA256SUMS. A copy of this
crate lies at its root: the whole archive is an RO-Crate.
"""

import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

from replication.commands.verify import SUMS
from replication.commands.verify import main as verify
from replication.inputs.checksums import sha256
from replication.origin.recorded import CRATE, read_crate
from replication.pages import blanks
from replication.workflow.provenance import source_version, workflow_jobs

FOLDER = Path("dist")
COSTS = "results/costs.csv"
"""What a run measures; the crate has no checksum of it."""

EARLIEST = (1980, 1, 1, 0, 0, 0)
"""The time of every file: zip knows none before it."""


def pending(root: Path) -> list[str]:
    """Return the rules that `make reproduce` would run now."""
    jobs = workflow_jobs(root, targets=["all"])
    return sorted({job.rule for job in jobs if job.pending and job.outputs})


def refusal(root: Path) -> str:
    """Return why a tree cannot be archived, and what to do; "" if it can."""
    if not (root / CRATE).exists():
        return f"{CRATE} does not exist; expected a finished run: make reproduce"
    if not (now := source_version(root)):
        return f"{root.resolve()} is no git repository; expected a clone, whose commit is archived"
    if now.endswith("-dirty"):
        return "the tree differs from its commit (git status); commit or remove these changes"
    if rules := pending(root):
        return f"the run is not finished or out of date, in {', '.join(rules)}: make reproduce"
    try:
        crate = read_crate(root / CRATE)
    except ValueError as fault:
        return str(fault)
    if faults := verify(crate, root):
        left = "expected the files of the run: remove those above, then make reproduce"
        return "\n".join([*faults, left])
    if crate.version != now:
        renew(root)
    return ""


def renew(root: Path) -> None:
    """Write the crate anew, which names an earlier commit: of a run that is up to date."""
    (root / CRATE).unlink()
    command = [sys.executable, "-m", "snakemake", "--cores", "1", "--quiet", "all", "--", CRATE]
    subprocess.run(command, cwd=root, check=True, env=os.environ | {"PYTHONPATH": "src:."})


def members(root: Path) -> dict[str, bytes]:
    """Return the content of every file of the archive, by its path: source, then results."""
    listed = _git(root, "ls-files", "-z").decode().split("\0")
    made = [*read_crate(root / CRATE).rules, CRATE, COSTS]
    found = {path: (root / path).read_bytes() for path in sorted({*filter(None, listed), *made})}
    found[Path(CRATE).name] = found[CRATE]
    sums = (f"{sha256(data)}  {path}\n" for path, data in found.items())
    return found | {SUMS: "".join(sums).encode()}


def write(root: Path, to: Path) -> None:
    """Write the archive of a tree that has no `refusal`."""
    entries = _git(root, "ls-files", "-z", "--stage").decode().split("\0")
    executable = {entry.split("\t")[1] for entry in entries if entry.startswith("100755")}
    to.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(to, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for path, data in sorted(members(root).items()):
            info = zipfile.ZipInfo(path, EARLIEST)
            info.create_system = 3  # Unix, whose permissions follow
            info.external_attr = (0o100755 if path in executable else 0o100644) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)


def name_of(root: Path) -> str:
    """Return the name of the archive: project and version."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return f"{project['name']}-{project['version']}.zip"


def main(root: Path = Path()) -> str:
    """Write the archive, and return a line with its name, size and checksum.

    Raises
    ------
    SystemExit
        When the tree has no finished run, or files that differ from it or from the commit.
    """
    if reason := refusal(root):
        sys.exit(reason)
    blanks.main(root)
    to = root / FOLDER / name_of(root)
    write(root, to)
    data = to.read_bytes()
    count = len(zipfile.ZipFile(to).namelist())
    checksum, sums = sha256(data), sha256(zipfile.ZipFile(to).read(SUMS))
    return (
        f"{to}: {count} files, {len(data) / 1e6:.1f} MB, SHA-256 {checksum}\n"
        f"publish this beside it, which make verify prints of an unpacked one: {SUMS} {sums}"
    )


def _git(root: Path, *words: str) -> bytes:
    return subprocess.run(["git", "-C", str(root), *words], capture_output=True, check=True).stdout


if __name__ == "__main__":
    print(main())
