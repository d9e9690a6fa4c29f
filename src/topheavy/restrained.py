"""A rocking block whose stiffness stays positive: an elastic tendon joins its base to the ground.

The tendon runs in the axis of the column, and is slack at rest. Rotated by φ about a corner, the
middle of a base of width 2b is 2b sin(φ/2) from where it was. A tendon of stiffness k has the
energy 2 k b² sin²(φ/2) and the moment k b² sin φ. With κ = k b²/(m g R),

    φ̈ = p² { sin(φ − α) − κ sin φ − s (ü_g/g) cos(φ − α) },    φ = |θ|,  s = sgn θ.

The restoring moment rises with φ up to α if κ > 1/cos α; uplift and impact are those of the block.
A block with κ = 0 is that of Eq. (23).
"""

import math
from bisect import bisect
from typing import TypeAlias

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from topheavy.excitation import Excitation
from topheavy.structures import RockingBlock

Array: TypeAlias = NDArray[np.float64]

FLAT = 1.3  # rad; a block that has reached it stays there
STILL = 1e-5  # over α p: an impact that leaves a slower block ends the motion


def least_stiffness(block: RockingBlock) -> float:
    """Return κ = 1/cos α, above which the stiffness is positive up to |θ| = α."""
    return 1.0 / math.cos(block.slenderness)


def restoring_moment(block: RockingBlock, kappa: ArrayLike, phi: ArrayLike) -> Array:
    """Return the restoring moment over m g R at |θ| = φ (rad), for the tendon stiffness κ."""
    moment: Array = np.sin(block.slenderness - np.asarray(phi)) + np.asarray(kappa) * np.sin(phi)
    return moment


def restrained_peaks(
    block: RockingBlock,
    kappa: ArrayLike,
    motion: Excitation,
    scales: ArrayLike,
    *,
    duration: float,
    time_step: float,
) -> Array:
    """Return the largest |θ| (rad) of blocks with tendons, by the classical Runge–Kutta method.

    Parameters
    ----------
    block : RockingBlock
    kappa, scales : array_like
        κ of each tendon, and the factor on the ground motion; they broadcast.
    motion : Excitation
        In g.
    duration, time_step : float
        s. At an impact, a step is cut where its cubic reaches φ = 0.
    """
    steps = math.ceil(duration / time_step)
    ground = np.asarray(motion.excitation(0.5 * time_step * np.arange(2 * steps + 1)))
    kappa, scales = np.broadcast_arrays(np.asarray(kappa, float), np.asarray(scales, float))
    given = block.slenderness, block.frequency_parameter, block.restitution
    level, peaks = block.uplift_acceleration, np.empty(scales.shape)
    for place in np.ndindex(*scales.shape):
        peaks[place] = _peak(*given, level, kappa[place], scales[place] * ground, time_step)
    return peaks


@njit(cache=True)
def _acceleration(alpha, p, kappa, phi, pushed):  # type: ignore[no-untyped-def]
    moment = math.sin(alpha - phi) + kappa * math.sin(phi)
    return -(p**2) * (moment + pushed * math.cos(phi - alpha))


@njit(cache=True)
def _peak(alpha, p, root_r, level, kappa, ground, h):  # type: ignore[no-untyped-def]
    """Return the largest φ (rad) over a ground acceleration at every half of a step h, s."""
    phi, rate, side, peak = 0.0, 0.0, 0.0, 0.0
    for step in range(0, ground.size - 2, 2):
        first, middle, last = ground[step], ground[step + 1], ground[step + 2]
        if side == 0.0:
            if abs(first) <= level:
                continue
            side = -math.copysign(1.0, first)
        k1 = _acceleration(alpha, p, kappa, phi, side * first)
        k2 = _acceleration(alpha, p, kappa, phi + 0.5 * h * rate, side * middle)
        onward = phi + 0.5 * h * rate + 0.25 * h**2 * k1
        k3 = _acceleration(alpha, p, kappa, onward, side * middle)
        onward = phi + h * rate + 0.5 * h**2 * k2
        k4 = _acceleration(alpha, p, kappa, onward, side * last)
        phi += h * rate + h**2 / 6.0 * (k1 + k2 + k3)
        rate += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        if phi < 0.0 and rate < 0.0:
            pull = _acceleration(alpha, p, kappa, phi, side * last)
            before = phi / rate  # how long before the end of the step φ was 0
            for _ in range(4):  # φ − rate t + pull t²/2 = 0
                excess = phi - rate * before + 0.5 * pull * before**2
                before -= excess / (pull * before - rate)
            left = -root_r * (rate - pull * before)
            side = -side
            push = _acceleration(alpha, p, kappa, 0.0, side * last)
            phi, rate = left * before + 0.5 * push * before**2, left + push * before
            if left < STILL * alpha * p:
                phi, rate, side = 0.0, 0.0, 0.0
        peak = max(peak, phi)
        if phi >= FLAT:
            break
    return peak


def restrained_peak_by_scipy(
    block: RockingBlock, kappa: float, motion: Excitation, *, duration: float, longest_step: float
) -> float:
    """Return the same for one block by DOP853 from impact to impact, each found by its event.

    Raises
    ------
    ArithmeticError
        When the integration fails.
    """
    p, alpha = block.frequency_parameter, block.slenderness
    times = np.linspace(0.0, duration, 50 * math.ceil(duration / longest_step) + 1)
    strong = np.abs(motion.excitation(times)) > block.uplift_acceleration
    segments = motion.segments(duration)
    starts = [one.start for one in segments]

    def ground(t: float) -> float:
        one = segments[bisect(starts, t) - 1]
        return one.acceleration(t) if t <= one.stop else 0.0

    def returns(t: float, y: Array) -> float:
        return float(y[0])

    def lies_flat(t: float, y: Array) -> float:
        return float(y[0]) - FLAT

    returns.direction, returns.terminal, lies_flat.terminal = -1.0, True, True  # type: ignore[attr-defined]
    time, side, rate, peak = 0.0, 0.0, 0.0, 0.0
    while time < duration:
        if side == 0.0:
            later = times[strong & (times >= time)]
            if not later.size:
                break
            time, rate = float(later[0]), 0.0
            side = -math.copysign(1.0, ground(time))

        def moves(t: float, y: Array, side: float = side) -> tuple[float, float]:
            phi, rate = y.tolist()
            free = math.sin(phi - alpha) - side * ground(float(t)) * math.cos(phi - alpha)
            return rate, p**2 * (free - kappa * math.sin(phi))

        found = solve_ivp(
            moves,
            (time, duration),
            (0.0, rate),
            method="DOP853",
            events=(returns, lies_flat),
            max_step=longest_step,
            rtol=1e-9,
            atol=1e-11,
        )
        if found.status < 0:
            raise ArithmeticError(f"{block}, {motion}: {found.message}")
        peak, time = max(peak, float(found.y[0].max())), float(found.t[-1])
        if peak >= FLAT or found.status == 0:
            break
        rate = -block.restitution * float(found.y[1, -1])
        side = 0.0 if rate < STILL * alpha * p else -side
    return min(peak, FLAT)
