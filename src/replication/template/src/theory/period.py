"""The period of a pendulum over that of infinitely small swings, by two routes of SciPy."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipk

TOLERANCE = 1e-12
"""Of the integration in time, relative and absolute."""


def by_elliptic_integral(amplitude: ArrayLike) -> NDArray[np.float64]:
    """Return the period from the complete elliptic integral of the first kind.

    Parameters
    ----------
    amplitude
        θ₀ in rad, between 0 and π; a number or an array.
    """
    period: NDArray[np.float64] = 2.0 * ellipk(np.sin(np.asarray(amplitude) / 2.0) ** 2) / math.pi
    return period


def by_integration(amplitude: float) -> float:
    """Return the period from the time that the pendulum takes from rest to the lowest point.

    Parameters
    ----------
    amplitude
        θ₀ in rad, between 0 and π.

    Raises
    ------
    ValueError
        For an amplitude from which the pendulum does not come down.
    """
    if not 0.0 < amplitude < math.pi:
        raise ValueError(f"the amplitude is {amplitude} rad; expected one between 0 and π")

    def rates(_: float, state: NDArray[np.float64]) -> list[float]:
        return [state[1], -math.sin(state[0])]  # Eq. (1), with the time over √(l/g)

    def lowest_point(_: float, state: NDArray[np.float64]) -> float:
        return float(state[0])

    lowest_point.terminal = True  # type: ignore[attr-defined]
    found = solve_ivp(
        rates,
        (0.0, 100.0),
        [amplitude, 0.0],
        method="DOP853",
        rtol=TOLERANCE,
        atol=TOLERANCE,
        events=lowest_point,
    )
    return float(4.0 * found.t_events[0][0] / (2.0 * math.pi))
