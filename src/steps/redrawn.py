"""The findings that published tables determine, drawn from these tables by their own functions.

The script of a rule has a function `findings`, whose parameters are names of tables; or UNDRAWN,
the reason why no published table determines its findings.
"""

import inspect
import math
import re
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, Findings

DIGITS = {"rel_tol": 1e-6}  # of what is computed from tables of nine digits
DIGITS_OF_ERROR = {"rel_tol": 0.06}  # errors are published with two digits

ROOT = Path(__file__).resolve().parents[2]


@cache
def scripts() -> dict[str, Path]:
    """Return the script of each rule that makes findings, by the name of their file."""
    found = {}
    for path in (ROOT / "Snakefile", *ROOT.glob("studies/*/*.smk")):
        for rule in re.split(r"(?m)^rule ", path.read_text(encoding="utf-8")):
            made = re.search(r'"results/findings/(\S+)\.json"', rule.split("\n    script:")[0])
            script = re.search(r'\n    script:\s*"(.+)"', rule)
            if made and script and "findings=" in rule:
                found[made[1]] = path.parent / script[1]
    return found


def step(rule: str) -> ModuleType | None:
    """Return the module of the script that made the findings of a rule, None if there is none.

    A rule may make several, whose names have a wildcard.
    """
    for made, script in sorted(scripts().items(), key=lambda item: "{" in item[0]):
        if match := re.fullmatch(re.sub(r"\{(\w+)\}", r"(?P<\1>\\w+)", made), rule):
            path = Path(str(script).format(wildcards=SimpleNamespace(**match.groupdict())))
            root = ROOT / "src" if path.is_relative_to(ROOT / "src") else ROOT
            if path.is_file():
                return import_module(".".join(path.relative_to(root).with_suffix("").parts))
    return None


def undrawn(rule: str) -> str | None:
    """Return why the findings of a rule are not drawn from tables; None, if they are.

    Raises
    ------
    LookupError
        When the script of the rule says neither.
    """
    made_by = step(rule)
    if hasattr(made_by, "findings"):
        return None
    if reason := getattr(made_by, "UNDRAWN", ""):
        return reason
    where = Path(made_by.__file__).relative_to(ROOT) if made_by else "the script of its rule"
    raise LookupError(
        f"findings/{rule}.json: nothing draws these findings from a table; expected in {where} a "
        "function findings, which takes tables by their names, or UNDRAWN, the reason"
    )


def departures(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the findings that depart from their tables."""
    for rule in sorted(findings):
        try:
            drawn = [] if undrawn(rule) else list(entries(rule, folder))
        except LookupError as fault:
            yield str(fault.args[0])
            continue
        for name, key, expected in drawn:
            finding = findings[rule].by_name.get(name)
            found = finding.entries.get(key) if finding else None
            if not same(found, expected, DIGITS_OF_ERROR if key == "error" else DIGITS):
                yield (
                    f"findings/{rule}.json: {name}.{key} is {found}, and {expected} by the "
                    "published table that it was drawn from"
                )


def entries(rule: str, folder: Path) -> Iterator[tuple[str, str, Any]]:
    """Yield each entry that is drawn from the published tables, with its finding and its name.

    Raises
    ------
    LookupError
        When the tables have not what the findings are drawn from.
    """
    draw = step(rule).findings
    names = list(inspect.signature(draw).parameters)
    tables = [_read(folder, name) for name in names]
    try:
        found = draw(*tables)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as fault:
        raise LookupError(
            f"findings/{rule}.json cannot be drawn from {', '.join(names)} (.csv): {fault!r}"
        ) from fault
    for name, finding in found.items():
        drawn = finding.entries if isinstance(finding, Finding) else finding
        for key, entry in drawn.items():
            yield name, key, entry


def _read(folder: Path, name: str) -> pd.DataFrame:
    """Read a published table as the step had it."""
    places = [folder / part / f"{name}.csv" for part in (".", "sources", "studies")]
    table = pd.read_csv(next(filter(Path.is_file, places), places[0]))
    for column in table:
        if (table[column] == "infinite").any():  # γ, else a number
            table[column] = [one if one == "infinite" else float(one) for one in table[column]]
    return table


def same(found: Any, expected: Any, digits: Mapping[str, float]) -> bool:
    """Whether a finding's entry is the expected one; of a mapping, the keys that are expected."""
    if expected is None:
        return found is None
    if isinstance(expected, Mapping):
        return isinstance(found, Mapping) and all(
            same(found.get(key), value, digits) for key, value in expected.items()
        )
    if isinstance(expected, list | tuple):
        return (
            isinstance(found, list)
            and len(found) == len(expected)
            and all(same(one, other, digits) for one, other in zip(found, expected, strict=True))
        )
    if isinstance(expected, bool | np.bool_ | str):
        return type(found) in (bool, str) and found == expected
    is_number = isinstance(found, int | float) and not isinstance(found, bool)
    return is_number and math.isclose(found, expected, **digits)
