"""Ground acceleration pulses in the shapes of the rocking literature.

One-sine, one-cosine: Zhang & Makris (2001), Makris & Roussos (2000). Half-sine, constant: Housner
(1963). Ricker wavelets as in Makris & Vassiliou (2013), with the main lobe 2.25 T after the start.
"""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass, replace
from typing import Any, Never

import numpy as np
from numpy.typing import NDArray

from topheavy import checks
from topheavy.ground.excitation import Excitation
from topheavy.ground.shapes import (
    CENTRE,
    CONSTANT,
    COSINE,
    MAX_CYCLES,
    PULSE_SHAPES,
    RICKER_SYMMETRIC,
    SHAPES,
    SINE,
    WAVES,
    PulseShape,
)

ANTISYMMETRIC_PEAK = 1.3801
"""Largest value of the antisymmetric Ricker wavelet, to five digits, by which it is divided."""


def unit_wave(wave: int, phase: Any) -> tuple[Any, Any]:
    """Return a wave of unit amplitude, by its place in `shapes.WAVES`, and its slope at phases.

    The kernel compiles this function for one phase.
    """
    if wave == SINE:
        return np.sin(phase), np.cos(phase)
    if wave == COSINE:
        return np.cos(phase), -np.sin(phase)
    if wave == CONSTANT:
        return 1.0, 0.0
    if wave == RICKER_SYMMETRIC:
        y = 0.5 * (phase - CENTRE)  # π τ / T
        bell = np.exp(-y * y)
        return (1.0 - 2.0 * y * y) * bell, y * (2.0 * y * y - 3.0) * bell
    x = (phase - CENTRE) / np.sqrt(3.0)  # 2 π τ / √3 T
    bell = np.exp(-0.5 * x * x) / ANTISYMMETRIC_PEAK
    return (x * x - 3.0) * x * bell, (x * x * (6.0 - x * x) - 3.0) / np.sqrt(3.0) * bell


def checked_shape(shape: PulseShape) -> PulseShape:
    """Return the name of a pulse shape, or raise ValueError with the nearest one that exists."""
    if not isinstance(shape, str) or shape not in PULSE_SHAPES:
        close = difflib.get_close_matches(str(shape), PULSE_SHAPES, n=1, cutoff=0.5)
        hint = f" (did you mean {close[0]!r}?)" if close else ""
        raise ValueError(
            f"shape is {checks.short_repr(shape)}{hint}; expected one of {', '.join(PULSE_SHAPES)}"
        )
    return shape


@dataclass(frozen=True, init=False)
class Pulse(Excitation):
    """A ground acceleration pulse that starts at t = 0.

    Parameters
    ----------
    shape : str
        "one-sine" and "one-cosine" last 2π/ω for each of their cycles, "half-sine" and "constant"
        π/ω, "ricker-symmetric" and "ricker-antisymmetric" 4.5 · 2π/ω; "harmonic" (a sine) goes on.
    amplitude : float
        Peak acceleration in g; a negative one mirrors the pulse.
    angular_frequency, period : float
        ω, rad/s, or 2π/ω, s: one of both, by its name.
    cycles : int
        Of a one-sine or one-cosine; 1 for other shapes.

    Raises
    ------
    TypeError
        For a third argument without a name, which could be a frequency or a period.
    ValueError
        For an unknown shape, an amplitude that is not finite or above 10⁶ g, a frequency or period
        that is not positive, unless there is one of the two, and for a number of cycles that is not
        whole, below 1 or above 100, or that the shape cannot have.

    Examples
    --------
    >>> th.Pulse("one-sine", 0.4, period=3.0).duration
    3.0
    >>> round(th.Pulse("one-sine", 0.4, period=3.0, cycles=5).duration, 9)
    15.0
    """

    shape: PulseShape
    amplitude: float
    angular_frequency: float
    cycles: int

    def __init__(
        self,
        shape: PulseShape,
        amplitude: float,
        *unnamed: Never,
        angular_frequency: float | None = None,
        period: float | None = None,
        cycles: int = 1,
    ) -> None:
        if unnamed:
            third = checks.short_repr(unnamed[0])
            raise TypeError(
                f"Pulse takes shape and amplitude without a name; expected period={third} for s, "
                f"or angular_frequency={third} for rad/s, in the place of {third}"
            )
        if (angular_frequency is None) == (period is None):
            raise ValueError(
                f"angular_frequency is {angular_frequency} and period is {period}; expected one "
                "of both, in rad/s or s"
            )
        if period is not None:
            angular_frequency = 2.0 * math.pi / checks.positive("period", period, "s")
        object.__setattr__(self, "shape", checked_shape(shape))
        checks.set_fields(
            self,
            amplitude=checks.within_reason("amplitude", amplitude, "g"),
            angular_frequency=checks.positive("angular_frequency", angular_frequency, "rad/s"),
        )
        object.__setattr__(self, "cycles", _checked_cycles(cycles, shape))

    def __repr__(self) -> str:
        """Return the fields, and the period to show a frequency in Hz that should be in rad/s."""
        cycles = f", cycles={self.cycles}" if self.cycles > 1 else ""
        return (
            f"Pulse({self.shape!r}, amplitude={self.amplitude!r}, "
            f"angular_frequency={self.angular_frequency!r}{cycles}: "
            f"{self.amplitude:.4g} g, period {self.period:.4g} s)"
        )

    @property
    def period(self) -> float:
        """2π/ω, s."""
        return 2.0 * math.pi / self.angular_frequency

    @property
    def half_periods(self) -> float:
        """Duration over π/ω; infinite for the harmonic."""
        return self.cycles * SHAPES[self.shape].half_periods

    @property
    def duration(self) -> float:
        """Duration, s; infinite for the harmonic."""
        return self.half_periods * math.pi / self.angular_frequency

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
        wave = list(WAVES).index(SHAPES[self.shape].wave)
        return np.where(inside, self.amplitude * unit_wave(wave, phase)[0], 0.0)


def _checked_cycles(cycles: int, shape: PulseShape) -> int:
    """Return the number of cycles of a pulse, or raise ValueError with the accepted ones."""
    number = checks.whole("cycles", cycles, 1, MAX_CYCLES)
    if number > 1 and not SHAPES[shape].repeats:
        several = " or ".join(name for name, each in SHAPES.items() if each.repeats)
        raise ValueError(f"cycles is {cycles} for shape {shape!r}; expected 1, or shape {several}")
    return number
