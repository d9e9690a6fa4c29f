"""Collect the proofs of what the derived results imply."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from topheavy.derivation import contact_proofs, fixed_proofs, impact_proofs, motion_proofs


@dataclass(frozen=True)
class Theorem:
    """A statement about column and frame, and whether the algebra proves it."""

    id: str
    statement: str
    holds: bool


@cache
def theorems() -> tuple[Theorem, ...]:
    """Prove the theorems on the motion, once in a process; the docstring of a proof states it."""
    return _prove(*motion_proofs.PROOFS, *impact_proofs.PROOFS, *fixed_proofs.PROOFS)


@cache
def contact_theorems() -> tuple[Theorem, ...]:
    """Prove the theorems on the contact forces, which the paper omits."""
    return _prove(*contact_proofs.PROOFS)


def _prove(*proofs: Callable[[], bool]) -> tuple[Theorem, ...]:
    return tuple(Theorem(proof.__name__, inspect.getdoc(proof) or "", proof()) for proof in proofs)
