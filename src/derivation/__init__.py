"""The paper's derivation by computer algebra, and a test of every equation as it is printed.

mechanics  geometry, balances, energies and impulses of a cap beam on N columns  ─►  θ̈, √r, R̂/R
printed    the equations in our copy of the paper, what each follows from, and whether it does
consequences, fixed_mass, extensions, colonnades, reversals, guarantee  ─►  theorems
"""

from __future__ import annotations

import inspect
from typing import NamedTuple

from derivation import colonnades, consequences, extensions, fixed_mass, guarantee, reversals
from derivation.printed import PrintedCheck, check_printed

__all__ = ["PrintedCheck", "Theorem", "check_printed", "theorems"]

MODULES = {
    consequences: "paper",
    fixed_mass: "paper",
    extensions: "extensions",
    colonnades: "colonnades",
    reversals: "reversals",
    guarantee: "guarantee",
}
"""Each of their functions without arguments that returns whether something is so is a proof."""


class Theorem(NamedTuple):
    """A statement about column and frame, and whether the algebra proves it."""

    about: str
    theorem: str
    statement: str
    holds: bool


def theorems() -> list[Theorem]:
    """Prove all theorems; the first paragraph of a proof's docstring states it."""
    return [
        Theorem(about, name, " ".join(str(proof.__doc__).split("\n\n")[0].split()), proof())
        for module, about in MODULES.items()
        for name, proof in vars(module).items()
        if inspect.isfunction(proof) and proof.__module__ == module.__name__
        if str(inspect.signature(proof)) == "() -> 'bool'"
    ]
