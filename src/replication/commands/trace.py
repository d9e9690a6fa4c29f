"""From a number, table, figure or claim back to the paper and the inputs: `make trace ITEM=…`.

The chain is that of the RO-Crate of the run, which has each job, and the checksum of each file.
"""

import difflib
import json
import re
import signal
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from replication.inputs.checksums import checksum
from replication.inputs.parts import PAPER, config_of, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.citations import cite, citing, library_names, printed_list
from replication.judging.claim import Claim
from replication.judging.findings import read_findings
from replication.judging.ledger import finding_of, read_ledger
from replication.judging.verdicts import verdict_on
from replication.origin.recorded import CRATE, RUN
from replication.rules.one_claim import verdict_line
from replication.workflow.provenance import Job

ROOT = Path(__file__).parents[3]
"""The root of the repository; printed paths are relative to it."""

MOST_MATCHES = 6
"""So many names are suggested for one that is unknown."""

MOST_INPUTS = 4
"""So many inputs from one rule have a line each."""


@dataclass(frozen=True)
class Item:
    """The requested file, with an optional finding in it and the claims judged by this finding."""

    path: str | None
    key: str | None = None
    claims: tuple[Claim, ...] = ()


def read_jobs(path: str | Path = CRATE) -> tuple[list[Job], dict[str, str]]:
    """Return the jobs of a run, and the SHA-256 of each file by its path.

    Raises
    ------
    ValueError
        When there is no finished run.
    """
    if not Path(path).is_file():
        raise ValueError(f"{path} is not made yet; expected a finished run: make reproduce")
    graph = json.loads(Path(path).read_text(encoding="utf-8"))["@graph"]
    sums = {each["@id"]: each["sha256"] for each in graph if "sha256" in each}

    def files(of: Iterable[Mapping[str, str]]) -> tuple[str, ...]:
        return tuple(each["@id"] for each in of)

    jobs = [
        Job(
            each["name"],
            each["description"].partition(", ")[2],
            (each["instrument"]["@id"],),
            files(each["object"]),
            files(each["result"]),
        )
        for each in graph
        if each["@type"] == "CreateAction" and each["@id"] != RUN
    ]
    return jobs, sums


def find(name: str, jobs: Sequence[Job], ledger: Sequence[Claim], root: Path = Path()) -> Item:
    """Return the item that a name denotes.

    It may be an output or the end of its path, a claim, or a finding: `curve.rises`, or with its
    file, `findings/curve.json:rises`.

    Raises
    ------
    ValueError
        When the name denotes no output, or several; the message lists similar names.
    """
    made = [path for job in jobs for path in job.outputs]
    findings = {Path(path).stem: path for path in made if Path(path).match("findings/*.json")}
    for claim in ledger:
        if name in (claim.id, f"claim_{claim.id}"):
            return Item(findings.get(claim.rule), claim.finding or None, (claim,))

    outputs = sorted(path for path in made if Path(path).match(name))
    if len(outputs) > 1:
        raise ValueError(f"{name} is the end of several paths: {', '.join(outputs)}")
    for path in outputs:  # one or none
        return Item(path, claims=_judged_by(ledger, [r for r, p in findings.items() if p == path]))
    if users := sorted({job.rule for job in jobs if name in (*job.inputs, *job.scripts)}):
        raise ValueError(f"{name} is made by no rule; it goes into {', '.join(users)}")

    place, _, key = name.partition(":" if ":" in name else ".")
    known = [*made, *(claim.id for claim in ledger)]
    for rule, path in findings.items():
        if (root / path).is_file():
            keys = read_findings(root / path)
            asked = place == rule or (place != "" and Path(path).match(place))
            for found in keys if asked else ():
                if f"{key}.".startswith(f"{found}."):  # the finding, or an entry of it
                    return Item(path, found, _judged_by(ledger, [rule], found))
            known += [f"{rule}.{key}" for key in keys]
    close = _close(name, known)
    hint = f"did you mean {' or '.join(close)}?" if close else "expected a file, claim or finding"
    raise ValueError(f"no output, claim or finding is called {name!r}; {hint}")


def _close(name: str, known: Iterable[str]) -> list[str]:
    """Return the names that begin like this one, then those that resemble it."""
    names = sorted(set(known))
    begins = [other for other in names if name and other.startswith(name)]
    alike = difflib.get_close_matches(name, names, n=3, cutoff=0.5)
    return list(dict.fromkeys([*begins, *alike]))[:MOST_MATCHES]


