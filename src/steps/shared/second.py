"""Where a second solver is asked: beside a change of outcome, and where the first is sure."""

import math
from collections.abc import Callable, Iterable
from functools import partial

from steps.shared.histories import NUDGE
from topheavy import Record, judge
from topheavy.bodies.structures import Structure
from topheavy.second import reference

NEAR = 1e-3
"""Of a factor on a motion: how far a change of outcome is at most."""


def overturns(structure: Structure, motion: Record, factor: float) -> bool:
    """Return whether a motion times a factor overturns a structure."""
    return judge(structure, motion.scaled(factor)).overturned


def beside_a_boundary(overturns: Callable[[float], bool], factor: float) -> float:
    """Return a factor with the outcome of this one, within NEAR of one with the other outcome."""
    fell, other = overturns(factor), factor
    while overturns(other) == fell:
        factor, other = other, other * (0.9 if fell else 1.1)
    while abs(other / factor - 1.0) > NEAR:
        middle = math.sqrt(factor * other)
        if overturns(middle) == fell:
            factor = middle
        else:
            other = middle
    return factor


def decided(overturns: Callable[[float], bool], factor: float) -> bool | None:
    """Return the outcome at a factor on a motion; None, if a nudge of the motion changes it."""
    near = {overturns(factor * (1.0 + nudge)) for nudge in (-NUDGE, 0.0, NUDGE)}
    return near.pop() if len(near) == 1 else None


def by_scipy(cells: Iterable[tuple[Structure, Record, float, bool]]) -> dict[str, int]:
    """Return how many outcomes are decided (`decided`), and of these how many SciPy has otherwise.

    A cell is a structure, a motion, the factor on it, and whether it is said to overturn.
    """
    told = differ = 0
    for structure, motion, factor, fell in cells:
        if decided(partial(overturns, structure, motion), factor) is not None:
            told += 1
            differ += reference.judge(structure, motion.scaled(factor)).overturned != fell
    return {"decided": told, "differ": differ}
