"""Publish the findings of a run, the verdicts, and the pages that show them."""

import os
import platform
import re
import shutil
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from replication.inputs.parts import PAPER, edition_of, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim, JudgedClaim
from replication.judging.digits import numbers
from replication.judging.findings import Findings, findings_by_rule, write_findings
from replication.judging.ledger import (
    OURS,
    REPRODUCED,
    as_text,
    read_judged,
    read_ledger,
    with_verdicts,
)
from replication.judging.verdicts import VERDICTS, by_origin
from replication.origin.recorded import read_crate
from replication.pages import blanks
from replication.pages.seal import digest
from replication.pages.typeset import figure_numbers, options_of

TITLES = {
    "": "The paper",
    OURS: "Not the paper's claims, and its claims rest on them",
    REPRODUCED: "Numbers of ours, rounded from an earlier run",
}
"""The sections of docs/verdicts.md that are not a study's."""

OF_STUDIES = (
    "These claims are ours. A remark says where we chose a limit after an earlier run; the verdict "
    "then says that a new run agrees, not that we predicted it."
)
OF_REPRODUCED = (
    "Their verdicts say that a new run gives the same number again. They count nowhere as evidence."
)

DIGITS = 9
"""Of the numbers in the published findings, as in the tables."""

JUMPS = ("qualified", "slip", "misprint", "refuted")

COUNTS_HEAD = "| | " + " | ".join(VERDICTS) + " |"
"""The first line of the table that counts the verdicts, in docs/verdicts.md and in the README."""


def verdict_page(rows: Sequence[JudgedClaim], reference: Path) -> str:
    """Return docs/verdicts.md: the counts, then the rows of the paper and of each study apart.

    One digest ties the page to the folder of the findings and tables that it was judged from.
    """
    parts = {row.study: [] for row in rows}
    for row in rows:
        parts[row.study].append(row)
    lines = [
        "# The verdict on every claim",
        "",
        "Computed by the workflow (`results/claims.json`); this page is written by `make publish`.",
        f"Judged from `tests/reference/`; SHA-256 of its list of files: `{digest(reference)}`.",
        "A slip or misprint may be a fault of the text that we worked from, and not of the print.",
        "",
        *count_table(rows),
        "",
        *jumps(rows),
    ]
    for study, own in parts.items():
        title = TITLES.get(study, f"The study `{study}`")
        lines += ["", f"## {title}", ""]
        if study == REPRODUCED or study not in TITLES:
            lines += [OF_REPRODUCED if study == REPRODUCED else OF_STUDIES, ""]
        lines += verdict_table(own)
    return "\n".join(lines) + "\n"


def jumps(rows: Sequence[JudgedClaim]) -> list[str]:
    """Return for each verdict that does not say a plain yes a line of links to its claims."""
    found = {name: [row.id for row in rows if row.verdict == name] for name in JUMPS}
    links = {name: ", ".join(f"[{each}](#{each})" for each in ids) for name, ids in found.items()}
    return [f"- *{name}*: {listed}" for name, listed in links.items() if listed]


def verdict_table(rows: Sequence[JudgedClaim]) -> list[str]:
    """Return the lines of a table with one claim in each; its id is the anchor of a link to it.

    Four columns fit on a screen; what belongs together is in lines of one cell.
    """
    lines = ["| claim, in our words | verdict | condition, remark | where |", "|---|---|---|---|"]
    for row in rows:
        digits = numbers(row)
        compared = [
            f"{name} {shown}"
            for name in ("printed", "computed")
            if (shown := _shown(getattr(row, name), digits.get(name, ""), row.unit))
        ]
        cells = [
            f'<a id="{row.id}"></a>{row.statement}<br><sub>[{row.id}](#{row.id})</sub>',
            "<br>".join([row.verdict, *compared]),
            "<br>".join(filter(None, [computed_words(row), row.remark])),
            row.where,
        ]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return lines


