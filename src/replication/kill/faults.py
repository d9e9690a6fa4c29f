"""Deliberate faults: those of the paper and of each study, and how one is put into a tree."""

import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from replication.inputs.checksums import sha256
from replication.inputs.strict_yaml import read_yaml
from replication.kill.tree_copy import ROOT

FAULTS = ("faults/*.yaml", "tests/faults/*.yaml", "studies/*/faults.yaml")
"""The files of faults: those of the paper, and of each study in its folder."""
JUDGING = "judging"
"""The routes of a fault in the judging itself: its tests run before any verdict is computed."""


@dataclass(frozen=True)
class Change:
    """A text in a file that becomes another."""

    file: str
    old: str
    new: str


@dataclass(frozen=True)
class Fault:
    """What is wrong, which routes share it, and the tests that are asked about it.

    `home` is the file that describes it, as a path in the tree.
    """

    name: str
    fault: str
    routes: str
    tests: tuple[str, ...]
    changes: tuple[Change, ...]
    home: str

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
            moved on, and its description has to follow.
        """
        texts = {file: (tree / file).read_text(encoding="utf-8") for file in self.files}
        for change in self.changes:
            times = texts[change.file].count(change.old)
            if times != 1:
                raise ValueError(
                    f"{self.home}: {self.name}: {change.file} has {times} times "
                    f"{change.old!r}; expected it once"
                )
            texts[change.file] = texts[change.file].replace(change.old, change.new)
        return texts

    def digest(self, tree: Path) -> str:
        """Return a checksum of the fault's own entry, wherever it is, and of the faulty files."""
        entry = {key: part for key, part in asdict(self).items() if key != "home"}
        text = json.dumps([entry, self.texts(tree)], sort_keys=True)
        return sha256(text.encode())


def load(root: Path = ROOT) -> list[Fault]:
    """Return the faults of the paper, then those of each study that is there, by its name."""
    return [
        fault
        for pattern in FAULTS
        for path in sorted(root.glob(pattern))
        for fault in _faults(path, root)
    ]


def _faults(path: Path, root: Path) -> Iterator[Fault]:
    """Yield the faults of a file; a change that names no file is in that of the change before."""
    file: dict[str, str] = {}
    for entry in read_yaml(path):
        only = {part: entry.pop(part) for part in ("file", "old", "new") if part in entry}
        changes = []
        for change in entry.pop("changes", [only]):
            changes.append(Change(**file | change))
            file = {"file": changes[-1].file}
        if "tests" not in entry:
            files = dict.fromkeys(change.file for change in changes)
            entry["tests"] = [test for each in files for test in _own_tests(each, root)]
        tests = tuple(dict.fromkeys(entry.pop("tests")))
        home = path.relative_to(root).as_posix()
        yield Fault(**{"routes": JUDGING} | entry, tests=tests, changes=tuple(changes), home=home)


def _own_tests(file: str, root: Path) -> list[str]:
    """Return the tests of a module: those of its name, or those of its room that import it."""
    *folders, name = Path(file).parts
    packages = [("tests", *folders[1:]), ("tests", *folders[2:])]
    if folders[0] == "studies":
        packages = [(*folders[:2], "tests")]
    rooms = [root.joinpath(*package) for package in packages]
    named = [room / f"test_{name}" for room in rooms if (room / f"test_{name}").is_file()]
    word = re.compile(rf"\b{Path(name).stem}\b")
    near = (path for room in rooms for path in sorted(room.glob("test_*.py")))
    found = named[:1] or [path for path in near if word.search(_head(path))]
    return [path.relative_to(root).as_posix() for path in found]


def _head(path: Path) -> str:
    """Return what stands before the first function: the imports."""
    return re.split(r"^(?:def|class|@)", path.read_text("utf-8"), maxsplit=1, flags=re.MULTILINE)[0]


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
