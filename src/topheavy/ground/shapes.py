"""The list of pulse shapes, which library, kernel, configs and the page read.

A new shape also needs its wave and turning points in `pulses`, its wave and equation in
`kernel.forcing`, and both in src/explorer/motions.js: three independent forms of one formula.
"""

import math
from typing import NamedTuple


class Shape(NamedTuple):
    """Name and duration of a pulse shape, and whether its motion has a closed form."""

    title: str
    """Its name where a reader chooses a pulse."""
    half_periods: float
    """Duration over π/ω."""
    is_elementary: bool
    """Whether the linearised motion under it has a solution in elementary functions."""


SHAPES = {
    "one-sine": Shape("One-sine pulse", 2.0, is_elementary=True),
    "one-cosine": Shape("One-cosine pulse", 2.0, is_elementary=True),
    "half-sine": Shape("Half-sine pulse", 1.0, is_elementary=True),
    "constant": Shape("Constant pulse", 1.0, is_elementary=True),
    "harmonic": Shape("Steady sine of a shake table", math.inf, is_elementary=True),
    "ricker-symmetric": Shape("Symmetric Ricker pulse", 9.0, is_elementary=False),
    "ricker-antisymmetric": Shape("Antisymmetric Ricker pulse", 9.0, is_elementary=False),
}

PULSE_SHAPES = tuple(SHAPES)
"""The names that `Pulse` accepts."""

FINITE_SHAPES = tuple(name for name, shape in SHAPES.items() if shape.half_periods < math.inf)
"""Shapes of pulses that end, which maps, searches and configs accept."""

ELEMENTARY = tuple(name for name, shape in SHAPES.items() if shape.is_elementary)
"""Shapes with a solution of the linearised equation in elementary functions."""
