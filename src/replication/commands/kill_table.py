"""Deliberate faults in the physics, one at a time, and what catches each: `make kill-table`.

Each fault of faults.yaml is put into a copy of the tree, never into the library itself. There the
workflow runs, with config/quick.yaml and as far as the claims need it; whatever verdict comes out
otherwise than the ledger expects has caught the fault. If there is none, the tests that the fault
names are run. A fault that no verdict and no test catches has at least to make a rule raise, or it
has survived.

All faults together write docs/kill_table.csv and .md; a choice of them (`--faults`, `--rotate`)
writes nothing.
"""

import argparse
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, dataclass, fields
from pathlib import Path

from replication.strict_yaml import read_yaml
from replication.verdicts import verdict_on

ROOT = Path(__file__).resolve().parents[3]
FAULTS = ROOT / "faults" / "faults.yaml"
TABLE = ROOT / "docs" / "kill_table"
QUICK = "config/quick.yaml"
LONGEST = 900.0
"""s: a run that takes longer hangs."""
SHOWN = 3
"""So many verdicts of a fault are named in the page; the CSV has all."""


@dataclass(frozen=True)
class Change:
    """A text in a file that becomes another."""

    file: str
    old: str
    new: str


@dataclass(frozen=True)
class Fault:
    """What is wrong, which routes share it, and the tests that are asked if no verdict turns."""

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


@dataclass(frozen=True)
class Row:
    """What became of a fault; `verdicts` and `rules` are separated by spaces."""

    name: str
    fault: str
    routes: str
    files: str
    caught_by: str  # "verdict", "test", "rule" or "SURVIVED"
    verdicts: str
    test: str
    rules: str  # those that raise; "all" for a run that was given up


def load() -> list[Fault]:
    """Return the faults of faults.yaml."""
    return [
        Fault(
            **entry
            | {
                "tests": tuple(entry["tests"]),
                "changes": tuple(Change(**change) for change in entry["changes"]),
            }
        )
        for entry in read_yaml(FAULTS)
    ]


# The copy of the tree ----------------------------------------------------------------------------


