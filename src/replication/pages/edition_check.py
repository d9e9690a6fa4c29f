"""Check the published rows, pages and files against each other, without a run."""

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from itertools import zip_longest
from pathlib import Path

from replication.inputs.parts import PAPER, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim, JudgedClaim
from replication.judging.findings import Findings, findings_by_rule
from replication.judging.ledger import read_judged, read_ledger, with_verdict
from replication.judging.verdicts import tallies, tolerance_fault
from replication.pages.blanks import is_release
from replication.pages.edition import verdict_page, with_counts
from replication.pages.seal import OLDER, broken, outdated

CLAIMS = "tests/reference/claims.json"
AGREE = "the published findings, tables, claims and pages agree"
DIFFER = """\
The published findings, tables, claims and pages differ. If you changed the workflow on purpose,
run 'make reproduce', then 'make publish', and read the diff. If not, restore the files above."""


def claims(
    ledger: Sequence[Claim],
    findings: Mapping[str, Findings],
    published: Iterable[JudgedClaim],
    root: Path,
) -> Iterator[str]:
    """Yield what is wrong with the published rows: every field of every row is made anew."""
    published = list(published)
    rows = {row.id: row for row in published}
    for name in sorted({claim.id for claim in ledger} ^ set(rows)):
        yield f"claim {name} is not in both the ledger and {CLAIMS}"
    for name, times in Counter(row.id for row in published).items():
        if times > 1:
            yield f"claim {name} is {times} times in {CLAIMS}; expected one row"
    for claim in ledger:
        if fault := tolerance_fault(claim):
            yield f"claim {claim.id}: {fault}"
        if claim.rule and claim.rule not in findings:
            yield f"claim {claim.id}: the findings of its rule {claim.rule} are not published yet"
            continue
        try:
            found = with_verdict(claim, findings, root)
        except ValueError as fault:
            yield str(fault)
            continue
        if found.verdict != claim.expected:  # what a run lacks a package for is never published
            yield f"claim {claim.id} is {found.verdict}; expected {claim.expected}"
        row = asdict(rows.get(claim.id, found))
        for field, ours in sorted(asdict(found).items()):
            theirs = row[field]
            if ours != theirs or type(ours) is not type(theirs):
                yield (
                    f"claim {claim.id}: {field} is {theirs!r} in {CLAIMS}, and {ours!r} by the "
                    "ledger and the findings"
                )


def pages(root: Path, rows: Sequence[JudgedClaim]) -> Iterator[str]:
    """Yield the first line of docs/verdicts.md, and of the README, that is not that of the rows."""
    readme = (root / "README.md").read_text(encoding="utf-8")
    expected = {
        "docs/verdicts.md": lambda: verdict_page(rows, root / "tests" / "reference"),
        "README.md": lambda: with_counts(readme, rows),
    }
    for page, made in expected.items():
        lines = (root / page).read_text(encoding="utf-8").splitlines()
        try:
            theirs = made().splitlines()
        except ValueError as fault:
            yield f"{page}: {fault}"
            continue
        for number, (line, other) in enumerate(zip_longest(lines, theirs), 1):
            if line != other:
                yield f"{page}, line {number} is {line!r}; expected {other!r} by tests/reference"
                break  # the lines below may only be shifted


def configs(root: Path, studies: Iterable[str]) -> Iterator[str]:
    """Yield the sections of the configs that changed since the published run."""
    pairs = {"config/config.yaml": "config.yaml"}
    pairs |= {f"studies/{name}/config.yaml": f"studies/{name}.yaml" for name in studies}
    for ours, theirs in pairs.items():
        path = root / "tests" / "reference" / theirs
        if not path.is_file():
            yield f"tests/reference/{theirs} does not exist; `make publish` copies {ours} there"
            continue
        now, published = read_yaml(root / ours), read_yaml(path)
        for section in sorted({*now, *published} - {"needs"}):  # on which no number depends
            if now.get(section) != published.get(section):
                yield (
                    f"{ours}: {section} is not that of the published run, "
                    f"tests/reference/{theirs}; run again and `make publish`, or restore it"
                )


def main(
    departures: Callable[[Path, Mapping[str, Findings]], Iterable[str]], root: Path = Path()
) -> tuple[list[str], list[str]]:
    """Return the tallies of the published claims, and what is wrong with the edition.

    That inputs or texts changed since is wrong of a release: when RELEASE is set. Else the tallies
    end with it. `departures` yields what is wrong with the published tables, and with the findings
    drawn from them.
    """
    reference = root / "tests" / "reference"
    try:
        config = read_yaml(root / "config" / "config.yaml")
        ledger = read_ledger(root / ledger_of(name) for name in [PAPER, *config["studies"]])
        findings = findings_by_rule((reference / "findings").glob("*.json"))
        rows = read_judged(root / CLAIMS)
        faults = [
            *claims(ledger, findings, rows, root),
            *departures(reference, findings),
            *pages(root, rows),
            *configs(root, config["studies"]),
            *broken(root),
        ]
    except FileNotFoundError as missing:
        what = "expected a file of the published run, or no check of it in src/steps/recheck.py"
        return [], [f"{missing.filename} does not exist; {what}"]
    except ValueError as unreadable:
        return [], [str(unreadable)]
    except (AttributeError, KeyError, TypeError) as broken_file:
        what = "a published table or finding, or a section of the config, lacks what is read of it"
        return [], [f"{what}: {type(broken_file).__name__}: {broken_file}"]
    changed = list(outdated(root))
    if is_release():
        return tallies(rows), [*faults, *changed]
    return [*tallies(rows), *changed], faults


def close(lines: Iterable[str], faults: Iterable[str]) -> None:
    """Print what `main` returned, and end the process: with an error if there is a fault."""
    sys.stdout.reconfigure(errors="replace")  # a terminal may know no Greek letters
    lines, faults = list(lines), list(faults)
    print(*faults, *lines, sep="\n")
    print(DIFFER if faults else AGREE)
    if older := sum(line.startswith(OLDER) for line in lines):
        print(
            f"{older} inputs and texts changed since `make publish`: what was checked is older, "
            "and with RELEASE=1 that is an error"
        )
    sys.exit(bool(faults))
