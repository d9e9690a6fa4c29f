"""Rocking with a coefficient of restitution of its own at every impact, by Runge–Kutta steps.

The solvers of the library take one √r for all impacts. This one takes a row of them, in fixed steps
within each sample of a record; `topheavy.reference.judge` with `restitutions` is its second route.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from topheavy import Record
from topheavy.motion import COUNTED_PEAK
from topheavy.structures import Structure

LONGEST = 0.02
"""1/p: the longest step."""

SLOWEST = 1e-5
"""Of αp: slower, after an impact, a block rests if the ground does not lift it."""

BISECTIONS = 40


def overturned_with(
    structure: Structure, record: Record, factors: ArrayLike, restitutions: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which factors on a record overturn a block whose k-th impact has the k-th √r.

    Parameters
    ----------
    restitutions : ndarray, shape (n, m)
        A row for each factor; beyond the last impact of a row its last value is taken.
    """
    block = structure.block()
    scales = np.asarray(factors, dtype=float)
    p, alpha = block.frequency_parameter, block.slenderness
    found = np.zeros(scales.size, dtype=bool)
    for k, scale in enumerate(scales):
        step = p * record.time_step
        found[k] = _overturns(alpha, step, scale * record.acceleration, restitutions[k])
    return found


@njit(cache=True)
def _second(alpha, side, phi, ground):  # type: ignore[no-untyped-def]
    lean = alpha - phi
    return -math.sin(lean) - side * ground * math.cos(lean)  # Eq. (23), time in 1/p


@njit(cache=True)
def _stepped(alpha, side, phi, rate, first, slope, h):  # type: ignore[no-untyped-def]
    """Return φ and φ' after a step h of the classical Runge–Kutta method."""
    k1 = _second(alpha, side, phi, first)
    k2 = _second(alpha, side, phi + 0.5 * h * rate, first + 0.5 * h * slope)
    k3 = _second(alpha, side, phi + 0.5 * h * (rate + 0.5 * h * k1), first + 0.5 * h * slope)
    k4 = _second(alpha, side, phi + h * (rate + 0.5 * h * k2), first + h * slope)
    return (
        phi + h * rate + h * h / 6.0 * (k1 + k2 + k3),
        rate + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4),
    )


@njit(cache=True)
def _overturns(alpha, step, samples, ratios):  # type: ignore[no-untyped-def]
    """Follow the block through the record, and judge its energy at the end."""
    level, flat = math.tan(alpha), math.pi / 2.0
    phi, rate, side, impacts, moving, height = 0.0, 0.0, 1.0, 0, False, 0.0
    pieces = max(1, math.ceil(step / LONGEST))
    h = step / pieces
    for k in range(samples.size - 1):
        slope = (samples[k + 1] - samples[k]) / step
        for piece in range(pieces):
            begin, left = samples[k] + slope * piece * h, h
            while left > 0.0:
                if not moving:
                    end = begin + slope * left
                    if abs(begin) <= level and abs(end) <= level:
                        break
                    if abs(begin) <= level:  # it uplifts within the step
                        ahead = (math.copysign(level, end) - begin) / slope
                        begin, left = math.copysign(level, end), left - ahead
                    side = -1.0 if begin > 0.0 else 1.0
                    moving, phi, rate, height = True, 0.0, 0.0, 0.0
                after, after_rate = _stepped(alpha, side, phi, rate, begin, slope, left)
                if after >= flat:
                    return True
                if after > 0.0 or after_rate >= 0.0:
                    phi, rate = max(after, 0.0), after_rate
                    height = max(height, phi)
                    break
                low, high = 0.0, left
                for _ in range(BISECTIONS):
                    middle = 0.5 * (low + high)
                    at, _ = _stepped(alpha, side, phi, rate, begin, slope, middle)
                    if at > 0.0:
                        low = middle
                    else:
                        high = middle
                _, speed = _stepped(alpha, side, phi, rate, begin, slope, high)
                ratio = ratios[min(impacts, ratios.size - 1)]
                if height > COUNTED_PEAK * alpha:
                    impacts += 1
                begin, left = begin + slope * high, left - high
                phi, rate, side, height = 0.0, ratio * max(0.0, -speed), -side, 0.0
                if rate < SLOWEST * alpha:
                    moving = False
                    if abs(begin) > level:  # lifted again at once
                        continue
                    # what is left of the step may lift it: the loop looks
    if not moving:
        return False
    summit = 1.0 - math.cos(alpha)
    energy = 0.5 * rate * rate + math.cos(alpha - phi) - math.cos(alpha)
    if phi > alpha and (rate > 0.0 or energy < summit):
        return True
    if rate > 0.0:
        return energy >= summit
    ratio = ratios[min(impacts, ratios.size - 1)]
    return ratio * ratio * energy >= summit
