"""Two frames under steered random ground motions, until an impact: an attack on Theorem 2.

Frame 2 is the heavier one. Times are over 1/p of the column, accelerations in g, and A is the push
inward. Up to α it is at most a factor times cot(α − φ₂): the theorem permits the factor 1. The
motions jump outward, hold the bound and push outward, so that frame 2 hovers near the ground or
swings beyond α, where any push is permitted.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy import Column, RockingFrame

Array = NDArray[np.float64]
STEP, STEPS = 0.006, 300  # time step, times 1/p, and largest number of steps
STRONGEST = 100.0  # largest push to either side, g
HOVER = 0.1  # rotation below which a jump outward is likely, times α
ROUNDING = 1e-5  # error of the integration, times the largest Y of a history


def acceleration(phi: Array, push: Array, squares: Array, alpha: float) -> Array:
    """Return φ̈ of Eq. (23)."""
    return squares * (np.sin(phi - alpha) - push * np.cos(phi - alpha))


def moved(
    phi: Array, rate: Array, push: Array, squares: Array, alpha: float
) -> tuple[Array, Array]:
    """Return φ and φ̇ after a step, by the rule of Runge and Kutta."""

    def slopes(angle: Array, speed: Array) -> tuple[Array, Array]:
        return speed, acceleration(angle, push, squares, alpha)

    k1 = slopes(phi, rate)
    k2 = slopes(phi + STEP / 2 * k1[0], rate + STEP / 2 * k1[1])
    k3 = slopes(phi + STEP / 2 * k2[0], rate + STEP / 2 * k2[1])
    k4 = slopes(phi + STEP * k3[0], rate + STEP * k3[1])
    steps = zip(k1, k2, k3, k4, strict=True)
    turn, change = (STEP / 6 * (a + 2 * b + 2 * c + d) for a, b, c, d in steps)
    return phi + turn, rate + change


def compared(phi: Array, squares: Array, alpha: float) -> Array:
    """Return Y = (x + α)/p² with x = φ − α up to α, and x = artanh sin(φ − α) beyond."""
    beyond = np.arctanh(np.sin(np.clip(phi - alpha, 0.0, 1.5)))
    return (np.where(phi <= alpha, phi, alpha + beyond)) / squares


def bound(phi: Array, factor: float, alpha: float) -> Array:
    """Return the largest push inward: the factor times cot(α − φ), and STRONGEST beyond α."""
    lean = np.maximum(alpha - np.maximum(phi, 0.0), 1e-9)
    return np.where(phi < alpha, np.minimum(factor / np.tan(lean), STRONGEST), STRONGEST)


def attack(alpha: float, pairs: Any, factor: float, histories: int, seed: int) -> dict[str, int]:
    """Return the numbers of histories, of lost orders Y₁ ≥ Y₂, and of first landings of frame 1.

    `samples_beyond_alpha` counts the time steps of all histories in which frame 2 is beyond α.

    Parameters
    ----------
    alpha : float
        rad.
    pairs : list of (float, float)
        γ of both frames; each history has one of them.
    factor : float
        On cot(α − φ₂).
    """
    draw = np.random.default_rng(seed)
    column = Column(math.sin(alpha), math.cos(alpha))
    gammas = np.array(pairs)[draw.integers(len(pairs), size=histories)].T
    p = [[RockingFrame(column, g).frequency_parameter for g in row] for row in gammas]
    squares = (np.array(p) / column.frequency_parameter) ** 2
    phi, largest = np.zeros((2, histories)), np.zeros(histories)
    rate = squares * math.cos(alpha) * draw.uniform(0.1, 1.5, histories)
    alive, lost = np.full(histories, True), np.zeros(histories, bool)
    first = swings = 0
    bold = draw.random(histories)  # share of the steps without the largest push inward
    for _ in range(STEPS):
        kind, share = draw.random((2, histories))
        push = np.where(kind < bold, -STRONGEST * share**4, bound(phi[1], factor, alpha))
        push = np.where((kind > 0.9) | ((phi[1] > alpha) & (push > 0.0)), share * push, push)
        # within the bound at the end of the step, too, where frame 2 may be lower
        fall = acceleration(phi[1], push, squares[1], alpha)
        later = phi[1] + STEP * (rate[1] + STEP / 2 * fall)
        push = np.minimum(push, bound(later, factor, alpha))
        jumps = (phi[1] < HOVER * alpha) & (rate[1] < 0.0) & (draw.random(histories) < 0.3)
        size = np.where(jumps, 10.0 ** draw.uniform(-2.0, 0.0, histories), 0.0)
        rate = rate + squares * size * np.cos(phi - alpha)
        phi, rate = moved(phi, rate, push, squares, alpha)
        y = compared(phi, squares, alpha)
        largest = np.maximum(largest, np.where(alive, y[1], 0.0))
        lost |= alive & (y[0] - y[1] < -ROUNDING * largest)
        first += int((alive & (phi[0] < 0.0) & (phi[1] > ROUNDING * alpha)).sum())
        swings += int((alive & (phi[1] > alpha)).sum())
        alive &= (phi[1] > 0.0) & (phi[0] > 0.0) & (phi[0] < math.pi / 2)
        phi, rate = np.where(alive, phi, 0.0), np.where(alive, rate, 0.0)
        if not alive.any():
            break
    return {
        "histories": histories,
        "order_lost": int(lost.sum()),
        "lighter_first": first,
        "samples_beyond_alpha": swings,
    }