def computed_words(row: JudgedClaim) -> str:
    """Return how a statement holds that is true on a condition, or as it is meant; or nothing."""
    if row.computed is not False:
        return ""
    if row.verdict == "qualified":
        return f"on condition: {row.condition}" if row.condition else "in another convention"
    return "as meant" if row.verdict in ("slip", "misprint") else ""


def count_table(rows: Sequence[JudgedClaim]) -> list[str]:
    """Return the lines of a table that counts the verdicts, of the paper and of each study.

    Numbers of ours that a new run gives again are not counted.
    """
    lines = [COUNTS_HEAD, "|---" * (len(VERDICTS) + 1) + "|"]
    for name, verdicts in by_origin(row for row in rows if row.study != REPRODUCED).items():
        cells = [name if name in ("paper", OURS) else f"study `{name}`"]
        cells += [str(verdicts.count(verdict)) for verdict in VERDICTS]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def with_counts(page: str, rows: Sequence[JudgedClaim]) -> str:
    """Return a page in which the table of counts is that of the rows.

    Raises
    ------
    ValueError
        When the page has no such table.
    """
    table = "".join(f"{line}\n" for line in count_table(rows))
    old = rf"^{re.escape(COUNTS_HEAD)} *\n(?:\|.*(?:\n|\Z))*"
    made, times = re.subn(old, lambda _: table, page, flags=re.MULTILINE)
    if times != 1:
        raise ValueError(f"the page has {times} lines {COUNTS_HEAD!r}; expected one")
    return made


def rounded(found: Any, digits: int = DIGITS) -> Any:
    """Return findings with their numbers rounded, an error to two digits: the rest is noise."""
    match found:
        case float():
            return float(f"{found:.{digits}g}")
        case dict():
            return {k: rounded(v, 2 if k == "error" else digits) for k, v in found.items()}
        case list():
            return [rounded(item, digits) for item in found]
        case _:
            return found


def machine() -> str:
    """Return one line that names this machine."""
    cpuinfo = Path("/proc/cpuinfo")
    known = cpuinfo.read_text() if cpuinfo.exists() else ""
    model = re.search(r"^model name\s*:(.*)", known, re.MULTILINE)
    processor = model[1].strip() if model else platform.processor() or platform.machine()
    python = f"Python {platform.python_version()}"
    return f"{os.cpu_count()} cores of {processor}, {platform.system()}, {python}"


def _shown(value: object, digits: str, unit: str) -> str:
    match value:
        case None | bool():  # the verdict says it
            return ""
        case str():
            return value
        case _:
            return f"{digits} {unit}".rstrip()


