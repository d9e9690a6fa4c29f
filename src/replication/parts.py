"""The parts of a work: the paper itself, and each study that follows it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

PAPER = ""
"""The name of the part that is the paper."""


@dataclass(frozen=True)
class Part:
    """A part of the work: its folder, its config, its figures and its findings.

    Parameters
    ----------
    name
        PAPER, or that of a study.
    config
        The numbers of its rules.
    figures
        By figure, named by its script without the ending: the tables that it is drawn from.
    findings
        The rules whose findings the claims are judged by.
    data
        The files that its notebooks read, beside the code that they import.
    """

    name: str
    config: Mapping[str, Any]
    figures: dict[str, list[str]] = field(default_factory=dict)
    findings: list[str] = field(default_factory=list)
    data: list[str] = field(default_factory=list)

    @property
    def claims(self) -> str:
        """Its ledger."""
        return ledger_of(self.name)

    @property
    def captions(self) -> str:
        """The captions of its figures."""
        return captions_of(self.name)

    @property
    def sections(self) -> list[str]:
        """Its sections of the report; for the paper, the report itself."""
        return [] if self.name == PAPER else [f"studies/{self.name}/section.typ"]


def ledger_of(part: str) -> str:
    """Return the path of the ledger of a part, by its name."""
    return "paper/claims.yaml" if part == PAPER else f"studies/{part}/claims.yaml"


def captions_of(part: str) -> str:
    """Return the path of the captions of a part, by its name."""
    return "figures/captions.yaml" if part == PAPER else f"studies/{part}/captions.yaml"
