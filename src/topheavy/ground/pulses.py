"""Ground acceleration pulses in the shapes of the rocking literature.

One-sine, one-cosine: Zhang & Makris (2001), Makris & Roussos (2000). Half-sine, constant: Housner
(1963). Ricker wavelets as in Makris & Vassiliou (2013), with the main lobe 2.25 T after the start.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy import checks
from topheavy.ground.excitation import Excitation, Segment
from topheavy.ground.shapes import PULSE_SHAPES, SHAPES

Phase = NDArray[np.float64]


@dataclass(frozen=True)
class _Wave:
    """A pulse of unit amplitude over the phase ωt, and the phases at which its slope is zero.

    `at_one` computes the value at a single phase, ten times as fast as numpy.
    """

    at: Callable[[Phase], Phase]
    at_one: Callable[[float], float]
    turns: tuple[float, ...] = ()


_RICKER_CENTRE = 4.5 * math.pi  # phase of the middle of the main lobe
_RICKER_ANTISYMMETRIC_PEAK = 1.3801  # makes the peak 1, to five digits


def _ricker_symmetric(phase: Any, exp: Any = np.exp) -> Any:
    z = (phase - _RICKER_CENTRE) / 2.0  # π τ / T
    return (1.0 - 2.0 * z**2) * exp(-(z**2))


def _ricker_antisymmetric(phase: Any, exp: Any = np.exp) -> Any:
    x = (phase - _RICKER_CENTRE) / math.sqrt(3.0)  # 2 π τ / √3 T
    return (x**2 - 3.0) * x * exp(-(x**2) / 2.0) / _RICKER_ANTISYMMETRIC_PEAK


def _around_main_lobe(*offsets: float) -> tuple[float, ...]:
    """Return the phases at ± these distances from the main lobe's middle, ascending."""
    return tuple(sorted({_RICKER_CENTRE + sign * x for x in offsets for sign in (-1, 1)}))


_HALF_PI = math.pi / 2

_WAVES = {
    "one-sine": _Wave(np.sin, math.sin, (_HALF_PI, 3 * _HALF_PI)),
    "one-cosine": _Wave(np.cos, math.cos, (math.pi,)),
    "half-sine": _Wave(np.sin, math.sin, (_HALF_PI,)),
    "constant": _Wave(np.ones_like, lambda phase: 1.0),
    "harmonic": _Wave(np.sin, math.sin),  # for its turns see Pulse.segments
    "ricker-symmetric": _Wave(
        _ricker_symmetric,
        partial(_ricker_symmetric, exp=math.exp),
        _around_main_lobe(0.0, math.sqrt(6.0)),
    ),
    "ricker-antisymmetric": _Wave(
        _ricker_antisymmetric,
        partial(_ricker_antisymmetric, exp=math.exp),
        _around_main_lobe(*(math.sqrt(3.0 * (3.0 + s * math.sqrt(6.0))) for s in (-1, 1))),
    ),
}


def checked_shape(shape: str) -> str:
    """Return the name of a pulse shape, or raise ValueError with the nearest one that exists."""
    if shape not in PULSE_SHAPES:
        close = difflib.get_close_matches(str(shape), PULSE_SHAPES, n=1, cutoff=0.5)
        hint = f" (did you mean {close[0]!r}?)" if close else ""
        raise ValueError(f"shape is {shape!r}{hint}; expected one of {', '.join(PULSE_SHAPES)}")
    return shape


@dataclass(frozen=True, init=False)
class Pulse(Excitation):
    """A ground acceleration pulse that starts at t = 0.

    Parameters
    ----------
    shape : str
        One of `PULSE_SHAPES`. One-sine and one-cosine last 2π/ω, half-sine and constant π/ω, the
        Ricker wavelets 4.5 · 2π/ω; the harmonic (a sine) goes on.
    amplitude : float
        Peak acceleration in g; a negative one mirrors the pulse.
    angular_frequency : float
        ω, rad/s.
    period : float
        2π/ω, s, in place of ω.

    Raises
    ------
    ValueError
        For an unknown shape, an amplitude that is not finite or above 10⁶ g, a frequency or period
        that is not positive, and unless there is one of the two.

    Examples
    --------
    >>> th.Pulse("one-sine", 0.4, period=3.0).duration
    3.0
    """

    shape: str
    amplitude: float
    angular_frequency: float

    def __init__(
        self,
        shape: str,
        amplitude: float,
        angular_frequency: float | None = None,
        *,
        period: float | None = None,
    ) -> None:
        if (angular_frequency is None) == (period is None):
            raise ValueError(
                f"angular_frequency is {angular_frequency} and period is {period}; expected one "
                "of both, in rad/s or s"
            )
        checks.acceleration("amplitude", amplitude)
        if period is not None:
            angular_frequency = 2.0 * math.pi / checks.positive("period", period, "s")
        checks.positive("angular_frequency", angular_frequency, "rad/s")
        object.__setattr__(self, "shape", checked_shape(shape))
        object.__setattr__(self, "amplitude", amplitude)
        object.__setattr__(self, "angular_frequency", angular_frequency)

    def __repr__(self) -> str:
        """Return the fields, and the period to show a frequency in Hz that should be in rad/s."""
        return (
            f"Pulse({self.shape!r}, amplitude={self.amplitude!r}, "
            f"angular_frequency={self.angular_frequency!r}: "
            f"{self.amplitude:.4g} g, period {self.period:.4g} s)"
        )

    @property
    def period(self) -> float:
        """2π/ω, s."""
        return 2.0 * math.pi / self.angular_frequency

    @property
    def duration(self) -> float:
        """Duration, s; infinite for the harmonic."""
        return SHAPES[self.shape].half_periods * math.pi / self.angular_frequency

    @property
    def peak_acceleration(self) -> float:
        """|amplitude|, g."""
        return abs(float(self.amplitude))

    def scaled(self, factor: float) -> Pulse:
        """Return the pulse with its amplitude multiplied by `factor`."""
        return replace(self, amplitude=self.amplitude * checks.finite("factor", factor))

    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the ground acceleration in g at an array of times in s; zero outside the pulse."""
        inside = (time >= 0.0) & (time <= self.duration)
        phase = self.angular_frequency * np.where(inside, time, 0.0)
        return np.where(inside, self.amplitude * _WAVES[self.shape].at(phase), 0.0)

    def segments(self, until: float) -> list[Segment]:
        """Return the smooth, monotone segments from 0 to the earlier of `until` and the end."""
        end = min(until, self.duration)
        phase = end * self.angular_frequency
        turns = _WAVES[self.shape].turns
        if self.shape == "harmonic":
            turns = tuple(np.arange(_HALF_PI, phase, math.pi))
        inner = [turn / self.angular_frequency for turn in turns if turn < phase]
        edges = [0.0, *inner, end]
        return [Segment(start, stop, self._at) for start, stop in pairwise(edges) if start < stop]

    def _at(self, time: float) -> float:
        """Return the acceleration at a time within the duration."""
        phase = float(self.angular_frequency * time)
        return float(self.amplitude * _WAVES[self.shape].at_one(phase))
