"""What catches a fault: verdicts of the ledgers, tests, or a rule that stops."""

import csv
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from datetime import date
from pathlib import Path

from replication.judging.claim import Claim
from replication.judging.findings import Findings, read_findings
from replication.judging.ledger import with_verdict
from replication.kill.faults import JUDGING, Fault, faulty
from replication.kill.tree_copy import run

QUICK = "config/quick.yaml"
SHOWN = 3
"""So many verdicts of a fault are named in the page; the CSV has all."""


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
    date: str  # of the last run that caught it


def row_of(entry: Mapping[str, str]) -> Row:
    """Return the row of an entry, which may have columns that older tables had."""
    return Row(**{field.name: entry[field.name] for field in fields(Row)})


# What catches a fault ----------------------------------------------------------------------------


def workflow(
    tree: Path, ledger: Sequence[Claim], studies: Iterable[str], cores: int = 1
) -> tuple[list[str], list[str], str]:
    """Run the rules that claims are judged by; return the verdicts that turned, and who raised.

    The rules are those of the given rows, with the quick settings of the paper and of the studies.
    """
    rules = sorted({row.rule for row in ledger if row.finding})
    findings = [f"results/findings/{rule}.json" for rule in rules]
    quick = ("--configfile", QUICK) if (tree / QUICK).exists() else ()
    settings = (*quick, "--config", f"studies=[{','.join(studies)}]")
    options = ("--cores", str(cores), "--keep-going", *settings)
    code, said = run(tree, "-m", "snakemake", *options, "--", *findings)
    raised = sorted(set(re.findall(r"^Error in rule (\w+):", said, re.MULTILINE)))
    if code and not raised:  # given up, or nothing was run
        raised = ["all"]
    found = {
        rule: read_findings(tree / path)
        for rule, path in zip(rules, findings, strict=True)
        if (tree / path).exists()
    }
    turned = [
        row.id
        for row in ledger
        if row.finding and row.rule in found
        if verdict(row, found, tree) != row.expected
    ]
    return turned, raised, said


def verdict(claim: Claim, findings: Mapping[str, Findings], tree: Path) -> str:
    """Return the verdict on a claim, or why there is none."""
    try:
        return with_verdict(claim, findings, tree).verdict
    except ValueError as error:
        return f"none: {error}"


def first_failing(tree: Path, tests: Sequence[str], cores: int = 0) -> str:
    """Return the first test that fails, or nothing; with `cores`, by so many processes."""
    options = ("-q", "-x", "-rfE", "--no-header", "-p", "no:cacheprovider")
    options += (f"-n{cores}", "--dist=loadfile")
    return next(iter(failing(tree, *options, *tests)), "")


def failing(tree: Path, *options: str) -> list[str]:
    """Return the test functions that fail by pytest with these options and tests, each once.

    Raises
    ------
    RuntimeError
        If pytest failed and named no test.
    """
    code, said = run(tree, "-m", "pytest", *options)
    named = re.findall(r"^(?:FAILED|ERROR) ([^\s\[]+\.py(?:::[^\s\[]+)?)", said, re.MULTILINE)
    if code and not named:
        raise RuntimeError(f"pytest ended with {code} and named no test:\n{said[-2000:]}")
    return list(dict.fromkeys(named))


def last_time(
    last: Row | None, ledgers: Mapping[str, Sequence[Claim]], seconds: Mapping[str, float]
) -> list[tuple[str, Sequence[str], Sequence[Claim]]]:
    """Return what caught a fault last, to be asked first: its test, or the cheapest rule's claims.

    `seconds` has what a rule costs; rules of the paper go before those of studies.
    """
    if last is None:
        return []
    if last.test:
        return [("last", [last.test], [])]
    turned = set(last.verdicts.split())
    for ledger in ledgers.values():
        rules = {claim.rule for claim in ledger if claim.id in turned and claim.finding}
        if rules:
            cheapest = min(rules, key=lambda rule: (seconds.get(rule, 0.0), rule))
            return [("last", [], [claim for claim in ledger if claim.rule == cheapest])]
    return []


def put_to_the_test(
    tree: Path,
    fault: Fault,
    ledgers: Mapping[str, Sequence[Claim]],
    studies: Sequence[str],
    begin: Callable[[Sequence[Claim]], None],
    *,
    last: Row | None = None,
    seconds: Mapping[str, float] | None = None,
) -> Row:
    """Return what catches a fault: what caught it last; or its tests, the paper's rows, studies'.

    No row is computed by a fault in the judging.

    Parameters
    ----------
    ledgers
        The rows that rules of the "paper" judge, and those that rules of "studies" judge.
    studies
        Their names.
    begin
        Puts the results without a fault into the tree, those of the rules of these claims at least.
    last
        The row of the last table. Its verdicts that are not asked again stay in the new row.
    seconds
        What a rule costs.
    """
    courts = () if fault.routes == JUDGING else ("paper", "studies")
    sessions = [
        *last_time(last, ledgers, seconds or {}),
        ("tests", fault.tests, []),  # they take seconds
        *((court, [], ledgers[court]) for court in courts),
    ]
    test, verdicts, rules = "", [], []
    for court, tests, claims in sessions:
        if claims:
            begin(claims)
        with faulty(tree, fault):
            if court == "tests" or tests:
                test = first_failing(tree, tests)
            else:
                verdicts, raised, _ = workflow(tree, claims, studies)
                rules += raised
        if test or verdicts:
            break
    if last and court == "last" and (test or verdicts):
        again = {*last.verdicts.split()} - {claim.id for claim in claims} | {*verdicts}
        verdicts = [claim.id for rows in ledgers.values() for claim in rows if claim.id in again]
        rules = [*last.rules.split(), *rules]
    ways = {"verdict": verdicts, "test": test, "rule": rules}
    return Row(
        name=fault.name,
        fault=fault.fault,
        routes=fault.routes,
        files=" ".join(fault.files),
        caught_by=next((way for way, found in ways.items() if found), "SURVIVED"),
        verdicts=" ".join(verdicts),
        test=test,
        rules=" ".join(dict.fromkeys(rules)),
        date=date.today().isoformat(),
    )