def copy_tree(to: Path) -> None:
    """Copy what git tracks or would track; of a source archive, all but what the run makes."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=False,
    )
    if listed.returncode != 0:
        own = shutil.ignore_patterns(".*", "results", "__pycache__", "*.svg", "report.pdf")
        shutil.copytree(ROOT, to, ignore=own, dirs_exist_ok=True)
        shutil.copytree(ROOT / "docs", to / "docs", dirs_exist_ok=True)
        return
    for name in listed.stdout.decode().split("\0"):
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, to / name)


def run(tree: Path, *command: str) -> tuple[int, str]:
    """Run Python in a tree with the tree's own library; return its code and all that it said."""
    with subprocess.Popen(
        [sys.executable, *command],
        cwd=tree,
        env=os.environ | {"PYTHONPATH": str(tree / "src")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as process:
        try:
            said, _ = process.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            said, _ = process.communicate()
            said += f"\ngiven up after {LONGEST:g} s"
    return process.returncode, said


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


# What catches a fault ----------------------------------------------------------------------------


def workflow(tree: Path, ledger: list[dict]) -> tuple[list[str], list[str], str]:
    """Run the rules that claims are judged by; return the verdicts that turned, and who raised."""
    rules = sorted({row["rule"] for row in ledger if row.get("finding")})
    findings = [f"results/findings/{rule}.json" for rule in rules]
    options = ("--cores", "2", "--configfile", QUICK)
    code, said = run(tree, "-m", "snakemake", *options, "--", *findings)
    raised = list(dict.fromkeys(re.findall(r"^Error in rule (\w+):", said, re.MULTILINE)))
    if code and not raised:  # given up, or nothing was run
        raised = ["all"]
    found = {
        rule: json.loads((tree / path).read_text(encoding="utf-8"))
        for rule, path in zip(rules, findings, strict=True)
        if (tree / path).exists()
    }
    turned = [
        row["id"]
        for row in ledger
        if row.get("rule") in found and verdict(row, found[row["rule"]]) != row["expected"]
    ]
    return turned, raised, said


def verdict(claim: dict, findings: dict) -> str:
    """Return the verdict on a claim, or why there is none."""
    try:
        return verdict_on(claim, findings[claim["finding"]])
    except (KeyError, ValueError) as error:
        return f"none: {error}"


def first_failing(tree: Path, tests: Sequence[str]) -> str:
    """Return the first test that fails, or nothing."""
    options = ("-q", "-x", "-rfE", "--no-header", "-p", "no:cacheprovider")
    code, said = run(tree, "-m", "pytest", *options, *tests)
    if code == 0:
        return ""
    named = re.search(r"^(?:FAILED|ERROR) (tests/\S+\.py(?:::[^\s\[]+)?)", said, re.MULTILINE)
    if not named:
        raise RuntimeError(f"pytest ended with {code} and named no test:\n{said[-2000:]}")
    return named[1]


def put_to_the_test(tree: Path, fault: Fault, ledger: list[dict]) -> Row:
    """Return what catches a fault."""
    with faulty(tree, fault):
        verdicts, rules, _ = workflow(tree, ledger)
        test = "" if verdicts else first_failing(tree, fault.tests)
    if test and first_failing(tree, [test]):
        raise RuntimeError(f"{fault.name}: {test} fails without the fault too")
    ways = {"verdict": verdicts, "test": test, "rule": rules}
    caught = next((way for way, found in ways.items() if found), "SURVIVED")
    return Row(
        name=fault.name,
        fault=fault.fault,
        routes=fault.routes,
        files=" ".join(fault.files),
        caught_by=caught,
        verdicts=" ".join(verdicts),
        test=test,
        rules=" ".join(rules),
    )


def kill_table(faults: list[Fault]) -> Iterator[Row]:
    """Yield the row of each fault, after a run without any in which no verdict may turn."""
    ledger = read_yaml(ROOT / "paper" / "claims.yaml")
    for fault in faults:
        fault.texts(ROOT)  # one that no longer applies is told at once
    with tempfile.TemporaryDirectory(prefix="kill-table-") as folder:
        tree, sound = Path(folder) / "tree", Path(folder) / "sound"
        copy_tree(tree)
        code, where = run(tree, "-c", "import replication; print(replication.__file__)")
        if code or not Path(where.strip()).is_relative_to(tree):
            raise RuntimeError(f"the copy imports its code from {where.strip()}; expected {tree}")
        verdicts, rules, said = workflow(tree, ledger)
        if verdicts or rules:
            raise RuntimeError(f"without a fault: {verdicts} turn, {rules} raise\n{said}")
        # Each fault starts from these results, so that only what depends on it is made again.
        for name in ("results", ".snakemake"):
            shutil.copytree(tree / name, sound / name)
        for fault in faults:
            for name in ("results", ".snakemake"):
                shutil.rmtree(tree / name)
                shutil.copytree(sound / name, tree / name)
            yield put_to_the_test(tree, fault, ledger)


# The published table -----------------------------------------------------------------------------


def page(rows: list[Row]) -> str:
    """Return docs/kill_table.md."""
    lines = [
        "# What catches a fault",
        "",
        "Deliberate faults in the physics, one at a time, and what each turns: a verdict of",
        "`paper/claims.yaml`, or else a test. Written by `make kill-table`; the whole of it, with",
        "all verdicts and files, is in `kill_table.csv`.",
        "",
        "| fault | in words | routes that have it | caught by |",
        "|---|---|---|---|",
    ]
    for row in rows:
        cells = [f"`{row.name}`", row.fault, row.routes, _caught(row)]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _caught(row: Row) -> str:
    if row.caught_by == "SURVIVED":
        return "nothing: SURVIVED"
    names = row.verdicts.split()
    parts = [f"`{name}`" for name in names[:SHOWN]]
    if len(names) > SHOWN:
        parts.append(f"{len(names) - SHOWN} more")
    if row.test:
        parts.append(f"test `{row.test}`")
    rules = row.rules.split()
    parts += [f"rule {rule} stops" for rule in rules]
    return ", ".join(parts)


def publish(rows: list[Row]) -> None:
    """Write docs/kill_table.csv and .md."""
    with TABLE.with_suffix(".csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in fields(Row)])
        writer.writerows(map(astuple, rows))
    TABLE.with_suffix(".md").write_text(page(rows), encoding="utf-8")


def rotation(faults: list[Fault], number: int, commit: str) -> list[Fault]:
    """Return so many of the faults, spread over the list, as the hash of a commit picks them."""
    number, start = min(number, len(faults)), int(commit, 16) % len(faults)
    return [faults[(start + k * len(faults) // number) % len(faults)] for k in range(number)]


def chosen(faults: list[Fault], names: str | None, number: int | None) -> list[Fault]:
    """Return the faults that are asked for: by name, by the commit, or all."""
    if names:
        known = {fault.name: fault for fault in faults}
        for name in names.split(","):
            if name not in known:
                raise SystemExit(f"no fault is named {name!r}; there are {', '.join(known)}")
        return [known[name] for name in names.split(",")]
    if number:
        head = ["git", "rev-parse", "HEAD"]
        try:
            found = subprocess.run(head, cwd=ROOT, capture_output=True, text=True, check=True)
        except (OSError, subprocess.CalledProcessError):
            raise SystemExit(
                "ROTATE picks faults by the hash of the commit, and there is no git repository "
                "here; expected one, or names: make kill-table FAULTS=name,name"
            ) from None
        return rotation(faults, number, found.stdout)
    return faults


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--faults", help="names, separated by commas")
    parser.add_argument("--rotate", type=int, help="so many, picked by the hash of the commit")
    options = parser.parse_args()
    faults = load()
    picked = chosen(faults, options.faults, options.rotate)
    rows, start = [], time.monotonic()
    for row in kill_table(picked):
        rows.append(row)
        print(f"{time.monotonic() - start:6.0f} s  {row.name}: {_caught(row)}", flush=True)
    if picked == faults:
        publish(rows)
    survivors = [row.name for row in rows if row.caught_by == "SURVIVED"]
    if survivors:
        raise SystemExit(f"{len(survivors)} of {len(rows)} faults survived: {', '.join(survivors)}")
    print(f"all of {len(rows)} faults were caught")


if __name__ == "__main__":
    main()
