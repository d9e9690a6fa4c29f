"""The response of a rocking block, which `simulate` returns."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.structures import RockingBlock

MAX_SAMPLES = 10_000_000
"""Largest number of samples: three arrays of 80 MB."""

EndState = Literal["no uplift", "rests", "rocking", "overturned"]


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """A rocking history and its outcome.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, from 0.
    rotation, velocity : ndarray, shape (n,)
        θ in rad and θ̇ in rad/s, signed; NaN after the end of a history that overturned or was cut
        off while rocking.
    impact_times : ndarray, shape (m,)
        Times of the impacts, s. Impacts that end a rotation of 1e-6 α or less are left out, since
        a block that comes to rest has infinitely many.
    outcome : {"no uplift", "rests", "rocking", "overturned"}
        "rocking": the structure survives and has not come to rest when the history ends. Without
        loss (√r = 1) this is every structure that uplifts and survives; its bounces below 1e-6 α
        that cannot grow are zero in rotation and velocity.
    number_of_impacts : int
        Impacts until the forcing ends or the structure has overturned. The forcing of a record ends
        with the last sample that is not zero.
    peak_rotation : float
        max|θ| in rad, including the free rocking after the forcing; NaN if overturned.
    slenderness : float
        α of the structure, rad.

    Examples
    --------
    >>> column, pulse = th.Column(0.5, 3.0), th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> th.simulate(column, pulse.scaled(0.18)).number_of_impacts
    5
    """

    time: NDArray[np.float64]
    rotation: NDArray[np.float64]
    velocity: NDArray[np.float64]
    impact_times: NDArray[np.float64]
    outcome: EndState
    number_of_impacts: int
    peak_rotation: float
    slenderness: float

    @property
    def overturned(self) -> bool:
        """Whether the structure overturned."""
        return self.outcome == "overturned"

    def __repr__(self) -> str:
        return (
            f"Response({self.outcome!r}, peak_rotation={self.peak_rotation:.6g}, "
            f"number_of_impacts={self.number_of_impacts}, {self.time.size} samples)"
        )


def sample_times(samples: int | ArrayLike) -> int | NDArray[np.float64]:
    """Return `samples` as a number (at least 2) or increasing times, or raise ValueError."""
    if np.ndim(samples) == 0:
        return checks.whole("samples", samples, 2, MAX_SAMPLES)
    times = checks.numbers("samples", samples)
    if times.ndim != 1 or times.size == 0:
        raise ValueError(f"samples has shape {times.shape}; expected a list of times in s")
    if not np.isfinite(times).all():
        raise ValueError("samples holds times that are not finite; expected times in s")
    if times[0] < 0.0 or np.any(np.diff(times) <= 0.0):
        raise ValueError("samples is not an increasing array of times from 0 on")
    return times


def initial_motion(block: RockingBlock, rotation: float, velocity: float) -> tuple[float, float]:
    """Return finite θ (rad) and θ̇ (rad/s) at t = 0, |θ| < π/2 unless linearised."""
    theta = checks.within_reason("rotation", rotation, "rad")
    theta_rate = checks.within_reason("velocity", velocity, "rad/s")
    if not block.linearised and abs(theta) >= math.pi / 2:
        raise ValueError(f"rotation is {theta:.6g} rad; expected less than π/2, where it lies flat")
    return theta, theta_rate