def publish(tables: Iterable[str], sources: Iterable[str] = ()) -> None:
    """Copy what every replication publishes of a finished run: `make publish`.

    tests/reference/ gets the configs, the tables, the findings and the verdicts; docs/ and the
    README get the pages that show the verdicts. The edition.yaml of each study names the tables and
    pictures that it adds. What else is published comes next, and then `seal`.

    Parameters
    ----------
    tables
        Those with which later runs are compared.
    sources
        Others from which findings follow: too sensitive to the processor to be compared.

    Raises
    ------
    SystemExit
        When there is no finished run, it was made with another config, it made no such table, or an
        earlier workflow left findings.
    """
    results, reference = Path("results"), Path("tests/reference")
    if not (results / "claims.json").exists():
        sys.exit("results/claims.json does not exist; expected a finished run: make reproduce")
    used, ours = read_yaml(results / "config.yaml"), read_yaml("config/config.yaml")
    if used != ours:
        sections = sorted(key for key in {*used, *ours} if used.get(key) != ours.get(key))
        sys.exit(
            f"results/ was made with another config, which differs in {', '.join(sections)}; "
            "expected that of config/config.yaml: make reproduce"
        )
    tables, sources = list(tables), list(sources)
    editions = {name: edition_of(name) for name in ours["studies"]}
    named = dict.fromkeys([*tables, *sources], "src/steps/publish.py")
    for study, edition in editions.items():
        named |= dict.fromkeys(edition.tables, f"studies/{study}/edition.yaml")
    for name, by in named.items():
        if not (made := results / "tables" / f"{name}.csv").exists():
            sys.exit(
                f"{made} does not exist, and {by} names {name!r} among its tables; "
                "expected tables of the run: correct the name, or make reproduce"
            )
    made_by_rules = read_crate().rules
    for path in sorted(results.glob("findings/*.json")):
        if path.as_posix() not in made_by_rules:
            sys.exit(f"{path} is of no rule of the run; expected findings of the run: delete it")
    Path("docs").mkdir(exist_ok=True)
    reference.mkdir(parents=True, exist_ok=True)
    shutil.copyfile("config/config.yaml", reference / "config.yaml")
    shutil.copyfile(results / "origins.json", reference / "origins.json")
    shutil.copyfile(results / "costs.csv", "docs/costs.csv")
    numbers = figure_numbers(options_of(ours["studies"], {}))
    lines = ["figure,number", *(f"{path},{number}" for path, number in numbers.items())]
    Path("docs/figures.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    for old in reference.glob("*.csv"):
        old.unlink()
    for folder in ("sources", "studies"):
        shutil.rmtree(reference / folder, ignore_errors=True)  # with those of removed studies
        (reference / folder).mkdir()
    copies = [*((name, "") for name in tables), *((name, "sources") for name in sources)]
    for study, edition in editions.items():
        shutil.copyfile(f"studies/{study}/config.yaml", reference / "studies" / f"{study}.yaml")
        copies += ((name, "studies") for name in edition.tables)
        for name, picture in edition.pictures.items():
            shutil.copyfile(Path("studies", study, picture), Path("docs", name))
    for name, folder in copies:
        shutil.copyfile(results / "tables" / f"{name}.csv", reference / folder / f"{name}.csv")
    publish_findings(results / "findings", reference / "findings")
    publish_verdicts(read_ledger(map(ledger_of, [PAPER, *ours["studies"]])), Path())
    blanks.main()
    print("published; a run compares its tables with these: 'make reproduce' before 'make verify'")


def publish_findings(findings: Path, folder: Path) -> None:
    """Write all findings of a run, rounded, in place of those that are published.

    Raises
    ------
    ValueError
        When a rule tested nothing, for lack of an optional package.
    """
    made = findings_by_rule(sorted(findings.glob("*.json")))
    for rule, of_rule in made.items():
        if reason := of_rule.not_tested:
            path = findings / f"{rule}.json"
            raise ValueError(f"{path}: nothing was tested ({reason}); expected a full run")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for rule, of_rule in made.items():
        write_findings(folder / f"{rule}.json", Findings.of(rounded(of_rule.as_json())))


def publish_verdicts(ledger: Sequence[Claim], root: Path) -> None:
    """Judge the published findings; write claims.json, docs/verdicts.md and the README's counts."""
    reference = root / "tests" / "reference"
    rows = with_verdicts(ledger, findings_by_rule((reference / "findings").glob("*.json")), root)
    text = as_text(rows, published=True)
    (reference / "claims.json").write_text(text, encoding="utf-8")
    (root / "docs" / "verdicts.md").write_text(verdict_page(rows, reference), encoding="utf-8")
    readme = root / "README.md"
    readme.write_text(with_counts(readme.read_text(encoding="utf-8"), rows), encoding="utf-8")


if __name__ == "__main__":  # `make update`: the page of what is published, as this machine has it
    PUBLISHED = Path("tests/reference")
    PAGE = verdict_page(read_judged(PUBLISHED / "claims.json"), PUBLISHED)
    Path("docs/verdicts.md").write_text(PAGE, encoding="utf-8")
