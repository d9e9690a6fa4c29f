"""Where a second solver is asked: beside a change of outcome."""

import math
from collections.abc import Callable

NEAR = 1e-3
"""Of a factor on a motion: how far a change of outcome is at most."""


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