def _judged_by(
    ledger: Iterable[Claim], rules: Iterable[str], key: str | None = None
) -> tuple[Claim, ...]:
    """Return the claims that a finding of these rules judges, or that this finding does."""
    return tuple(claim for claim in ledger if claim.rule in rules and key in (None, claim.finding))


def chain(
    item: Item, jobs: Sequence[Job], sums: Mapping[str, str], root: Path = Path()
) -> Iterator[str]:
    """Yield the lines from the requested item back to the inputs."""
    made = {path: job for job in jobs for path in job.outputs}
    for claim in item.claims:
        yield from _claim_lines(claim, item.path, root)
    if item.path is None:
        return
    if item.key and (root / item.path).exists():
        found = read_findings(root / item.path)[item.key].entries
        yield f"{item.key} = {json.dumps(found, ensure_ascii=False)}"
    if item.claims or item.key:
        yield ""
    waiting, printed = [item.path], set()
    while waiting:
        job = made[waiting.pop(0)]
        if (alike := (job.rule, job.scripts, job.inputs)) not in printed:  # no other shard
            if printed:
                yield ""
            printed.add(alike)
            yield from _job_lines(job, made, sums, root)
            waiting += [path for path in job.inputs if path in made]


def _claim_lines(claim: Claim, path: str | None, root: Path) -> Iterator[str]:
    yield f"claim {claim.id}: {claim.statement}"
    yield f"  paper     {claim.where}"
    if claim.ledger and (row := _row(claim)):
        yield f"  ledger    {row}"
    if claim.function:
        yield f"  function  {_cited(claim.function)}"
    for place in citing(claim.equation, ROOT) if claim.equation else ():
        yield f"  cited by  {place}"
    if path is None or (root / path).exists():
        finding = finding_of(claim, read_findings(root / path)) if path else None
        yield f"  verdict   {verdict_line(claim, finding, verdict_on(claim, finding))}"


def _row(claim: Claim) -> str:
    """Return the file and line of a claim's row."""
    lines = (ROOT / claim.ledger).read_text(encoding="utf-8").splitlines()
    start = re.compile(rf"- id: {re.escape(claim.id)}\b")
    return next((f"{claim.ledger}:{n}" for n, line in enumerate(lines, 1) if start.match(line)), "")


def _job_lines(
    job: Job, made: Mapping[str, Job], sums: Mapping[str, str], root: Path
) -> Iterator[str]:
    """Yield what a job made and how; what is missing or changed since the run is named."""
    yield from (_file(path, sums, root) for path in job.outputs)
    yield f"  rule      {job.rule}, {job.place}"
    for script in job.scripts:
        yield f"  script    {_file(script, sums, root)}"
        for name in library_names(root / script) if script.endswith(".py") else ():
            yield f"  function  {_cited(name)}"
    sources = {path: made[path].rule if path in made else "" for path in job.inputs}
    for rule in sorted({*sources.values()}, key=lambda rule: (rule == "", rule)):
        paths = [path for path in sources if sources[path] == rule]
        if rule and len(paths) > MOST_INPUTS:
            paths = [f"{paths[0]} and {len(paths) - 1} more"]
        for path in paths:
            yield f"  input     {f'{path}  from rule {rule}' if rule else _file(path, sums, root)}"


def _file(path: str, sums: Mapping[str, str], root: Path) -> str:
    """Return a path, and whether the file has the bytes that it had in the run."""
    if not (root / path).is_file():
        return f"{path}  MISSING"
    now, then = checksum(root / path), sums.get(path, "")
    changed = f"  CHANGED: it was {then[:16]} in the run" if then and then != now else ""
    return f"{path}  sha256 {now[:16]}{changed}"


def _cited(name: str) -> str:
    citation = cite(name, ROOT)
    equations = f"  {printed_list(citation.reached)}" if citation.reached else ""
    return f"{name}  {citation.place}{equations}"


if __name__ == "__main__":
    if len(sys.argv) != 2 or not sys.argv[1]:
        sys.exit(
            "expected one item, an output, claim or finding: make trace ITEM=figures/curve.svg"
        )
    sys.stdout.reconfigure(errors="replace")  # a terminal may know no Greek letters
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `| head` may stop reading
    try:
        ledgers = map(ledger_of, [PAPER, *read_yaml(config_of(PAPER))["studies"]])
        rows = read_ledger(map(Path, ledgers))
        jobs, sums = read_jobs()
        lines = list(chain(find(sys.argv[1], jobs, rows), jobs, sums))
    except (OSError, ValueError) as fault:  # of the config and the folder, too
        sys.exit(str(fault))
    print("\n".join(lines))
