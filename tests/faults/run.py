"""Deliberate errors of physics: each has to fail a test. `tests/faults/run.py [-j N] [name ...]`.

faults.yaml has, for each, why it is wrong, the file, its text and what that becomes (`old` is there
once, or `count` times), and the tests that are asked. They are asked in a copy of the tree at HEAD:
all of them without any fault, which have to pass, then those of each fault. A test that fails has
caught it. Tests that cannot be collected, or that do not end, have not.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[2]
FAULTS = ROOT / "tests" / "faults" / "faults.yaml"
LIMIT = 300.0  # s, of the tests of one fault
Entry = dict[str, Any]
Outcome = tuple[str, str]  # caught, survived, not collected or not ended; the test that failed


@contextmanager
def copies(number: int) -> Iterator[SimpleQueue[Path]]:
    """Give copies of the tree at HEAD: a job takes one and puts it back."""
    with TemporaryDirectory() as folder:
        trees, free = [Path(folder, f"{k}") for k in range(number)], SimpleQueue[Path]()
        git = ["git", "-C", str(ROOT), "worktree"]
        try:
            for tree in trees:
                subprocess.run([*git, "add", "-q", "--detach", str(tree)], check=True)
                free.put(tree)
            yield free
        finally:
            for tree in trees:
                subprocess.run([*git, "remove", "--force", str(tree)], check=False)


def python(tree: Path, *command: str, limit: float | None = None) -> Any:
    """Run Python in a copy, whose modules come before those that are installed."""
    changes = {"PYTHONPATH": f"{tree}/src{os.pathsep}{tree}", "PYTHONDONTWRITEBYTECODE": "1"}
    env = {"NUMBA_CACHE_DIR": f"{tree.parent}/numba", **os.environ, **changes}
    options: Any = {"cwd": tree, "env": env, "capture_output": True, "text": True, "check": False}
    return subprocess.run([sys.executable, *command], timeout=limit, **options)


def ask(tree: Path, tests: list[str], limit: float | None = None) -> Outcome:
    """Return what tests say of a copy."""
    options = ["-x", "-q", "--tb=no", "-rfE", "-p", "no:cacheprovider"]
    try:
        done = python(tree, "-m", "pytest", *options, *tests, limit=limit)
    except subprocess.TimeoutExpired:
        return "not ended", f"after {limit:g} s"
    if done.returncode == 0:
        return "survived", ""
    said = [line.split(" ")[:2] for line in done.stdout.splitlines()]
    failed = [line[1] for line in said if line[0] in ("FAILED", "ERROR") and "::" in line[-1]]
    return ("caught", failed[0]) if failed else ("not collected", repr(done.stdout + done.stderr))


def texts(tree: Path, entry: Entry) -> tuple[str, str]:
    """Return the text of an entry's file without the fault and with it."""
    right = (tree / entry["file"]).read_text(encoding="utf-8")
    if (times := right.count(entry["old"])) != entry.get("count", 1):
        sys.exit(f"{entry['name']}: {entry['file']} has {times} times {entry['old']!r:.200}")
    return right, right.replace(entry["old"], entry["new"])


def outcomes(entries: list[Entry], jobs: int, limit: float) -> Iterator[tuple[Entry, Outcome]]:
    """Yield each entry with what its tests say, after all of these have passed without it."""

    def outcome(entry: Entry) -> Outcome:
        tree = free.get()
        right, wrong = texts(tree, entry)
        try:
            (tree / entry["file"]).write_text(wrong, encoding="utf-8")
            return ask(tree, entry["tests"], limit)
        finally:
            (tree / entry["file"]).write_text(right, encoding="utf-8")
            free.put(tree)

    with copies(jobs) as free, ThreadPoolExecutor(jobs) as pool:
        tree = free.get()
        for entry in entries:
            texts(tree, entry)
        used = python(tree, "-c", "import topheavy; print(topheavy.__file__)").stdout
        said, test = ask(tree, sorted({test for entry in entries for test in entry["tests"]}))
        if said != "survived" or str(tree) not in used:
            sys.exit(f"without any fault, with {used.strip()}: {said} {test}")
        free.put(tree)
        yield from zip(entries, pool.map(outcome, entries), strict=True)


def main() -> int:
    """Print the outcome of each fault that the command line names; return how many survive."""
    parser = argparse.ArgumentParser()
    parser.add_argument("-j", type=int, default=1, dest="jobs", help="how many at a time")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    groups = yaml.safe_load(FAULTS.read_text(encoding="utf-8"))
    entries = {
        entry["name"]: group | entry for group in groups for entry in group.get("faults", [group])
    }
    if unknown := {*options.names} - {*entries}:
        sys.exit(f"{FAULTS} has no {', '.join(sorted(unknown))}")
    chosen = [entries[name] for name in options.names or entries]
    return report(chosen, options.jobs, LIMIT)


def report(entries: list[Entry], jobs: int, limit: float) -> int:
    """Print each entry with its outcome, and how many are caught; return how many are not."""
    missed = 0
    for entry, (outcome, test) in outcomes(entries, jobs, limit):
        print(f"{outcome}: {entry['name']} {test}", flush=True)
        missed += outcome != "caught"
    print(f"{len(entries) - missed} of {len(entries)} caught")
    return missed


if __name__ == "__main__":
    sys.exit(bool(main()))
