"""Random ground motions of many shapes: what a statement about any motion is tried on.

Amplitudes are 1 g tan α at most for a scale of 1; times are in 1/p of the solitary column.
"""

import math
from collections.abc import Callable

import numpy as np

from topheavy import Column, Pulse, Record

Vector = np.ndarray
Random = np.random.Generator

PULSES = ("one-sine", "one-cosine", "half-sine", "constant")
"""Shapes that begin with their first lobe; the others are sampled, in `ricker`."""


def knots(random: Random) -> Vector:
    """Lines between a few values of either sign."""
    return random.uniform(-1.0, 1.0, random.integers(2, 13))


def one_sided(random: Random) -> Vector:
    """Lines between a few values of one sign."""
    return random.uniform(0.0, 1.0, random.integers(2, 13)) * random.choice([-1.0, 1.0])


def single_lobe(random: Random) -> Vector:
    """A rise to one maximum and a fall, of one sign."""
    rising = np.sort(random.uniform(0.0, 1.0, random.integers(1, 7)))
    falling = -np.sort(-random.uniform(0.0, 1.0, random.integers(1, 7)))
    return np.concatenate([rising, [1.0], falling])


def impulses(random: Random) -> Vector:
    """A few narrow spikes, between which the ground rests."""
    values = np.zeros(random.integers(12, 60))
    where = random.choice(values.size, random.integers(2, 7), replace=False)
    values[where] = random.uniform(-1.0, 1.0, where.size)
    return values


def steps(random: Random) -> Vector:
    """Nearly constant accelerations, with jumps between them."""
    return np.repeat(random.uniform(-1.0, 1.0, random.integers(2, 7)), 8)


def noise(random: Random) -> Vector:
    """White noise that grows and fades, smoothed over a random length."""
    size = int(random.integers(40, 160))
    width = int(random.integers(1, 9))
    smooth = np.convolve(random.standard_normal(size), np.ones(width) / width, mode="same")
    return smooth * np.sin(np.linspace(0.0, math.pi, size)) ** random.uniform(0.3, 3.0)


def chirp(random: Random) -> Vector:
    """A sine of drifting frequency that grows and fades."""
    time = np.linspace(0.0, 1.0, 120)
    cycles, drift, phase = (
        random.uniform(1.0, 6.0),
        random.uniform(-0.8, 0.8),
        random.uniform(0, 6.3),
    )
    wave = np.sin(2.0 * math.pi * cycles * (time + 0.5 * drift * time**2) + phase)
    return wave * np.sin(math.pi * time) ** random.uniform(0.0, 2.0)


def ricker(random: Random) -> Vector:
    """A Ricker wavelet, symmetric or antisymmetric, in 160 samples."""
    shape = str(random.choice(["ricker-symmetric", "ricker-antisymmetric"]))
    pulse = Pulse(shape, float(random.choice([-1.0, 1.0])), 2.0 * math.pi)
    return pulse.excitation(np.linspace(0.0, pulse.duration, 160))


FAMILIES: tuple[Callable[[Random], Vector], ...] = (
    knots,
    one_sided,
    single_lobe,
    impulses,
    steps,
    noise,
    chirp,
    ricker,
)


def record(values: Vector, duration: float, column: Column, name: str = "") -> Record:
    """Return lines between 0, the values and 0, over a duration in 1/p; the largest is g tan α."""
    values = np.concatenate([[0.0], values, [0.0]])
    values *= column.uplift_acceleration / np.abs(values).max()
    return Record(duration / column.frequency_parameter / (values.size - 1), values, name)


def motion(random: Random, column: Column) -> Pulse | Record:
    """Return a random motion: of a family above, or a pulse of the library."""
    duration = math.exp(random.uniform(math.log(0.3), math.log(30.0)))
    family = random.integers(len(FAMILIES) + 1)
    if family == len(FAMILIES):
        omega = 2.0 * math.pi / duration * column.frequency_parameter
        return Pulse(str(random.choice(PULSES)), column.uplift_acceleration, omega)
    make = FAMILIES[family]
    return record(make(random), duration, column, make.__name__)
