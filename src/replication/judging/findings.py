"""The findings of a rule: numbers with their errors, and truths, by which claims are judged."""

import difflib
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from pathlib import Path
from typing import Any

CALLED = "called"
"""The entry beside the findings of a rule that lists the functions which made them."""

NOT_TESTED = "not_tested"
"""The entry in place of the findings of a rule that lacks an optional package: the reason."""

LIKE_A_FIELD = 0.85
"""Evidence whose name resembles a field of a finding this much is a misspelt field."""


@dataclass(frozen=True)
class Finding:
    """The result of a rule for a claim: a number, a truth, or the reason why there is neither.

    Of a printed number that differs from the value, `meant_value` is the number that misprinted
    premises give as they are meant; or the number that should be printed, by the paper's premises.
    """

    value: float | None = None
    error: float | None = None  # an estimate
    unit: str = ""
    holds: bool | None = None  # whether a statement is true
    meant_value: float | None = None
    meant_holds: bool | None = None  # where it does not hold: whether its intended form does
    kind: str | None = None  # of the discrepancy, one of verdicts.KINDS; of a number, "number"
    holds_when: bool | None = None  # whether it holds on the condition in the evidence
    not_tested: str = ""  # the reason why nothing was computed
    entries: Mapping[str, Any] = field(default_factory=dict, repr=False)  # all given, and evidence

    @classmethod
    def of(cls, entries: Mapping[str, Any]) -> "Finding":
        """Return the finding with these entries, the fields and the evidence.

        Raises
        ------
        ValueError
            When there is no number with its error, no truth, and no reason; or more than one of
            them; or when the name of an entry resembles a field.
        """
        names = [each.name for each in fields(cls) if each.name != "entries"]
        for name in entries:
            if name not in names and (close := _resembled(name, *names)):
                raise ValueError(f"a finding has {name!r}; did you mean {close}?")
        kinds = [name for name in ("value", "holds", NOT_TESTED) if name in entries]
        if len(kinds) != 1 or ("value" in entries and "error" not in entries):
            raise ValueError(
                f"a finding has {', '.join(entries) or 'no entry'}; expected either 'value' and "
                f"'error', or 'holds', or {NOT_TESTED!r}"
            )
        own = {name: entries[name] for name in names if name in entries}
        return cls(**own, entries=dict(entries))

    def with_evidence(self, **evidence: Any) -> "Finding":
        """Return the finding with more evidence, after the entries that it has."""
        return Finding.of({**self.entries, **evidence})

    def __getitem__(self, name: str) -> Any:
        """Return an entry by its name in the JSON file, such as one of the evidence."""
        return self.entries[name]


@dataclass(frozen=True)
class Findings:
    """All findings of one rule, by name, and the functions that were called to make them.

    A rule that lacks an optional package has only the reason, `not_tested`.
    """

    by_name: Mapping[str, Finding]
    called: tuple[str, ...] = ()
    not_tested: str = ""

    @classmethod
    def of(cls, content: Mapping[str, Any]) -> "Findings":
        """Return the findings of a JSON file, or of a step that has just made them.

        Raises
        ------
        ValueError
            When an entry is no finding, or a finding has the name CALLED; the message names it.
        """
        called = content.get(CALLED, [])
        if not isinstance(called, list):
            raise ValueError(
                f"a finding is called {CALLED!r}, the name of the list of functions that ran; "
                "expected another name"
            )
        found, reason = {}, content.get(NOT_TESTED, "")
        for name, entries in content.items():
            if name not in (CALLED, NOT_TESTED):
                found[name] = entries if isinstance(entries, Finding) else _named(name, entries)
        return cls(found, tuple(called), reason)

    def as_json(self) -> dict[str, Any]:
        """Return the content of the JSON file."""
        reason = {NOT_TESTED: self.not_tested} if self.not_tested else {}
        found = {name: dict(finding.entries) for name, finding in self.by_name.items()}
        return reason | found | {CALLED: list(self.called)}

    def __getitem__(self, name: str) -> Finding:
        return self.by_name[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.by_name)


@cache
def _resembled(name: str, *fields: str) -> str:
    """Return the field that the name of an evidence resembles, quoted, or nothing."""
    close = difflib.get_close_matches(name, fields, n=1, cutoff=LIKE_A_FIELD)
    return repr(close[0]) if close else ""


def _named(name: str, entries: Any) -> Finding:
    if not isinstance(entries, Mapping):
        raise ValueError(f"the finding {name!r} is {entries!r}; expected value() or truth()")
    try:
        return Finding.of(entries)
    except ValueError as fault:
        raise ValueError(f"the finding {name!r}: {fault}") from None


def read_findings(path: str | Path) -> Findings:
    """Read the findings of one rule.

    Raises
    ------
    ValueError
        When an entry is no finding; the message names the file.
    """
    try:
        return Findings.of(json.loads(Path(path).read_text(encoding="utf-8")))
    except ValueError as fault:
        raise ValueError(f"{path}: {fault}") from None


def findings_by_rule(paths: Iterable[str | Path]) -> dict[str, Findings]:
    """Read the findings of several rules; a file has the name of its rule."""
    return {Path(path).stem: read_findings(path) for path in paths}


def write_findings(path: str | Path, findings: Findings) -> None:
    """Write the findings of one rule as JSON."""
    text = json.dumps(findings.as_json(), indent=2, ensure_ascii=False, allow_nan=False)
    Path(path).write_text(text + "\n", encoding="utf-8")
