"""Read claims: the types of their keys, and what is said of a mistake."""

import re
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import StrictInt, ValidationError

from replication.config import read_yaml
from replication.digits import print_rounding
from replication.marks import inputs, without_marks
from replication.sections import Number, Section

Verdict = Literal["confirmed", "qualified", "refuted", "supported", "by definition", "not tested"]

BRACES = re.compile(r"\{\w+(?:\[[\w.]+\])*(?::[^{}]*)?\}")
"""A number of the config in a text; any other brace is text."""


class Entry(Section):
    """A claim as in its file; the head of paper/claims.yaml explains the keys."""

    id: str
    where: str
    statement: str
    printed: StrictInt | Number | str | None = None
    unit: str = ""
    finding: str = ""
    expected: Verdict = "confirmed"
    differs: str = ""
    remark: str = ""


class Claim(Entry):
    """A claim of a list, `part`: paper or ours; the rule of its finding, apart from its name.

    `marked` has statement and remark with the marks of their numbers. The `tolerance` of a printed
    number that is judged is half a unit of its last digit.
    """

    rule: str = ""
    tolerance: float | None = None
    marked: dict[str, str] | None = None
    part: str = ""
    file: str = ""


def read_claims(path: str, settings: Mapping[str, Any]) -> list[Claim]:
    """Return the claims of a file; {keys} in statement and remark are filled from its config.

    The file has two lists, `paper` and `ours`.

    Raises
    ------
    SystemExit
        When a claim has an unknown key, lacks one, or has the id of another; when its statement
        names a key that the config lacks; or when its verdict is unknown.
    """
    content = read_yaml(path)
    known = inputs(settings)
    claims: list[Claim] = []
    for part, rows in content.items():
        if not isinstance(rows, list):
            raise SystemExit(f"{path} has {rows!r:.40}; expected a list of claims")
        for number, row in enumerate(rows, 1):
            name = row.get("id") if isinstance(row, dict) else f"number {number} of {part}"
            try:
                claim = Claim(**Entry.model_validate(row).model_dump(), part=part, file=path)
                claim.marked = {
                    name: BRACES.sub(lambda key: key[0].format(**known), getattr(claim, name))
                    for name in ("statement", "remark")
                }
                claim.statement, claim.remark = map(without_marks, claim.marked.values())
            except ValidationError as errors:
                faults = "; ".join(
                    f"'{'.'.join(map(str, e['loc']))}': {e['msg']}" for e in errors.errors()
                )
                raise SystemExit(f"{path}: claim {name}: {faults}") from None
            except (KeyError, IndexError) as key:
                raise SystemExit(
                    f"{path}: claim {name} has {{{key.args[0]}}}, which is no key of the "
                    f"config; expected one of {', '.join(settings)}"
                ) from None
            except (TypeError, ValueError) as error:
                raise SystemExit(f"{path}: claim {name}: {error}, in a number of braces") from None
            claim.rule, _, claim.finding = claim.finding.partition(".")
            is_judged = claim.expected not in ("by definition", "not tested")
            if is_judged and isinstance(claim.printed, int | float):
                claim.tolerance = print_rounding(claim.printed)
            if claim.id in [before.id for before in claims]:
                raise SystemExit(f"{path}: claim {claim.id}: the id is there twice")
            if bool(claim.rule and claim.finding) != is_judged:
                raise SystemExit(
                    f"{path}: claim {claim.id} has the finding '{row.get('finding', '')}'; "
                    "expected rule.name, and none if it is by definition or not tested"
                )
            claims.append(claim)
    return claims
