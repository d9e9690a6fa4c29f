"""The interface of a ground motion: its duration, and its acceleration at any time."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.checks import short_repr


def no_excitation(value: object) -> ValueError:
    """Return the ValueError for an argument that is no ground motion."""
    return ValueError(
        f"excitation is {short_repr(value)}; expected a Pulse or a Record, for example "
        'Pulse("one-sine", 0.3, period=1.0) with 0.3 g and 1 s'
    )


def checked_excitation(value: Any, *, ends: bool = False) -> Excitation:
    """Check that an argument is a ground motion and, if `ends`, of finite duration."""
    if not isinstance(value, Excitation):
        raise no_excitation(value)
    if ends and value.duration == math.inf:
        raise ValueError("the excitation goes on forever; expected one that ends")
    return value


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
