"""A quantity that an assumption can affect: a number, and the verdict on its claim."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from replication.workbench import Finding
from steps.assumptions.choices import Choices

Sections: TypeAlias = dict[str, Any]
"""The sections of the config, by name, and the records."""


class Answer(NamedTuple):
    """A quantity's number, and the finding by which its claim is judged."""

    number: float
    finding: Finding


class Quantity(NamedTuple):
    """Its claim in the ledger if it has one, its unit, and what computes it."""

    claim: str | None
    unit: str
    find: Callable[[Choices, Sections], Answer]
