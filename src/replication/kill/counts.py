"""How many tests fail on a fault: all are run that may notice it, and none stops the others."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from replication.kill import table
from replication.kill.faults import Fault, faulty
from replication.workflow.code import imported

COLUMNS = ["name", "digest", "caught_by_n", "tests"]
TESTS = ("tests/**/test_*.py", "src/*/tests/**/test_*.py", "studies/*/tests/test_*.py")
SHOWN = 3
"""So many tests are named, those of a fault that few catch: of these none goes unseen."""


def test_files(root: Path, fault: Fault) -> list[str]:
    """Return the files of tests that a fault names, then those that import what it changes."""
    named = dict.fromkeys(test.partition("::")[0] for test in fault.tests)
    changed = {Path(file) for file in fault.files}
    paths = (path.relative_to(root) for tests in TESTS for path in sorted(root.glob(tests)))
    return list(named | {str(path): None for path in paths if changed & _imported(root, path)})


def _imported(root: Path, path: Path) -> frozenset[Path]:
    try:
        return imported(root, path)
    except ValueError:  # a name that is made as it runs
        return frozenset(p.relative_to(root) for p in root.glob("src/**/*.py"))


def failing(tree: Path, fault: Fault) -> list[str]:
    """Return the test functions of a tree that fail on a fault, each once."""
    options = ("-q", "-rfE", "--no-header", "--tb=no", "-n0", "-p", "no:cacheprovider")
    files = test_files(tree, fault)
    with faulty(tree, fault):
        try:
            return table.failing(tree, *options, *files)
        except RuntimeError as error:
            raise RuntimeError(f"{fault.name}: {error}") from None


def row(fault: Fault, root: Path, tests: Sequence[str]) -> dict[str, str]:
    """Return the row of a fault."""
    named = " ".join(tests) if len(tests) <= SHOWN else ""
    values = (fault.name, fault.digest(root)[:12], str(len(tests)), named)
    return dict(zip(COLUMNS, values, strict=True))


def merged(
    faults: Iterable[Fault], root: Path, *tables: Iterable[Mapping[str, str]]
) -> list[Mapping[str, str]]:
    """Return the rows that are still those of a fault, in the order of faults; the last counts."""
    rows = {entry["name"]: entry for table in tables for entry in table}
    return [
        rows[fault.name]
        for fault in faults
        if fault.name in rows and rows[fault.name]["digest"] == fault.digest(root)[:12]
    ]


def read(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table; none before the first one."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write(path: Path, rows: Iterable[Mapping[str, str]]) -> None:
    """Write the rows as a table."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
