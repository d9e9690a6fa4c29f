"""Collect the proofs of what the derived results imply."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

from topheavy.derivation import (
    base_shear,
    contact_proofs,
    extension_proofs,
    fixed_proofs,
    impact_proofs,
    motion_proofs,
    plane_proofs,
    pulse_proofs,
    reversal_proofs,
)

_PROOFS = (
    *motion_proofs.PROOFS,
    *impact_proofs.PROOFS,
    *fixed_proofs.PROOFS,
    *base_shear.PROOFS,
)


@dataclass(frozen=True)
class Theorem:
    """A statement about column and frame, and whether the algebra proves it."""

    id: str
    statement: str
    holds: bool


@cache
def theorems() -> tuple[Theorem, ...]:
    """Prove the theorems on motion and base shear, once in a process; a docstring states each."""
    return _prove(*_PROOFS)


def stated() -> dict[str, str]:
    """Return what each of `theorems` states, by its name, without the proof."""
    return {proof.__name__: inspect.getdoc(proof) or "" for proof in _PROOFS}


@cache
def contact_theorems() -> tuple[Theorem, ...]:
    """Prove the theorems on the contact forces, which the paper omits."""
    return _prove(*contact_proofs.PROOFS)


@cache
def reversal_theorems() -> tuple[Theorem, ...]:
    """Prove the steps of "no reversal without an impact", which the paper does not state."""
    return _prove(*reversal_proofs.PROOFS)


@cache
def extension_theorems() -> tuple[Theorem, ...]:
    """Prove what a larger R̂ implies, N columns, vertical motion, and motion across the plane."""
    return _prove(*extension_proofs.PROOFS, *pulse_proofs.PROOFS, *plane_proofs.PROOFS)


def _prove(*proofs: Callable[[], bool]) -> tuple[Theorem, ...]:
    return tuple(Theorem(proof.__name__, inspect.getdoc(proof) or "", proof()) for proof in proofs)
