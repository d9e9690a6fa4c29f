"""Is the tree what the run left? Every file against results/manifest.json: `make verify`.

In an unpacked archive (`make archive`) the source is held against SHA256SUMS, too.
"""

import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from replication.provenance import checksum

MANIFEST = "results/manifest.json"
SUMS = "SHA256SUMS"
"""In an archive alone: the checksum of every file in it, as `sha256sum --check` reads them."""


def main(manifest: Mapping[str, Any], root: Path = Path()) -> list[str]:
    """Return a line for each file that is missing, that changed, or that no rule made."""
    faults = []
    for path, entry in manifest["outputs"].items():
        makes = f"rule {entry['rule']}"
        faults += _fault(path, entry["sha256"], f"{makes} makes it", f"{makes} made it", root)
    faults += [f"{path} is extra: no rule made it" for path in sorted(extra(manifest, root))]
    return faults


def extra(manifest: Mapping[str, Any], root: Path) -> Iterator[str]:
    """Yield the files that the manifest does not know.

    In the workflow's own folders these are all; elsewhere, those that look like its outputs: of
    the same kind and beside them, such as figures/*.svg.
    """
    left_out = [Path(path) for path in manifest["left_out"]]
    found = {path for folder in manifest["folders"] for path in (root / folder).rglob("*")}
    for path in map(Path, manifest["outputs"]):
        found.update((root / path.parent).glob(f"*{path.suffix}"))
    for path in found:
        name = path.relative_to(root)
        known = str(name) in manifest["outputs"]
        if path.is_file() and not known and not any(name.is_relative_to(out) for out in left_out):
            yield str(name)


def changed_source(manifest: Mapping[str, Any], root: Path) -> list[str]:
    """Return a line for each file of an archive that is not as it was packed.

    What a run makes is left to the manifest, which a new run in the unpacked archive replaces.
    """
    made = {*manifest["outputs"], *manifest["left_out"]}
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
    if not Path(MANIFEST).exists():
        sys.exit(f"{MANIFEST} does not exist; expected a finished run: make reproduce")
    manifest = json.loads(Path(MANIFEST).read_text(encoding="utf-8"))
    is_archive = Path(SUMS).exists()
    faults = [*main(manifest), *(changed_source(manifest, Path()) if is_archive else [])]
    if faults:
        sys.exit("\n".join(faults))
    print(f"verified: {len(manifest['outputs'])} files are as {MANIFEST} has them")
    if is_archive:
        print(f"verified: the source is as {SUMS} has it")
