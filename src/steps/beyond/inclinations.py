"""Outcomes and free rocking by the inclinations of columns in a rigid-body engine."""

import math
from collections.abc import Iterable

import numpy as np

from topheavy import Column, Pulse

OVERTURNED = math.pi / 3  # inclination from which no pulse brings a column back, rad
WAIT, REST = 14.0, 0.5  # longest wait for an outcome, and shortest rest, times 1/p
UPRIGHT = 0.05  # inclination up to which a column counts as upright, times α
SMALLEST_PEAK = 0.02  # smallest peak of a bounce whose loss counts, times α


def overturn(looks: Iterable[tuple[float, float]], column: Column, pulse: Pulse) -> bool:
    """Return whether a pulse inclines a column by π/3, from times (s) and largest inclinations.

    Bodies survive if they rest after the pulse, turn back (impacts only take energy, so that they
    never come as far again), or still rock 14/p after it.
    """
    p, last, rises, upright_since = column.frequency_parameter, math.inf, False, math.inf
    for time, inclination in looks:
        if inclination > OVERTURNED:
            return True
        if time > pulse.duration + WAIT / p:
            return False
        if time > pulse.duration:
            is_upright = inclination < UPRIGHT * column.slenderness
            upright_since = min(upright_since, time) if is_upright else math.inf
            if (rises and inclination < last) or time - upright_since > REST / p:
                return False
            rises, last = inclination > last and not is_upright, inclination
    return False


def free_rocking(rotations: np.ndarray, time_step: float, column: Column) -> tuple[float, list]:
    """Return the time of the first impact (s), and √r of each, after a release from rest at θ > 0.

    The energy is constant between impacts. √r² therefore is the ratio of two rises of the centres
    of gravity: at the peak after an impact, and at the peak before it.
    """
    b, h = column.half_width, column.half_height
    impacts = np.flatnonzero(rotations[1:] * rotations[:-1] < 0.0) + 1
    after = impacts[0]
    share = rotations[after - 1] / (rotations[after - 1] - rotations[after])
    peaks = np.array([np.abs(part).max() for part in np.split(rotations, impacts)])
    peaks = peaks[peaks > SMALLEST_PEAK * column.slenderness]  # some bounce in few time steps
    rises = b * np.sin(peaks) - h * (1.0 - np.cos(peaks))
    return (after - 1 + share) * time_step, np.sqrt(rises[1:] / rises[:-1]).tolist()
