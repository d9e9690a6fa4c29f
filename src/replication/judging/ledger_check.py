"""Check the ledger before any computation; the messages say how to correct it."""

import difflib
from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from jsonschema import Draft202012Validator, ValidationError

from replication.inputs.configuration import messages_of
from replication.inputs.strict_yaml import read_yaml
from replication.inputs.suggestions import hint
from replication.judging.calls import definition
from replication.judging.claim import Claim
from replication.judging.findings import Findings, findings_by_rule
from replication.judging.ledger import read_rows
from replication.judging.verdicts import tolerance_fault

SCHEMA = "src/replication/judging/claims.schema.yaml"
PUBLISHED = "tests/reference/findings"


def check_ledger(
    paths: Iterable[str | Path], rules: Collection[str], root: str | Path = "."
) -> None:
    """Refuse ledgers, the paper's first, that break their schema, or name what does not exist.

    `rules` make findings; schema, sources and published findings lie below `root`.

    Raises
    ------
    ValueError
        With one line for each fault: the file, the id of the row, and what was expected.
    """
    root = Path(root)
    schema = read_yaml(root / SCHEMA)
    validator = Draft202012Validator(schema["items"])
    published = findings_by_rule(sorted((root / PUBLISHED).glob("*.json")))
    faults = [
        f"{path}: {row['id']}: {fault}"
        for path, _, row in read_rows(paths)
        for fault in _faults(row, path, validator, rules, published, root)
    ]
    if faults:
        raise ValueError("\n".join(faults))


def _faults(
    row: Mapping[str, Any],
    ledger: Path,
    validator: Draft202012Validator,
    rules: Collection[str],
    published: Mapping[str, Findings],
    root: Path,
) -> Iterator[str]:
    errors = list(validator.iter_errors(row))
    # Faults that follow from a misspelt verdict are not reported.
    first = [error for error in errors if "allOf" not in error.schema_path] or errors
    if broken := {message for error in first for message in _in_words(error, validator.schema)}:
        yield from sorted(broken)
        return
    claim = Claim.of(row, ledger)
    if fault := tolerance_fault(claim):
        yield fault
    if not claim.rule:
        return
    if claim.rule not in rules:
        made = f'findings="results/findings/{claim.rule}.json"'
        known = hint(claim.rule, rules)
        yield f"rule is {claim.rule!r}, and no rule has the output {made}; {known}"
        return
    try:
        definition(claim.function, root)
    except ValueError as error:
        yield f"function: {error}"
    known = published[claim.rule].by_name if claim.rule in published else {}
    if claim.finding in known:
        return
    close = difflib.get_close_matches(claim.finding, sorted(known), n=1)
    # What resembles a published finding is misspelt, unless a source has it; then it is new.
    if close and not _is_written(claim.finding, root):
        yield (
            f"finding is {claim.finding!r}, which rule {claim.rule} has not published and no "
            f"source spells; did you mean {close[0]!r}?"
        )


def _in_words(error: ValidationError, schema: Mapping[str, Any]) -> Iterator[str]:
    if error.validator is None:  # a key that some other key forbids
        clause = schema["allOf"][error.schema_path[1]]
        yield f"the row breaks a rule of the ledger: {clause['description']}"
        return
    yield from (message.replace("the top level", "the row") for message in messages_of(error))


def _is_written(name: str, root: Path) -> bool:
    sources = [*(root / "src").rglob("*.py"), *(root / "studies").rglob("*.py")]
    return any(f'"{name}"' in path.read_text(encoding="utf-8") for path in sources)
