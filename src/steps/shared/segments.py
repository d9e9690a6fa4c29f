"""A pulse in spans of time over which its acceleration is monotone, for the three bodies."""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from topheavy.ground.pulses import Pulse, unit_wave
from topheavy.ground.shapes import SHAPES, WAVES

MAX_ITERATIONS = 10_000
"""A root at 1e-16 s in a bracket from 0 to 1 s takes more than SciPy's default of 100."""


class Segment(NamedTuple):
    """A span of time over which the ground acceleration (g) is smooth and monotone.

    So |a| is largest at an end and crosses any level at most once on the way up: uplift is found
    with certainty, not by sampling.
    """

    start: float
    stop: float
    acceleration: Callable[[float], float]

    def uplift(self, time: float, level: float) -> float | None:
        """Return the first instant from `time` on at which |a| exceeds `level` (g), or None."""
        if abs(self.acceleration(time)) > level:
            return time
        end = self.acceleration(self.stop)
        if abs(end) <= level:
            return None
        return self._crossing(math.copysign(level, end), time)

    def falls_below(self, time: float, side: int, level: float) -> float:
        """Return when the push on `side`, −side·a, first drops below `level` (g), or the stop."""
        now, last = -side * self.acceleration(time), -side * self.acceleration(self.stop)
        if last >= level:
            return self.stop
        if now <= level:
            return time
        return self._crossing(-side * level, time)

    def largest(self, start: float, stop: float) -> float:
        """Return max |a| (g) over the overlap with [start, stop], or 0 where there is none."""
        first, last = max(start, self.start), min(stop, self.stop)
        if first > last:
            return 0.0
        return max(abs(self.acceleration(first)), abs(self.acceleration(last)))

    def _crossing(self, value: float, time: float) -> float:
        """Return when the acceleration, monotone, takes `value` between `time` and the stop."""
        return sign_change(lambda t: self.acceleration(t) - value, time, self.stop)


def sign_change(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes its sign between `low` and `high`, to 1e-15 relative."""
    return float(brentq(function, low, high, xtol=1e-300, rtol=1e-15, maxiter=MAX_ITERATIONS))


def segments_of(pulse: Pulse | None, until: float) -> list[Segment]:
    """Return the segments of a pulse from 0 to `until`; the last has the ground at rest."""
    segments: list[Segment] = []
    end = 0.0
    if pulse is not None:
        end, wave = min(until, pulse.duration), WAVES[SHAPES[pulse.shape].wave]
        turns = np.array(wave.turns)
        if wave.period < math.inf:
            turns = np.arange(wave.turns[0], end * pulse.angular_frequency, wave.period)
        inner = turns[(turns > 0.0) & (turns < end * pulse.angular_frequency)]
        edges = [0.0, *(inner / pulse.angular_frequency).tolist(), end]

        def acceleration(time: float) -> float:
            phase = float(pulse.angular_frequency * time)
            return float(pulse.amplitude * unit_wave(pulse.wave_number, phase)[0])

        segments = [Segment(*edge, acceleration) for edge in pairwise(edges) if edge[0] < edge[1]]
    if end < until:
        segments.append(Segment(end, until, lambda time: 0.0))
    return segments
