"""Insert deliberate faults, one at a time, and find what catches each: `make kill-table`.

The command inserts each fault of faults.yaml into a copy of the tree, never into the library. It
runs the workflow in the copy with the quick settings, and only the rules of the claims. A verdict
that differs from the expected one has caught the fault. Otherwise the command runs the tests that
the fault names; for a fault in the judging it runs these tests first. If no verdict and no test
fails, a rule has to raise an error; if none does, the fault has survived.

A run of all faults writes docs/kill_table.csv and .md. A choice of them (`--faults`, `--rotate`)
only keeps its rows, for a later run.
"""

import argparse
import json
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

from replication.claim import Claim
from replication.faults import JUDGING, Fault, load
from replication.kill_table import (
    Row,
    caught,
    current,
    first_failing,
    put_to_the_test,
    read,
    workflow,
    write,
)
from replication.ledger import read_ledger
from replication.parts import PAPER, ledger_of
from replication.strict_yaml import read_yaml
from replication.tree_copy import ROOT, check_imports, copy_tree

TABLE = ROOT / "docs" / "kill_table"
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
    return {line["row"]["name"]: (line["digest"], Row(**line["row"])) for line in lines}


def keep(path: Path, fault: Fault, row: Row) -> None:
    """Add a row to those that were found."""
    line = {"digest": fault.digest(ROOT), "row": asdict(row)}
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


def kill_table(faults: Sequence[Fault]) -> Iterator[Row]:
    """Yield the row of each fault, after a run without any in which no verdict may turn.

    That run is made before the first verdict; faults that tests catch do not need it.
    """
    with tempfile.TemporaryDirectory(prefix="kill-table-") as folder:
        tree, sound = Path(folder) / "tree", Path(folder) / "sound"
        copy_tree(tree)
        check_imports(tree)
        asked, names, made = ledgers(), studies(), ("results", ".snakemake")

        def begin() -> None:
            """Begin with the results of no fault: only what depends on one is made again."""
            if not sound.exists():
                turned, rules, said = workflow(tree, [*asked["paper"], *asked["studies"]], names)
                if turned or rules:
                    raise RuntimeError(f"without a fault: {turned} turn, {rules} raise\n{said}")
                for name in made:
                    shutil.copytree(tree / name, sound / name)
            for name in made:
                shutil.rmtree(tree / name)
                shutil.copytree(sound / name, tree / name)

        tests = {test for fault in faults if fault.routes == JUDGING for test in fault.tests}
        if tests and (failing := first_failing(tree, sorted(tests))):
            raise RuntimeError(f"without a fault: {failing} fails")
        for fault in faults:
            yield put_to_the_test(tree, fault, asked, names, begin)


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


def refresh() -> None:
    """Write the published table without what no longer holds; its page names the faults to run."""
    faults, ledger = load(), read_ledger(ledger_files())
    rows = current(read(TABLE.with_suffix(".csv")), faults, ledger, ROOT)
    known = {row.name for row in rows}
    write(rows, ledger, TABLE, [fault.name for fault in faults if fault.name not in known])


def processor_seconds() -> float:
    """Return the processor time of all that was run so far, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--faults", help=f"names, separated by commas; or routes ({JUDGING})")
    parser.add_argument("--rotate", type=int, help="so many, picked by the hash of the commit")
    options = parser.parse_args()
    faults = load()
    picked = chosen(faults, options.faults, options.rotate)
    for fault in faults:
        fault.texts(ROOT)  # one that no longer applies is refused at once
    missing = left(picked, kept(KEPT))
    print(f"{len(picked) - len(missing)} of {len(picked)} faults are in {KEPT.name}", flush=True)
    if missing:
        for fault, row in zip(missing, kill_table(missing), strict=True):
            keep(KEPT, fault, row)
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
