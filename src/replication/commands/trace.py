"""From a number, table, figure or claim back to the paper and the inputs: `make trace ITEM=…`.

The chain is Snakemake's: its jobs, and the records that it keeps of how they were run. Where it has
no records, as in an unpacked archive, the RO-Crate of the run has the checksums.
"""

import difflib
import hashlib
import json
import re
import signal
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from replication.judging.calls import LIBRARIES
from replication.judging.citations import cite, citing, library_names, printed_list
from replication.judging.claim import Claim
from replication.judging.findings import read_findings
from replication.judging.ledger import finding_of
from replication.judging.verdicts import verdict_on
from replication.origin.recorded import CRATE, Crate, read_crate
from replication.rules.one_claim import verdict_line
from replication.workflow.provenance import Job, checksum, makers, workflow_jobs

ROOT = Path(__file__).parents[3]
"""The root of the repository; printed paths are relative to it."""

NO_CRATE = Crate({}, {}, (), "")
"""Before the end of the first run."""

MOST_MATCHES = 6
"""So many names are suggested for one that is unknown."""

MOST_INPUTS = 4
"""So many inputs from one rule have a line each."""

CODE = (".py", ".pyi", ".smk")
MACHINE = "replication"


@dataclass(frozen=True)
class Item:
    """The requested file, with an optional finding in it and the claims judged by this finding."""

    path: str | None
    key: str | None = None
    claims: tuple[Claim, ...] = ()


def find(name: str, jobs: Sequence[Job], ledger: Sequence[Claim], root: Path = Path()) -> Item:
    """Return the item that a name denotes.

    It may be an output or the end of its path, a claim, or a finding: `curve.rises`, or with its
    file, `findings/curve.json:rises`.

    Raises
    ------
    ValueError
        When the name denotes no output, or several; the message lists similar names.
    """
    made = makers(jobs)
    findings = {Path(path).stem: path for job in jobs for path in job.findings}
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
        asked = place == rule or (place != "" and Path(path).match(place))
        if (root / path).exists():
            keys = read_findings(root / path)
            for found in keys if asked else ():
                if f"{key}.".startswith(f"{found}."):  # the finding, or an entry of it
                    return Item(path, found, _judged_by(ledger, [rule], found))
            known += [f"{rule}.{key}" for key in keys]
        elif asked:
            raise ValueError(f"{path} is not made yet; expected a finished run: make reproduce")
    close = _close(name, known)
    hint = f"did you mean {' or '.join(close)}?" if close else "expected a file, claim or finding"
    raise ValueError(f"no output, claim or finding is called {name!r}; {hint}")


def _close(name: str, known: Iterable[str]) -> list[str]:
    """Return the names that begin like this one, then those that resemble it."""
    names = sorted(set(known))
    begins = [other for other in names if name and other.startswith(name)]
    alike = difflib.get_close_matches(name, names, n=3, cutoff=0.5)
    return list(dict.fromkeys([*begins, *alike]))[:MOST_MATCHES]


def chain(
    item: Item, jobs: Sequence[Job], root: Path = Path(), crate: Crate = NO_CRATE
) -> Iterator[str]:
    """Yield the lines from the requested item back to the inputs."""
    made = makers(jobs)
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
        alike = (job.rule, job.scripts, job.inputs, job.made is None, job.pending)
        if alike in printed:  # another shard
            continue
        if printed:
            yield ""
        printed.add(alike)
        yield from _job_lines(job, made, root, crate)
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


def _job_lines(job: Job, made: Mapping[str, Job], root: Path, crate: Crate) -> Iterator[str]:
    """Yield what a job made and how: the code that is its own first, checksums in one line."""
    for path in job.outputs:
        yield f"{path}  {_digest(path, root)}"
    yield f"  rule      {job.rule}, {job.place}; {_state(job, crate)}"
    for script in job.scripts:
        yield f"  script    {script}"
    beside = [path for path in job.inputs if _is_own(path) and path not in job.scripts]
    for path in beside:
        yield f"  module    {path}"
    used = (name for path in (*job.scripts, *beside) for name in library_names(root / path))
    for name in dict.fromkeys(used):
        yield f"  function  {_cited(name)}"
    for name, value in job.params.items():
        yield f"  config    {name}: {json.dumps(value, ensure_ascii=False, default=str)}"
    yield from _input_lines(job, made)
    yield from _checksum_lines(job, made, root, crate)


