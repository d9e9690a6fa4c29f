"""What the headlines of the paper and of its studies read: the published edition."""

import json
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from decimal import ROUND_HALF_UP, Decimal
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

import pandas as pd

from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_judged

FAMILIES = ("near-fault", "broadband")
"""Of the synthetic motions, in the order in which their numbers stand."""

WORDS = {2: "two", 3: "three", 4: "four", 5: "five"}


@dataclass(frozen=True)
class Published:
    """The published results in tests/reference."""

    folder: Path

    def finding(self, rule: str, name: str) -> dict[str, Any]:
        """Return a finding of a rule."""
        path = self.folder / "findings" / f"{rule}.json"
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))[name]
        return found

    def table(self, name: str) -> pd.DataFrame:
        """Return a table, whose name begins with the folder that it is in."""
        return pd.read_csv(self.folder / f"{name}.csv")

    @cached_property
    def config(self) -> dict[str, Any]:
        """The config of the published run."""
        return read_yaml(self.folder / "config.yaml")

    def config_of(self, study: str) -> dict[str, Any]:
        """Return the config of a study."""
        return read_yaml(self.folder / "studies" / f"{study}.yaml")

    @cached_property
    def claims(self) -> dict[str, dict[str, Any]]:
        """The judged claims, by their id."""
        return {row.id: asdict(row) for row in read_judged(self.folder / "claims.json")}

    def counts(self) -> Counter[str]:
        """Return how many claims of the paper have each verdict."""
        return Counter(row["verdict"] for row in self.claims.values() if not row["study"])

    def need(self, **verdicts: str) -> None:
        """Raise ValueError unless the claims have these verdicts, on which a sentence rests."""
        for claim, verdict in verdicts.items():
            need(
                self.claims[claim]["verdict"] == verdict,
                f"the claim {claim} is {self.claims[claim]['verdict']} and not {verdict}",
            )


Passage: TypeAlias = Callable[[Published], str]
"""Returns what a passage says, in Markdown."""


def need(condition: bool, otherwise: str) -> None:
    """Raise ValueError where a published result no longer bears the words of a headline."""
    if not condition:
        raise ValueError(f"{otherwise}: rewrite the headline that rests on it (headlines.py)")


def rounded(value: float, digits: int) -> str:
    """Return a number with so many decimals, halves away from zero as in the article."""
    whole = Decimal(repr(round(float(value), 9)))
    return str(whole.quantize(Decimal(1).scaleb(-digits), ROUND_HALF_UP))


def span(values: Iterable[float], digits: int = 0, factor: float = 100.0) -> str:
    """Return the range of shares in per cent, or of numbers with a factor of 1: "17 to 23"."""
    numbers = [rounded(factor * value, digits) for value in values]
    ends = min(numbers, key=float), max(numbers, key=float)
    return " to ".join(ends if ends[0] != ends[1] else ends[:1])


def both(values: Iterable[float], digits: int = 0, factor: float = 100.0) -> str:
    """Return the numbers of both families, in per cent or with a factor of 1: "2.4 and 3.5"."""
    return " and ".join(rounded(factor * value, digits) for value in values)


def with_interval(row: Any, name: str, digits: int = 1, factor: float = 100.0) -> str:
    """Return a number with its interval: "8.5 (8.2 to 9.2)"."""
    ends = (rounded(factor * row[f"{name}_{end}"], digits) for end in ("low", "high"))
    return f"{rounded(factor * row[name], digits)} ({' to '.join(ends)})"
