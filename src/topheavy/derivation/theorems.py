"""The proofs, gathered: what the derived results imply, and where the paper's statements end."""

from __future__ import annotations

import inspect
from dataclasses import dataclass

from topheavy.derivation import impact_proofs, motion_proofs


@dataclass(frozen=True)
class Theorem:
    """A statement about column and frame, and whether the algebra bears it out."""

    id: str
    statement: str
    holds: bool


def theorems() -> list[Theorem]:
    """Prove everything anew; the name and docstring of each proof are the theorem's."""
    return [
        Theorem(proof.__name__, inspect.getdoc(proof) or "", proof())
        for proof in (*motion_proofs.PROOFS, *impact_proofs.PROOFS)
    ]
