"""Deliberate faults: what faults.yaml says of each, and how one is put into a tree."""

import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from replication.strict_yaml import read_yaml
from replication.tree_copy import ROOT

FAULTS = ROOT / "faults" / "faults.yaml"
JUDGING = "judging"
"""The routes of a fault that is in the judging: what its tests are asked before any verdict."""


@dataclass(frozen=True)
class Change:
    """A text in a file that becomes another."""

    file: str
    old: str
    new: str


@dataclass(frozen=True)
class Fault:
    """What is wrong, which routes share it, and the tests that are asked about it."""

    name: str
    fault: str
    routes: str
    tests: tuple[str, ...]
    changes: tuple[Change, ...]

    @property
    def files(self) -> list[str]:
        """The files that it changes, each once."""
        return list(dict.fromkeys(change.file for change in self.changes))

    def texts(self, tree: Path) -> dict[str, str]:
        """Return the faulty text of each file of a tree.

        Raises
        ------
        ValueError
            Naming the fault and the file, if an old text is not there exactly once: the library has
            moved on, and faults.yaml has to follow.
        """
        texts = {file: (tree / file).read_text(encoding="utf-8") for file in self.files}
        for change in self.changes:
            times = texts[change.file].count(change.old)
            if times != 1:
                raise ValueError(
                    f"faults/faults.yaml: {self.name}: {change.file} has {times} times "
                    f"{change.old!r}; expected it once"
                )
            texts[change.file] = texts[change.file].replace(change.old, change.new)
        return texts

    def digest(self, tree: Path) -> str:
        """Return a checksum of the fault's own entry and of the faulty files."""
        text = json.dumps([asdict(self), self.texts(tree)], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()


def load(root: Path = ROOT) -> list[Fault]:
    """Return the faults of faults.yaml, but for those in a study that was removed."""
    found = []
    for entry in read_yaml(FAULTS):
        changes = tuple(Change(**change) for change in entry["changes"])
        tests = tuple(test for test in entry["tests"] if not _in_removed_study(test, root))
        if tests and not any(_in_removed_study(change.file, root) for change in changes):
            found.append(Fault(**entry | {"tests": tests, "changes": changes}))
    return found


def _in_removed_study(file: str, root: Path) -> bool:
    folder, *inner = Path(file).parts
    return folder == "studies" and not (root / folder / inner[0]).is_dir()


@contextmanager
def faulty(tree: Path, fault: Fault) -> Iterator[None]:
    """Put a fault into the tree, and take it out again as if it had never been there."""
    kept = {file: ((tree / file).read_bytes(), (tree / file).stat()) for file in fault.files}
    for file, text in fault.texts(tree).items():
        (tree / file).write_text(text, encoding="utf-8")
    try:
        yield
    finally:
        for file, (content, stat) in kept.items():
            (tree / file).write_bytes(content)
            os.utime(tree / file, ns=(stat.st_atime_ns, stat.st_mtime_ns))