# The published table -----------------------------------------------------------------------------


def page(rows: Sequence[Row], ledger: Iterable[Claim], waiting: Sequence[str] = ()) -> str:
    """Return docs/kill_table.md: what catches each fault, and which faults turn each claim.

    `waiting` names the faults that were not run since they were written or changed.
    """
    tested = [claim for claim in ledger if claim.finding]
    turned_by = {
        claim.id: [row.name for row in rows if claim.id in row.verdicts.split()] for claim in tested
    }
    reached = sum(map(bool, turned_by.values()))
    dates = sorted({row.date for row in rows})
    lines = [
        "# What catches a fault",
        "",
        "Deliberate faults in the physics and in the judging, one at a time, and what catches",
        "each: a test, or else a verdict of the ledgers. Written by `make kill-table`, by runs",
        f"from {dates[0]} to {dates[-1]}; files and dates are in `kill_table.csv`. A run repeats",
        "what caught a fault last, and asks no further.",
        *_waiting(waiting),
        "",
        "| fault | in words | routes that have it | caught by |",
        "|---|---|---|---|",
        *(_line(f"`{row.name}`", row.fault, row.routes, caught(row)) for row in rows),
        "",
        "## Which faults turn each claim",
        "",
        f"Of {len(tested)} claims that are tested, {reached} are turned by at least one fault.",
        "",
        "| claim | of | turned by |",
        "|---|---|---|",
        *(
            _line(
                f"`{claim.id}`",
                claim.study or "the paper",
                shortened(turned_by[claim.id]) or "no fault of this table",
            )
            for claim in tested
        ),
    ]
    return "\n".join(lines) + "\n"


def _waiting(names: Sequence[str]) -> list[str]:
    if not names:
        return []
    return ["", f"Not run since they were written or changed ({len(names)}): {', '.join(names)}."]


def _line(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def shortened(names: Sequence[str]) -> str:
    """Return the first names, and how many more there are."""
    parts = [f"`{name}`" for name in names[:SHOWN]]
    if len(names) > SHOWN:
        parts.append(f"{len(names) - SHOWN} more")
    return ", ".join(parts)


def caught(row: Row) -> str:
    """Return what caught a fault, for the page and the terminal."""
    if row.caught_by == "SURVIVED":
        return "nothing: SURVIVED"
    parts = [shortened(row.verdicts.split())] if row.verdicts else []
    if row.test:
        parts.append(f"test `{row.test}`")
    parts += [f"rule {rule} stops" for rule in row.rules.split()]
    return ", ".join(parts)


def read(path: Path) -> list[Row]:
    """Return the rows of a published table; none before the first one."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return list(map(row_of, csv.DictReader(file)))


def current(
    rows: Iterable[Row], faults: Sequence[Fault], ledger: Iterable[Claim], root: Path
) -> list[Row]:
    """Return the rows that still say what catches a fault, in their order.

    A row whose fault was reworded, or of which what caught it was removed, is left out: its fault
    has to be run again. Claims and rules that were removed leave the other rows.
    """
    claims = {claim.id for claim in ledger}
    files = [root / "Snakefile", *root.glob("src/*/*.smk"), *root.glob("studies/*/*.smk")]
    made = set(re.findall(r"\brule (\w+):", "".join(path.read_text("utf-8") for path in files)))
    known = {(f.name, f.fault, f.routes, " ".join(f.files)) for f in faults}
    kept = []
    for row in rows:
        verdicts = [name for name in row.verdicts.split() if name in claims]
        rules = [name for name in row.rules.split() if name in {*made, "all"}]
        tested = bool(row.test) and _is_there(row.test, root)
        left = {"verdict": verdicts, "test": tested, "rule": rules}.get(row.caught_by)
        if left and (row.name, row.fault, row.routes, row.files) in known:
            kept.append(replace(row, verdicts=" ".join(verdicts), rules=" ".join(rules)))
    return kept


def _is_there(test: str, root: Path) -> bool:
    """Return whether the file of a test still has its class and function, those that it names."""
    file, *names = test.split("::")
    if not (root / file).is_file():
        return False
    text = (root / file).read_text(encoding="utf-8")
    return all(re.search(rf"^\s*(def|class) {name}\b", text, re.MULTILINE) for name in names)


def write(
    rows: Sequence[Row],
    ledger: Iterable[Claim],
    table: Path,
    waiting: Sequence[str] = (),
) -> None:
    """Write the table as CSV, and its page as Markdown beside it."""
    names = [field.name for field in fields(Row)]
    with table.with_suffix(".csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([getattr(row, name) for name in names] for row in rows)
    table.with_suffix(".md").write_text(page(rows, ledger, waiting), encoding="utf-8")
