"""What the headlines of the paper and of its studies share: numbers of the published edition."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import pandas as pd

from replication.inputs.strict_yaml import read_yaml

Numbers: TypeAlias = Callable[[Path], list[str]]
"""Takes tests/reference; returns decimal numbers as the README states them, in their order."""


def config_of(reference: Path, study: str) -> dict[str, Any]:
    """Return the config of a study in the published run."""
    return read_yaml(reference / "studies" / f"{study}.yaml")


def from_to(shares: pd.Series, digits: int = 0) -> str:
    """Return the range of shares in words, in per cent: "17 to 23"."""
    return f"{100 * shares.min():.{digits}f} to {100 * shares.max():.{digits}f}"


def computed(reference: Path) -> dict[str, float]:
    """Return the computed value of each published claim, by its id."""
    rows = json.loads((reference / "claims.json").read_text(encoding="utf-8"))
    return {row["id"]: row["computed"] for row in rows}
