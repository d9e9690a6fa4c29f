"""Is the tree what the run left? Every file against its RO-Crate: `make verify`.

In an unpacked archive (`make archive`) every file is first held against SHA256SUMS. Until this
holds, nothing of the folder is imported but this file, so that a file that was added cannot decide:
`python -I -S` starts it, without the folder's packages.
"""

import hashlib
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from replication.origin.recorded import Crate

CRATE = "results/ro-crate-metadata.json"
SUMS = "SHA256SUMS"
"""In an archive alone: the checksum of every file in it, as `sha256sum --check` reads them."""
COPY = Path(CRATE).name
"""In an archive alone, at its root: the RO-Crate as it was packed."""
OF_A_RUN = (CRATE, "results/costs.csv")
"""What each run in an unpacked archive writes anew."""
CACHES = (".mypy_cache", ".pytest_cache", ".ruff_cache", ".snakemake", "__pycache__")
LOCAL = (".git", ".uv", ".venv", "dist", "results/logs", "results/benchmarks", *CACHES)
"""Folders that commands make in a tree."""


def main(crate: "Crate", root: Path = Path()) -> list[str]:
    """Return a line for each file that is missing, that changed, or that no rule made."""
    faults = []
    for path, expected in crate.checksums.items():
        if rule := crate.rules.get(path):
            faults += _fault(path, expected, f"rule {rule} makes it", f"rule {rule} made it", root)
        else:
            faults += _fault(path, expected, "the run read it", "the run", root)
    faults += [
        f"{path} is extra: no rule made it; move it away" for path in sorted(extra(crate, root))
    ]
    return faults


def extra(crate: "Crate", root: Path) -> Iterator[str]:
    """Yield the files that the crate does not know.

    In the workflow's own folders these are all; elsewhere, those that look like its outputs: of
    the same kind and beside them, such as figures/*.svg.
    """
    found = {path for folder in crate.folders for path in (root / folder).rglob("*")}
    for path in map(Path, crate.rules):
        found.update((root / path.parent).glob(f"*{path.suffix}"))
    for path in found:
        name = path.relative_to(root)
        known = str(name) in crate.checksums or any(map(name.is_relative_to, crate.left_out))
        if not known and not _is_folder(path):
            yield str(name)


def packed(root: Path = Path()) -> dict[str, str]:
    """Return the checksum of each file of an archive, by its path; of no archive, nothing.

    Raises
    ------
    ValueError
        When a line of SHA256SUMS is not one of `sha256sum`, or an archive has none.
    """
    if not (root / SUMS).exists() and not (root / COPY).exists():
        return {}
    if not (root / SUMS).exists() or not (root / SUMS).stat().st_size:
        raise ValueError(f"{SUMS} is missing or empty; an archive has one: unpack it again")
    rows = {}
    text = (root / SUMS).read_text(encoding="utf-8", errors="replace")
    for number, line in enumerate(text.splitlines(), 1):
        digest, gap, path = line[:64], line[64:66], line[66:]
        if gap != "  " or not path or set(digest) - set("0123456789abcdef"):
            raise ValueError(
                f"{SUMS}, line {number} is {line[:80]!r}; expected a SHA-256, two blanks and a "
                "path: unpack the archive again"
            )
        rows[path] = digest
    return rows


def unpacked(sums: dict[str, str], root: Path = Path()) -> Iterator[str]:
    """Yield a line for each file of an archive that is not as it was packed, or that was added.

    What a run in the unpacked archive writes anew is no fault, though its results be the same.
    """
    for path, expected in sums.items():
        if path not in OF_A_RUN:
            yield from _fault(path, expected, f"{SUMS} has it", "it was packed", root)
    known = {*sums, SUMS}
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root)
        if path.is_symlink() and not _local(name):
            yield f"{name.as_posix()} is a link, and an archive has none: unpack it again"
        elif not _is_folder(path) and name.as_posix() not in known and not _local(name):
            yield f"{name.as_posix()} was added: {SUMS} does not have it"


def _is_folder(path: Path) -> bool:
    """Return whether a path is a folder of the tree: a link to one may lead out of it."""
    return path.is_dir() and not path.is_symlink()


def _local(name: Path) -> str:
    """Return which folder that commands make has a file; of no such folder, nothing."""
    of_name = (folder for folder in LOCAL if name.is_relative_to(folder))
    return next(of_name, "__pycache__" if "__pycache__" in name.parts else "")


def _fault(path: str, expected: str, source: str, event: str, root: Path) -> list[str]:
    """Return a line when the file is missing or not as it was after the event; else none."""
    if (root / path).is_symlink():
        return [f"{path} is a link; expected the file itself, as {source}"]
    if not (root / path).is_file():
        return [f"{path} is missing; {source}"]
    if (found := _checksum(root / path)) != expected:
        return [f"{path} changed after {event}: its SHA-256 is {found}; expected {expected}"]
    return []


def _checksum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _archive(sums: dict[str, str]) -> None:
    """End with what differs in an archive; say what the checksums cannot tell."""
    faults = list(unpacked(sums))
    for path in OF_A_RUN:
        if path in sums and Path(path).exists() and sums[path] != _checksum(Path(path)):
            print(f"{path} is not the one that was packed: a run was made here, or it was changed")
    if faults:
        sys.exit("\n".join(faults))
    print(f"verified: {len(sums)} files are as {SUMS} has them")
    if there := sorted({*map(_local, filter(Path.is_file, Path().rglob("*")))} - {""}):
        print(f"not packed, made by commands here or added: {', '.join(there)}")
    print(
        f"Who changes a file can make {SUMS} anew. Compare its SHA-256 with that published beside "
        f"the archive:\n{_checksum(Path(SUMS))}"
    )


if __name__ == "__main__":
    try:
        if sums := packed():
            _archive(sums)
        if not Path(CRATE).exists():
            sys.exit(f"{CRATE} does not exist; expected a finished run: make reproduce")
        sys.path.append("src")  # behind the standard library: nothing here replaces it
        sys.pycache_prefix, sys.dont_write_bytecode = os.devnull, True  # no compiled file is read
        from replication.origin.recorded import read_crate

        crate = read_crate(CRATE)
    except ValueError as fault:
        sys.exit(str(fault))
    if faults := main(crate):
        sys.exit("\n".join(faults))
    inputs = len(crate.checksums) - len(crate.rules)
    print(f"verified: {len(crate.rules)} outputs and {inputs} inputs are as {CRATE} has them")
