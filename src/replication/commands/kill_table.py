"""Insert deliberate faults, one at a time, and find what catches each: `make kill-table`.

The command inserts each fault of the paper and of its studies into a copy of the tree, never into
the library. It repeats what caught a fault last: a test, or one rule of the workflow, with the
quick settings. If that no longer catches it, or if the fault is new, the command runs the tests
that the fault names, then all rules that judge claims. A verdict that differs from the expected one
has caught the fault. If no verdict and no test fails, a rule has to raise an error; if none does,
the fault has survived.

A run of all faults writes docs/kill_table.csv and .md. A choice of them (`--faults`, `--rotate`)
only keeps its rows, for a later run or `make publish`.

`--all` asks another question: how many tests fail on a fault? It runs the tests that the fault
names and those that import what it changes, to their end, and writes docs/kill_counts.csv after
each. A test that is the only one of a fault stays.
"""

import argparse
import json
import resource
import shutil
import subprocess
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict
from functools import partial
from pathlib import Path
from queue import Queue
from threading import Lock
from typing import Any

from replication.inputs.parts import PAPER, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim
from replication.judging.ledger import read_ledger
from replication.kill import counts
from replication.kill.faults import FAULTS, JUDGING, Fault, load
from replication.kill.table import (
    Row,
    caught,
    current,
    first_failing,
    put_to_the_test,
    read,
    row_of,
    workflow,
    write,
)
from replication.kill.tree_copy import ROOT, copy_tree
from replication.workflow.costs import read_costs

TABLE = ROOT / "docs" / "kill_table"
COUNTS = ROOT / "docs" / "kill_counts.csv"
KEPT = ROOT / ".kill_table.jsonl"


def studies() -> list[str]:
    """Return the names of all studies, in the order of the config, then those not in it."""
    named = read_yaml(ROOT / "config" / "config.yaml")["studies"]
    found = sorted(path.parent.name for path in ROOT.glob("studies/*/claims.yaml"))
    return list(dict.fromkeys([*named, *found]))


def ledger_files() -> list[Path]:
    """Return the ledgers of the paper and of all studies."""
    return [ROOT / ledger_of(name) for name in [PAPER, *studies()]]


def ledgers() -> dict[str, list[Claim]]:
    """Return the claims that rules of the paper judge, and those that rules of studies judge."""
    claims = read_ledger(ledger_files())
    paper = ledger_files()[0]
    return {
        "paper": [claim for claim in claims if claim.ledger == paper],
        "studies": [claim for claim in claims if claim.ledger != paper],
    }


def kept(path: Path) -> dict[str, tuple[str, Row]]:
    """Return the rows that were found, with the digests of their faults, by name."""
    if not path.exists():
        return {}
    lines = map(json.loads, path.read_text(encoding="utf-8").splitlines())
    return {line["row"]["name"]: (line["digest"], row_of(line["row"])) for line in lines}


def keep(path: Path, digest: str, row: Row) -> None:
    """Add a row to those that were found, with the digest that its fault had when it was run."""
    line = {"digest": digest, "row": asdict(row)}
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(line, ensure_ascii=False) + "\n")


def left(faults: Sequence[Fault], known: dict[str, tuple[str, Row]]) -> list[Fault]:
    """Return the faults to be run: those without a row, that changed, or that survived."""
    return [
        fault
        for fault in faults
        if fault.name not in known
        or known[fault.name][0] != fault.digest(ROOT)
        or known[fault.name][1].caught_by == "SURVIVED"
    ]


def side_by_side(
    do: Callable[[Path, Fault], Any], faults: Sequence[Fault], trees: Sequence[Path]
) -> Iterator[Any]:
    """Yield what is found of each fault as it is found, each in one of the trees."""
    free: Queue[Path] = Queue()
    for tree in trees:
        free.put(tree)

    def in_a_tree(fault: Fault) -> Any:
        tree = free.get()
        try:
            return do(tree, fault)
        finally:
            free.put(tree)

    with ThreadPoolExecutor(len(trees)) as pool:
        doing = [pool.submit(in_a_tree, fault) for fault in faults]
        try:
            for done in as_completed(doing):
                yield done.result()
        finally:
            pool.shutdown(cancel_futures=True)


def kill_table(faults: Sequence[Fault], *, cores: int = 1) -> Iterator[Row]:
    """Yield the row of each fault as it is found, from as many copies of the tree as cores.

    Without a fault each test passes that is asked first or catches one, and no verdict turns by the
    rules that are asked.
    """
    ledger, names, made = ledgers(), studies(), ("results", ".snakemake")
    rows = current(read(TABLE.with_suffix(".csv")), load(), read_ledger(ledger_files()), ROOT)
    last, costs = {row.name: row for row in rows}, read_costs(ROOT / "docs" / "costs.csv")
    seconds = {name: cost[0] for name, cost in costs.items()}
    with tempfile.TemporaryDirectory(prefix="kill-table-") as folder:
        sound, *trees = (Path(folder) / f"tree{number}" for number in range(cores + 1))
        for tree in (sound, *trees):
            copy_tree(tree)
        making, computed, passed = Lock(), set(), set()

        def has_to_pass(tree: Path, tests: Iterable[str], cores: int = 0) -> None:
            """Run those that did not run without a fault yet."""
            new = sorted({test for test in tests if not {test, test.partition("::")[0]} & passed})
            if new and (failing := first_failing(tree, new, cores)):
                raise RuntimeError(f"without a fault: {failing} fails")
            passed.update(new)

        asked_first = ((last[f.name].test,) if f.name in last else f.tests for f in faults)
        has_to_pass(sound, {test for tests in asked_first for test in tests} - {""}, cores)

        def begin(tree: Path, claims: Sequence[Claim]) -> None:
            """Begin with the results of no fault: only what depends on one is made again."""
            with making:
                new = [claim for claim in claims if claim.finding and claim.rule not in computed]
                if new:
                    turned, rules, said = workflow(sound, new, names, cores)
                    if turned or rules:
                        raise RuntimeError(f"without a fault: {turned} turn, {rules} raise\n{said}")
                    computed.update(claim.rule for claim in new)
                clear(tree)
                for name in made:
                    shutil.copytree(sound / name, tree / name)

        def clear(tree: Path) -> None:
            for name in made:
                shutil.rmtree(tree / name, ignore_errors=True)

        def asked(tree: Path, fault: Fault) -> Row:
            try:
                known = {"last": last.get(fault.name), "seconds": seconds}
                row = put_to_the_test(tree, fault, ledger, names, partial(begin, tree), **known)
            finally:
                clear(tree)  # no test may see the results of a fault
            has_to_pass(tree, {row.test} - {""})
            return row

        yield from side_by_side(asked, faults, trees)


