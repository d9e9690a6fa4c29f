"""The findings that published tables determine, drawn from these tables by their own functions.

`redrawn.py` of a study, and `redrawn_paper` beside this module, name for each rule the function
`findings` of its step, which takes tables by their names, or the reason why there is none.
"""

import inspect
import math
from collections import ChainMap
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pandas as pd

from replication.workbench import Finding, Findings
from steps import redrawn_paper
from steps.redrawn_paper import OF_PAPER

DIGITS = {"rel_tol": 1e-6}  # of what is computed from tables of nine digits
DIGITS_OF_ERROR = {"rel_tol": 0.06}  # errors are published with two digits

ROOT = Path(__file__).resolve().parents[2]
Draw: TypeAlias = Callable[..., Mapping[str, Finding | Mapping[str, Any]]]
"""Takes tables by their names; returns findings, or only those of their entries that it draws."""

NAMED_BY = [
    redrawn_paper,
    *(
        import_module(f"studies.{path.parent.name}.redrawn")
        for path in sorted(ROOT.glob("studies/*/redrawn.py"))
    ),
]
SOURCES: dict[str, Draw] = {
    rule: draw for named in NAMED_BY for rule, draw in named.SOURCES.items()
}
"""What draws findings from published tables, by the name of the rule that made them."""

BY_HAND = {source.__name__: source for source in OF_PAPER}
"""Second formulas for the findings of rules whose steps have no such function yet."""

UNDRAWN: dict[str, str] = dict(ChainMap(*(named.UNDRAWN for named in NAMED_BY)))
"""Why no published table determines the findings of the other rules."""


def departures(folder: Path, findings: Mapping[str, Findings]) -> Iterator[str]:
    """Yield the findings that depart from their tables."""

    for rule in unlisted(findings, published_studies(folder))[0]:
        yield (
            f"findings/{rule}.json: nothing draws these findings from a table; expected {rule} in "
            "SOURCES, or the reason in UNDRAWN, of src/steps/redrawn_paper.py or of redrawn.py in "
            "the folder of the study"
        )
    for rule in sorted({*SOURCES, *BY_HAND} & findings.keys()):
        for name, key, expected in entries(rule, folder):
            finding = findings[rule].by_name.get(name)
            found = finding.entries.get(key) if finding else None
            if not same(found, expected, DIGITS_OF_ERROR if key == "error" else DIGITS):
                yield (
                    f"findings/{rule}.json: {name}.{key} is {found}, and {expected} by the "
                    "published table that it was drawn from"
                )


def entries(rule: str, folder: Path) -> Iterator[tuple[str, str, Any]]:
    """Yield each entry that is drawn from the published tables, with its finding and its name.

    The parameters of the function that draws it are names of tables.
    """
    if rule in BY_HAND:
        yield from BY_HAND[rule](lambda name: pd.read_csv(folder / f"{name}.csv"))
        return
    draw = SOURCES[rule]
    tables = [_read(folder, name) for name in inspect.signature(draw).parameters]
    for name, finding in draw(*tables).items():
        drawn = finding.entries if isinstance(finding, Finding) else finding
        for key, entry in drawn.items():
            yield name, key, entry


def _read(folder: Path, name: str) -> pd.DataFrame:
    """Read a published table as the step had it, of the paper or of a study."""
    own = folder / f"{name}.csv"
    table = pd.read_csv(own if own.is_file() else folder / "studies" / own.name)
    for column in table:
        if (table[column] == "infinite").any():  # γ, else a number
            table[column] = [one if one == "infinite" else float(one) for one in table[column]]
    return table


def published_studies(folder: Path) -> list[str]:
    """Return the names of the studies of the published edition, each of which has its config."""
    return sorted(path.stem for path in folder.glob("studies/*.yaml"))


def unlisted(rules: Iterable[str], studies: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the rules of which neither SOURCES nor UNDRAWN has an entry.

    First those of the paper and of studies that these lists know, of which nothing may be missing;
    then those of other studies, which need no entry to be published.
    """
    listed = {*SOURCES, *BY_HAND, *UNDRAWN}
    heads = [f"{study}_" for study in studies]
    new = tuple(head for head in heads if not any(name.startswith(head) for name in listed))
    missing = sorted({*rules} - listed)
    others = [rule for rule in missing if rule.startswith(new)]
    return [rule for rule in missing if rule not in others], others


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
