"""Which pulse shapes exist. Library, kernel, config schemas and explorer take them from this list.

A new shape also needs its wave and turning points in `pulses`, its wave and equation in
`kernel.forcing`, and both in src/explorer/motions.js: three independent forms of one formula.
"""

import math
from typing import NamedTuple


class Shape(NamedTuple):
    """What all users of a shape need to know of it."""

    title: str
    """What to call the pulse where a reader chooses one."""
    half_periods: float
    """How long it lasts, over π/ω."""
    is_elementary: bool
    """Whether the linearised motion under it has an elementary solution (`linear`)."""


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

ENDING = tuple(name for name, shape in SHAPES.items() if shape.half_periods < math.inf)
"""Those of pulses that end, which maps, intervals and configs accept."""

ELEMENTARY = tuple(name for name, shape in SHAPES.items() if shape.is_elementary)
"""Those with an elementary solution of the linearised equation."""

ELEMENTARY_ENDING = tuple(name for name in ENDING if name in ELEMENTARY)
"""Those with both."""
