"""Read claims: the types of their keys, and what is said of a mistake."""

import re
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import StrictInt, ValidationError

from replication.config import read_yaml
from replication.numbers import inputs, print_rounding, without_marks
from replication.sections import Number, Positive, Section

Verdict = Literal["confirmed", "qualified", "refuted", "supported", "by definition", "not tested"]

LARGEST_RELATIVE_TOLERANCE = 0.1
"""A tolerance is at most this share of the printed value, or the rounding of its last digit."""

BRACES = re.compile(r"\{\w+(?:\[[\w.]+\])*(?::[^{}]*)?\}")
"""A number of the config in a text; any other brace is text."""


class Entry(Section):
    """A claim as in its file; the head of paper/claims.yaml explains the keys."""

    id: str
    where: str
    statement: str
    printed: StrictInt | Number | str | None = None
    unit: str = ""
    tolerance: Positive | None = None
    rule: str = ""
    finding: str = ""
    expected: Verdict
    differs: str = ""
    remark: str = ""


class Claim(Entry):
    """A claim of a list, `part`: paper or ours.

    `marked` has statement and remark with the marks of their numbers.
    """

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
        names a key that the config lacks; when its tolerance is too wide, or its verdict unknown.
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
            fault = tolerance_fault(claim)
            if claim.id in [each.id for each in claims]:
                fault = "the id is there twice"
            is_judged = claim.expected not in ("by definition", "not tested")
            if bool(claim.rule and claim.finding) != is_judged:
                fault = (
                    "a claim names a rule and a finding, unless it is by definition or not tested"
                )
            if fault:
                raise SystemExit(f"{path}: claim {claim.id}: {fault}")
            claims.append(claim)
    return claims


def tolerance_fault(claim: Claim) -> str:
    """Return why the tolerance of a claim is too wide for its verdict to mean anything, or "".

    A value that is off by a whole unit of the last printed digit, twice what rounding allows, has
    to fail.
    """
    if claim.tolerance is None:
        return ""
    printed, tolerance = claim.printed, claim.tolerance
    if not isinstance(printed, int | float):
        return f"printed is {printed!r}; expected a number, since there is a tolerance"
    rounding = print_rounding(printed)
    widest = max(LARGEST_RELATIVE_TOLERANCE * abs(printed), rounding)
    if tolerance > widest:
        return f"tolerance is {tolerance:g}; expected at most {widest:g}, a tenth of {printed:g}"
    if tolerance >= 2.0 * rounding:
        return f"tolerance is {tolerance:g}; expected less than {2.0 * rounding:g}"
    return ""
