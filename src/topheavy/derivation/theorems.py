"""The proofs, gathered: what the derived results imply, and where the paper's statements end."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass

from topheavy.derivation import contact_proofs, fixed_proofs, impact_proofs, motion_proofs


@dataclass(frozen=True)
class Theorem:
    """A statement about column and frame, and whether the algebra bears it out."""

    id: str
    statement: str
    holds: bool


def theorems() -> list[Theorem]:
    """Prove anew what concerns the motion; name and docstring of each proof are the theorem's."""
    return _prove(*motion_proofs.PROOFS, *impact_proofs.PROOFS, *fixed_proofs.PROOFS)


def contact_theorems() -> list[Theorem]:
    """Prove anew what concerns the contact forces, which the paper leaves out."""
    return _prove(*contact_proofs.PROOFS)


def _prove(*proofs: Callable[[], bool]) -> list[Theorem]:
    return [Theorem(proof.__name__, inspect.getdoc(proof) or "", proof()) for proof in proofs]
