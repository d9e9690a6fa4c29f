"""Who reads a finding: a row of a ledger, a document, a page, or a check of our own.

A reader names what it takes in its source: `found("rule").name` in Typst, or a name given to
`found("rule")` in its folder and then `.name`; `results.finding("rule", "name")` in Python; rows
and checks by their names.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import PurePosixPath

from replication.judging.claim import Claim

Name = tuple[str, str]
"""A rule, and a finding of it."""

TAKEN = re.compile(r'\bfound\("(\w+)"\)(?:\.at\("([^"]+)"\)|\.(\w+))')
BOUND = re.compile(r'\blet ([\w-]+) = found\("(\w+)"\)(?![.\w])')
COMPUTED = re.compile(r'\bfound\((?!"\w+"\)|rule\))')
IN_PYTHON = re.compile(r'\bfinding\(\s*"(\w+)",\s*"([\w.]+)"\s*\)')


def in_typst(text: str, bound: Iterable[Name]) -> Iterator[Name]:
    """Yield the findings that a Typst source takes; `bound` has names, and the rule of each.

    Raises
    ------
    ValueError
        If the name of a rule is not there as it is: what is taken is then not known.
    """
    if found := COMPUTED.search(text):
        line = text[found.start() :].split("\n")[0]
        raise ValueError(f'{line!r} computes the name of a rule; expected found("rule")')
    for rule, quoted, plain in TAKEN.findall(text):
        yield rule, quoted or plain
    for name, rule in bound:
        of = re.escape(name)
        takes = rf'(?<![\w.-]){of}(?:\.at\("([^"]+)"\)|\.(\w+))|"([^"]+)" in {of}(?![\w-])'
        for quoted, plain, asked in re.findall(takes, text):
            yield rule, quoted or plain or asked


def having_readers(
    claims: Iterable[Claim], checks: Mapping[str, Iterable[str]], sources: Mapping[str, str]
) -> set[Name]:
    """Return the findings that have a reader.

    Parameters
    ----------
    claims
        Rows of all ledgers.
    checks
        The findings of each rule that have to hold though no row says so.
    sources
        The texts of Typst and Python sources by their paths.
    """
    found = {(claim.rule, claim.finding) for claim in claims if claim.finding}
    found |= {(rule, name) for rule, names in checks.items() for name in names}
    bound: dict[PurePosixPath, set[Name]] = {}
    for path, text in sources.items():
        bound.setdefault(PurePosixPath(path).parent, set()).update(BOUND.findall(text))
    for path, text in sources.items():
        in_folder = bound[PurePosixPath(path).parent]
        found |= {
            *(in_typst(text, in_folder) if path.endswith(".typ") else IN_PYTHON.findall(text))
        }
    return found
