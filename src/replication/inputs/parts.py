"""The parts of a work: the paper itself, and each study that follows it."""

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from replication.inputs.strict_yaml import read_yaml

PAPER = ""
"""The name of the part that is the paper."""

TEXTS = ("section.typ", "article.typ")
"""What a study writes: its section of the supplement, and its parts of the article, if any."""


@dataclass(frozen=True)
class Part:
    """A part of the work: its folder, its config, and its figures."""

    name: str  # PAPER, or that of a study
    config: Mapping[str, Any]  # the numbers of its rules
    data: list[str] = field(default_factory=list)  # what its notebooks read, but for code

    @property
    def claims(self) -> str:
        """Its ledger."""
        return ledger_of(self.name)

    @property
    def captions(self) -> str:
        """The captions of its figures."""
        return captions_of(self.name)

    @property
    def figures(self) -> dict[str, list[str]]:
        """Its figures, named by their scripts without the ending: the tables that each draws."""
        folder = Path("figures") if self.name == PAPER else Path("studies", self.name, "figures")
        drawn = {path.with_suffix("").as_posix(): tables_of(path) for path in folder.glob("*.py")}
        return {name: drawn[name] for name in sorted(drawn) if drawn[name]}

    @property
    def sections(self) -> list[str]:
        """Its section of the supplement, and what it adds to the article; none for the paper."""
        if self.name == PAPER:
            return []
        folder = Path("studies", self.name)
        return [f"{folder.as_posix()}/{name}" for name in TEXTS if (folder / name).is_file()]


@dataclass(frozen=True)
class Edition:
    """What a study adds to the published edition: tables of results/tables, pictures of docs."""

    tables: list[str] = field(default_factory=list)  # from which its findings follow
    pictures: dict[str, str] = field(default_factory=dict)  # figures in its folder, by their names


def edition_of(study: str, root: Path = Path()) -> Edition:
    """Return what a study adds to the published edition, by its edition.yaml; nothing without one.

    Raises
    ------
    ValueError
        For a key that means nothing, or an entry that is not as `Edition` says.
    """
    path = root / "studies" / study / "edition.yaml"
    if not path.is_file():
        return Edition()
    entries = read_yaml(path)
    kinds = {"tables": list, "pictures": dict}
    for key, entry in entries.items():
        if not isinstance(entry, kinds.get(key, ())):
            raise ValueError(
                f"studies/{study}/edition.yaml: {key} is {entry!r}; expected tables, a list of "
                "names in results/tables/, or pictures, files in its folder by their names in docs/"
            )
    return Edition(**entries)


def tables_of(script: Path) -> list[str]:
    """Return the tables that a figure is drawn from: the parameters of its function `draw`.

    A module without that function is no figure, and draws from none.
    """
    for node in ast.parse(script.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and node.name == "draw":
            return [each.arg for each in node.args.args]
    return []


def ledger_of(part: str) -> str:
    """Return the path of the ledger of a part, by its name."""
    return "paper/claims.yaml" if part == PAPER else f"studies/{part}/claims.yaml"


def captions_of(part: str) -> str:
    """Return the path of the captions of a part, by its name."""
    return "figures/captions.yaml" if part == PAPER else f"studies/{part}/captions.yaml"


def config_of(part: str) -> str:
    """Return the path of the config of a part, by its name."""
    return "config/config.yaml" if part == PAPER else f"studies/{part}/config.yaml"
