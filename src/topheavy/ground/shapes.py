"""The one description of pulse shapes, from which library, kernel, configs and page read.

A pulse is a wave of the phase ωt over a number of half periods. Each wave f(x) solves

    f'' = −stiffness f − drag (x − CENTRE) f',

which gives the Taylor series of the kernel and of the page. The formula of a wave stands in
`pulses`, which the kernel compiles, and in src/explorer/motions.js.
"""

import math
from typing import Literal, NamedTuple, get_args

CENTRE = 4.5 * math.pi
"""Phase of the middle of a Ricker wavelet: 2.25 T after the start."""


class Wave(NamedTuple):
    """A wave of unit amplitude.

    A Ricker wavelet is a derivative of exp(−y²), y = κ (x − CENTRE), and Hermite's equation that of
    the derivative of order n: stiffness 2(n + 1) κ², drag 2 κ².
    """

    stiffness: float
    drag: float
    period: float
    """Between two turns (zeros of the slope), π; infinite where `turns` has all of them."""
    turns: tuple[float, ...]
    """Phases of the turns of a Ricker wavelet, or of the first one of a sine or cosine."""


def _around(*offsets: float) -> tuple[float, ...]:
    return tuple(sorted({CENTRE + sign * x for x in offsets for sign in (-1, 1)}))


WAVES = {
    "sine": Wave(1.0, 0.0, math.pi, (0.5 * math.pi,)),
    "cosine": Wave(1.0, 0.0, math.pi, (0.0,)),
    "constant": Wave(0.0, 0.0, math.inf, ()),
    "ricker-symmetric": Wave(1.5, 0.5, math.inf, _around(0.0, math.sqrt(6.0))),
    "ricker-antisymmetric": Wave(
        4.0 / 3.0,
        1.0 / 3.0,
        math.inf,
        _around(*(math.sqrt(9.0 + sign * 3.0 * math.sqrt(6.0)) for sign in (-1, 1))),
    ),
}

SINE, COSINE, CONSTANT, RICKER_SYMMETRIC, RICKER_ANTISYMMETRIC = range(len(WAVES))


class Shape(NamedTuple):
    """A pulse shape: its wave, how long it lasts, and whether the pulse can have several cycles."""

    title: str
    """Its name where a reader chooses a pulse."""
    wave: str
    """A name of `WAVES`."""
    half_periods: float
    """Duration of a cycle over π/ω."""
    repeats: bool = False


FiniteShape = Literal[
    "one-sine", "one-cosine", "half-sine", "constant", "ricker-symmetric", "ricker-antisymmetric"
]
"""Shapes of pulses that end, which maps, searches and configs accept."""

PulseShape = Literal[FiniteShape, "harmonic"]
"""The names that `Pulse` accepts."""

SHAPES: dict[PulseShape, Shape] = {
    "one-sine": Shape("One-sine pulse", "sine", 2.0, repeats=True),
    "one-cosine": Shape("One-cosine pulse", "cosine", 2.0, repeats=True),
    "half-sine": Shape("Half-sine pulse", "sine", 1.0),
    "constant": Shape("Constant pulse", "constant", 1.0),
    "harmonic": Shape("Steady sine of a shake table", "sine", math.inf),
    "ricker-symmetric": Shape("Symmetric Ricker pulse", "ricker-symmetric", 9.0),
    "ricker-antisymmetric": Shape("Antisymmetric Ricker pulse", "ricker-antisymmetric", 9.0),
}

PULSE_SHAPES: tuple[PulseShape, ...] = tuple(SHAPES)
FINITE_SHAPES: tuple[FiniteShape, ...] = get_args(FiniteShape)

ELEMENTARY = tuple(name for name, shape in SHAPES.items() if not WAVES[shape.wave].drag)
"""Shapes under which the linearised equation has a solution in elementary functions."""

MAX_CYCLES = 100
"""Of a pulse."""
