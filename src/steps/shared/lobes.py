"""Ground motions of half-sine lobes: each has a sign, a length, an amplitude and a pause before it.

A sine of n cycles is 2n equal lobes of alternating sign.
"""

import warnings
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from topheavy import STANDARD_GRAVITY, Record


class Lobe(NamedTuple):
    """Half a sine: sign, length (s), amplitude (g), and the pause before it (s)."""

    sign: float
    length: float
    amplitude: float
    pause: float = 0.0


def sine(half_periods: int, length: float, amplitude: float, sign: float = 1.0) -> list[Lobe]:
    """Return the lobes of a sine of so many half periods, each of a length (s)."""
    return [Lobe(sign * (-1.0) ** number, length, amplitude) for number in range(half_periods)]


def record_of(lobes: Sequence[Lobe], time_step: float) -> Record:
    """Return the motion of lobes by its samples, with straight lines between them."""
    lengths = np.array([(lobe.pause, lobe.length) for lobe in lobes])
    ends = lengths.sum(axis=1).cumsum()
    time = time_step * np.arange(np.ceil(ends[-1] / time_step - 1e-9) + 1)
    ground = np.zeros(time.size)
    for lobe, end in zip(lobes, ends, strict=True):
        inside = (time > end - lobe.length) & (time < end)
        phase = np.pi * (time[inside] - end) / lobe.length + np.pi
        ground[inside] = lobe.sign * lobe.amplitude * np.sin(phase)
    with warnings.catch_warnings():  # that it is no measured motion
        warnings.simplefilter("ignore")
        return Record(time_step, ground)


def drawn(lobes: Sequence[Lobe], change: float, random: np.random.Generator) -> list[Lobe]:
    """Return the lobes with each length, amplitude and pause times 1 + change · N(0, 1)."""
    factors = 1.0 + change * random.standard_normal((len(lobes), 2))
    return [
        Lobe(
            lobe.sign,
            lobe.length * longer,
            lobe.amplitude * stronger,
            lobe.pause and lobe.pause * (1.0 + change * random.standard_normal()),
        )
        for lobe, (longer, stronger) in zip(lobes, factors, strict=True)
    ]


def half_range(motion: Record) -> float:
    """Return half the range of the ground velocity, m/s."""
    steps = 0.5 * (motion.acceleration[1:] + motion.acceleration[:-1]) * motion.time_step
    speeds = STANDARD_GRAVITY * np.append(0.0, np.cumsum(steps))
    return float(np.ptp(speeds)) / 2.0
