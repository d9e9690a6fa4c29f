"""The interface of a ground motion to the solvers: an acceleration in smooth, monotone segments."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.checks import short_repr


def constant_gravity(time: float) -> float:
    """The effective gravity over g of ground without vertical acceleration: 1."""
    return 1.0


def no_excitation(value: object) -> ValueError:
    """Return the ValueError for an argument that is no ground motion."""
    return ValueError(
        f"excitation is {short_repr(value)}; expected a Pulse or a Record, for example "
        'Pulse("one-sine", 0.3, 6.0) with 0.3 g and 6 rad/s'
    )


def checked_excitation(value: Any, *, ends: bool = False) -> Excitation:
    """Check that an argument is a ground motion and, if `ends`, of finite duration."""
    if isinstance(value, type) or not callable(getattr(value, "segments", None)):
        raise no_excitation(value)
    if ends and value.duration == math.inf:
        raise ValueError("the excitation goes on forever; expected one that ends")
    return cast("Excitation", value)


_MAX_ITERATIONS = 10_000
"""A root at 1e-16 s in a bracket from 0 to 1 s takes more than SciPy's default of 100."""


def sign_change(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function changes its sign between `low` and `high`, to 1e-15 relative."""
    from scipy.optimize import brentq  # half a second that the kernel never needs

    return float(brentq(function, low, high, xtol=1e-300, rtol=1e-15, maxiter=_MAX_ITERATIONS))


class Segment(NamedTuple):
    """A span of time over which the ground acceleration is smooth and monotone.

    So |a| is largest at an end and crosses any level at most once on the way up: uplift is found
    with certainty, not by sampling.
    """

    start: float
    stop: float
    acceleration: Callable[[float], float]
    gravity: Callable[[float], float] = constant_gravity
    """Effective gravity over g, 1 + v̈_g/g; `acceleration` is ü_g over this effective gravity."""

    def uplift(self, time: float, level: float) -> float | None:
        """Return the first instant from `time` on at which |a| exceeds `level` (g), or None."""
        if abs(self.acceleration(time)) > level:
            return time
        end = self.acceleration(self.stop)
        if abs(end) <= level:
            return None
        return self._crossing(np.copysign(level, end), time)

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

    def least_gravity(self, start: float, stop: float) -> float:
        """Return the least gravity over the overlap with [start, stop], or 1 without one."""
        first, last = max(start, self.start), min(stop, self.stop)
        return min(self.gravity(first), self.gravity(last)) if first <= last else 1.0

    def _crossing(self, value: float, time: float) -> float:
        """Return when the acceleration, monotone, takes `value` between `time` and the stop."""
        return sign_change(lambda t: self.acceleration(t) - value, time, self.stop)


class Lines(Sequence[Segment]):
    """The segments between samples, each computed when it is read.

    `largest` holds for each segment the larger |a| of its two ends, g.
    """

    def __init__(self, largest: NDArray[np.float64], make: Callable[[int], Segment]) -> None:
        self._largest, self._make = largest, make

    def __len__(self) -> int:
        return int(self._largest.size)

    @overload
    def __getitem__(self, at: int) -> Segment: ...
    @overload
    def __getitem__(self, at: slice) -> list[Segment]: ...
    def __getitem__(self, at: int | slice) -> Segment | list[Segment]:
        places = range(len(self))[at]
        return self._make(places) if isinstance(places, int) else list(map(self._make, places))


class Excitation(ABC):
    """A ground motion: `Pulse` and `Record`."""

    @property
    @abstractmethod
    def duration(self) -> float:
        """How long it lasts, s; infinite for the harmonic."""
        ...

    @overload
    def excitation(self, t: float) -> float: ...
    @overload
    def excitation(
        self, t: Sequence[float] | NDArray[np.floating[Any] | np.integer[Any]]
    ) -> NDArray[np.float64]: ...
    @overload
    def excitation(self, t: ArrayLike) -> float | NDArray[np.float64]: ...
    def excitation(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return the ground acceleration in g at the time(s) t in s; zero outside the motion."""
        times = checks.numbers("t", t)
        if np.isnan(times).any():
            raise ValueError("t holds NaN; expected times in s")
        values = self.accelerations(times)
        return float(values) if np.ndim(values) == 0 else values

    @abstractmethod
    def accelerations(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the ground acceleration in g at an array of times in s; zero outside."""
        ...

    @abstractmethod
    def segments(self, until: float) -> Sequence[Segment]:
        """Return the segments from 0 to the earlier of `until` and the end, in order."""
        ...


def zero_acceleration(time: float) -> float:
    """The acceleration of ground at rest."""
    return 0.0