def count_tests(faults: Sequence[Fault], *, cores: int = 1) -> Iterator[dict[str, str]]:
    """Yield how many tests fail on each fault, from as many copies of the tree as cores."""
    with tempfile.TemporaryDirectory(prefix="kill-counts-") as folder:
        trees = [Path(folder) / f"tree{number}" for number in range(cores)]
        for tree in trees:
            copy_tree(tree)

        def counted(tree: Path, fault: Fault) -> dict[str, str]:
            return counts.row(fault, tree, counts.failing(tree, fault))

        yield from side_by_side(counted, faults, trees)


def count(faults: Sequence[Fault], picked: Sequence[Fault], cores: int) -> None:
    """Write how many tests fail on each of some faults; those whose row holds are not run again."""
    rows = counts.merged(faults, ROOT, counts.read(COUNTS))
    done = {row["name"] for row in rows}
    missing = [fault for fault in picked if fault.name not in done]
    print(f"{len(picked) - len(missing)} of {len(picked)} faults are in {COUNTS.name}", flush=True)
    for row in count_tests(missing, cores=cores) if missing else ():
        rows = counts.merged(faults, ROOT, rows, [row])
        counts.write(COUNTS, rows)
        print(f"{row['name']}: {row['caught_by_n']} tests fail {row['tests']}", flush=True)


def rotation(faults: list[Fault], number: int, commit: str) -> list[Fault]:
    """Return so many of the faults, spread over the list, as the hash of a commit picks them."""
    number, start = min(number, len(faults)), int(commit, 16) % len(faults)
    return [faults[(start + k * len(faults) // number) % len(faults)] for k in range(number)]


def chosen(faults: list[Fault], names: str | None, number: int | None) -> list[Fault]:
    """Return the chosen faults: by name or routes, by the commit, or all."""
    if names in {fault.routes for fault in faults}:
        faults, names = [fault for fault in faults if fault.routes == names], None
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


def refresh() -> bool:
    """Write the published table with what was found since, and without what no longer holds.

    Its page names the faults to run. Returns whether the faults by route and by what caught them
    are others, which documents count.
    """
    faults, ledger, found = load(), read_ledger(ledger_files()), kept(KEPT)
    before = read(TABLE.with_suffix(".csv"))
    rows = {row.name: row for row in before}
    rows |= {fault.name: found[fault.name][1] for fault in faults if not left([fault], found)}
    listed = [rows[fault.name] for fault in faults if fault.name in rows]
    rows = current(listed, faults, ledger, ROOT)
    known = {row.name for row in rows}
    write(rows, ledger, TABLE, [fault.name for fault in faults if fault.name not in known])
    told, now = (Counter((row.routes, row.caught_by) for row in each) for each in (before, rows))
    return told != now


def processor_seconds() -> float:
    """Return the processor time of all that was run so far, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--faults", help=f"names, separated by commas; or routes ({JUDGING})")
    parser.add_argument("--rotate", type=int, help="so many, picked by the hash of the commit")
    parser.add_argument("--all", action="store_true", help="count the tests that fail on each")
    parser.add_argument("--cores", type=int, default=1, help="so many faults at once")
    options = parser.parse_args()
    faults = load()
    if not faults:
        raise SystemExit(f"there are no faults; expected some in {' or '.join(FAULTS)}")
    picked = chosen(faults, options.faults, options.rotate)
    for fault in faults:
        fault.texts(ROOT)  # one that no longer applies is refused at once
    if options.all:
        count(faults, picked, options.cores)
        return
    missing = left(picked, kept(KEPT))
    print(f"{len(picked) - len(missing)} of {len(picked)} faults are in {KEPT.name}", flush=True)
    if missing:
        digests = {fault.name: fault.digest(ROOT) for fault in missing}  # the tree may change
        for row in kill_table(missing, cores=options.cores):
            keep(KEPT, digests[row.name], row)
            print(f"{processor_seconds():6.0f} s  {row.name}: {caught(row)}", flush=True)
    known = kept(KEPT)
    rows = [known[fault.name][1] for fault in picked]
    if picked == faults:
        write(rows, read_ledger(ledger_files()), TABLE)
    survivors = [row.name for row in rows if row.caught_by == "SURVIVED"]
    if survivors:
        raise SystemExit(f"{len(survivors)} of {len(rows)} faults survived: {', '.join(survivors)}")
    print(f"all of {len(rows)} faults were caught")


if __name__ == "__main__":
    main()