def _is_own(path: str) -> bool:
    """Return whether an input is code that is neither of a library nor of the machine."""
    parts = Path(path).parts
    shared = parts[0] == "src" and parts[1] in (*LIBRARIES, MACHINE)
    return path.endswith(".py") and not shared and parts[-1] != "__init__.py"


def _input_lines(job: Job, made: Mapping[str, Job]) -> Iterator[str]:
    """Yield a line for each input that is no code; several of one rule share a line."""
    data = [path for path in dict.fromkeys(job.inputs) if not path.endswith(CODE)]
    sources = {path: made[path].rule if path in made else "" for path in data}
    for rule in sorted({*sources.values()}, key=lambda rule: (rule == "", rule)):
        paths = [path for path in data if sources[path] == rule]
        if rule and len(paths) > MOST_INPUTS:
            paths = [f"{paths[0]} and {len(paths) - 1} more"]
        for path in paths:
            yield f"  input     {path}{f'  from rule {rule}' if rule else ''}"


def _checksum_lines(job: Job, made: Mapping[str, Job], root: Path, crate: Crate) -> Iterator[str]:
    """Yield a line for each input that is lost or changed since the run, and one for all.

    What another rule makes has a line of its own, where this rule is shown.
    """
    recorded = crate.checksums if job.made is None else job.checksums
    there = {path: checksum(root / path) for path in job.inputs if (root / path).is_file()}
    for path in dict.fromkeys(job.inputs):
        if path not in there and path not in made:
            yield f"  MISSING   {path}"
        elif path in there and recorded.get(path, there[path]) != there[path]:
            before, now = recorded[path][:16], there[path][:16]
            yield f"  CHANGED   {path}  sha256 {now}; it was {before} in the run"
    if there:
        lines = "".join(f"{there[path]}  {path}\n" for path in sorted(there))
        same = sum(recorded.get(path) == found for path, found in there.items())
        yield (
            f"  sha256    {hashlib.sha256(lines.encode()).hexdigest()[:16]} of the sums of all "
            f"{len(there)} inputs; {same} of them are recorded, and as in the run"
        )


def _state(job: Job, crate: Crate) -> str:
    if job.made is None:
        listed = crate.rules.keys() & job.outputs
        return f"made in the run that {CRATE} lists" if listed else "not made yet"
    when = datetime.fromtimestamp(job.made).strftime("%Y-%m-%d %H:%M:%S")
    return f"made {when}, {'OUT OF DATE' if job.pending else 'up to date'}"


def _cited(name: str) -> str:
    citation = cite(name, ROOT)
    equations = f"  {printed_list(citation.reached)}" if citation.reached else ""
    return f"{name}  {citation.place}{equations}"


def _digest(path: str, root: Path) -> str:
    return f"sha256 {checksum(root / path)[:16]}" if (root / path).is_file() else "not there"


def _judged_by(
    ledger: Iterable[Claim], rules: Iterable[str], key: str | None = None
) -> tuple[Claim, ...]:
    """Return the claims that a finding of these rules judges, or that this finding does."""
    return tuple(claim for claim in ledger if claim.rule in rules and key in (None, claim.finding))


if __name__ == "__main__":
    if len(sys.argv) != 2 or not sys.argv[1]:
        sys.exit(
            "expected one item, an output, claim or finding: make trace ITEM=figures/curve.svg"
        )
    sys.stdout.reconfigure(errors="replace")  # a terminal may know no Greek letters
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `| head` may stop reading
    try:
        jobs = workflow_jobs()
        ledger = [job.params["claim"] for job in jobs if "claim" in job.params]
        crate = read_crate() if Path(CRATE).exists() else NO_CRATE
        lines = list(chain(find(sys.argv[1], jobs, ledger), jobs, crate=crate))
    except (OSError, ValueError) as fault:  # of the config and the folder, too
        sys.exit(str(fault))
    print("\n".join(lines))
