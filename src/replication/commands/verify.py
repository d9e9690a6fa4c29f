"""Is the tree what the run left? Every file against its RO-Crate: `make verify`.

In an unpacked archive (`make archive`) the source is held against SHA256SUMS, too.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from replication.origin.recorded import CRATE, Crate, read_crate
from replication.workflow.provenance import checksum

SUMS = "SHA256SUMS"
"""In an archive alone: the checksum of every file in it, as `sha256sum --check` reads them."""


def main(crate: Crate, root: Path = Path()) -> list[str]:
    """Return a line for each file that is missing, that changed, or that no rule made."""
    faults = []
    for path, expected in crate.checksums.items():
        if rule := crate.rules.get(path):
            faults += _fault(path, expected, f"rule {rule} makes it", f"rule {rule} made it", root)
        else:
            faults += _fault(path, expected, "the run read it", "the run", root)
    faults += [f"{path} is extra: no rule made it" for path in sorted(extra(crate, root))]
    return faults


def extra(crate: Crate, root: Path) -> Iterator[str]:
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
        if path.is_file() and not known:
            yield str(name)


def changed_source(crate: Crate, root: Path) -> list[str]:
    """Return a line for each file of an archive that is not as it was packed.

    What a run makes is left to the crate, which a new run in the unpacked archive replaces.
    """
    made = {*crate.rules, *crate.left_out}
    faults = []
    for line in (root / SUMS).read_text(encoding="utf-8").splitlines():
        expected, path = line.split("  ", 1)
        if path not in made:
            faults += _fault(path, expected, f"{SUMS} has it", "it was packed", root)
    return faults


def _fault(path: str, expected: str, source: str, event: str, root: Path) -> list[str]:
    """Return a line when the file is missing or not as it was after the event; else none."""
    if not (root / path).is_file():
        return [f"{path} is missing; {source}"]
    if (found := checksum(root / path)) != expected:
        return [f"{path} changed after {event}: its SHA-256 is {found}; expected {expected}"]
    return []


if __name__ == "__main__":
    if not Path(CRATE).exists():
        sys.exit(f"{CRATE} does not exist; expected a finished run: make reproduce")
    try:
        crate = read_crate()
    except ValueError as fault:
        sys.exit(str(fault))
    is_archive = Path(SUMS).exists()
    faults = [*main(crate), *(changed_source(crate, Path()) if is_archive else [])]
    if faults:
        sys.exit("\n".join(faults))
    inputs = len(crate.checksums) - len(crate.rules)
    print(f"verified: {len(crate.rules)} outputs and {inputs} inputs are as {CRATE} has them")
    if is_archive:
        print(f"verified: the source is as {SUMS} has it")
