"""The second solver on a sample: beside a change of outcome, and where the first one is sure."""

import math
from collections.abc import Callable, Iterable

from replication.step import check
from topheavy import Record, RockingBlock, judge
from topheavy.second import reference

NEAR = 1e-3  # of a factor on a motion: how far a change of outcome is at most
NUDGE = 1e-9  # of a motion: no measurement resolves it

Cell = tuple[RockingBlock, Record, Record | None, float, bool]
"""A structure, a motion and its vertical component, the factor on both, whether it overturns."""


def overturns(block: RockingBlock, record: Record, up: Record | None, factor: float) -> bool:
    """Return whether a motion times a factor overturns a structure."""
    return judge(block, record.scaled(factor), vertical=up and up.scaled(factor)).overturned


def beside_a_boundary(overturns: Callable[[float], bool], factor: float) -> float:
    """Return a factor with the outcome of this one, within NEAR of one with the other outcome."""
    outcome, other = overturns(factor), factor
    while overturns(other) == outcome:
        factor, other = other, other * (0.9 if outcome else 1.1)
    while abs(other / factor - 1.0) > NEAR:
        middle = math.sqrt(factor * other)
        if overturns(middle) == outcome:
            factor = middle
        else:
            other = middle
    return factor


def check_by_scipy(cells: Iterable[Cell]) -> None:
    """Stop the step unless SciPy has the same outcomes.

    Those that a nudge of the motion changes are not compared.
    """
    compared = differ = 0
    for block, record, up, factor, fell in cells:
        near = [overturns(block, record, up, factor * (1.0 + by)) for by in (-NUDGE, 0.0, NUDGE)]
        if all(near) or not any(near):
            ending = reference.judge(
                block, record.scaled(factor), vertical=up and up.scaled(factor)
            )
            compared, differ = compared + 1, differ + (ending.overturned != fell)
    print(f"SciPy has {differ} of {compared} outcomes otherwise", flush=True)
    check(compared > 0 and differ == 0, f"SciPy has {differ} of {compared} outcomes otherwise")
