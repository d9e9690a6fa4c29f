"""Synthetic motions by filtered noise: soil of Kanai and Tajimi, filter of Clough and Penzien.

The soil is a damped oscillator whose absolute acceleration under white noise has the density

    S(f) = (1 + 4 ζ² u²) / ((1 − u²)² + 4 ζ² u²),    u = f/f_soil.

An envelope multiplies this stationary noise: it rises with the square of the time, is constant, and
decays. S(0) > 0 would leave a velocity. A second oscillator, w = f/f_corner, takes it out:

    w⁴ / ((1 − w²)² + 4 ζ² w²).

It acts on the motion as a whole, with zero phase, so that the velocity ends at zero. Both forms are
those of textbooks, which we could not look up; the numbers are ours.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.fft import irfft, rfft, rfftfreq

from steps.shared.synthetic import TIME_STEP, Vector, between_zeros, generator, modulation
from topheavy import Record

DAMPING = 0.6
"""ζ of both oscillators."""

RISE, CONSTANT, DURATION, DECAY = 3.0, 10.0, 30.0, 0.25
"""Times of the envelope, s: its rise, its constant part and its length; its decay, 1/s."""


@dataclass(frozen=True)
class Soil:
    """A soil and the second filter: their frequencies, Hz."""

    frequency: float
    corner: float


def density_of_soil(ratio: Vector) -> Vector:
    """Return S of the soil at f/f_soil."""
    damped = (2.0 * DAMPING * ratio) ** 2
    return (1.0 + damped) / ((1.0 - ratio**2) ** 2 + damped)


def density_of_filter(ratio: Vector) -> Vector:
    """Return what the second filter leaves of the density at f/f_corner."""
    return np.square(np.square(ratio)) / ((1.0 - ratio**2) ** 2 + (2.0 * DAMPING * ratio) ** 2)


def envelope(time: Vector) -> Vector:
    """Return the envelope at these times, s."""
    decaying: Vector = modulation(time - CONSTANT, 0.0, DECAY, RISE)
    return np.minimum(time / RISE, 1.0) ** 2 * decaying


def motion(seed: int, number: int, soil: Soil) -> Record:
    """Return motion `number`, which depends on nothing else: of unit intensity, to be scaled."""
    rng = generator(seed, number)
    size = round(DURATION / TIME_STEP)
    time, frequency = np.arange(size) * TIME_STEP, rfftfreq(size, TIME_STEP)
    gains = np.sqrt(density_of_soil(frequency / soil.frequency))
    stationary = irfft(rfft(rng.standard_normal(size)) * gains, size)
    shaking, _ = between_zeros(
        stationary * envelope(time), soil.corner, lambda ratio: np.sqrt(density_of_filter(ratio))
    )
    peak = math.sqrt(np.mean(shaking**2))
    name = f"filtered noise {soil.frequency:g} Hz, {soil.corner:g} Hz {seed}:{number}"
    return Record(TIME_STEP, 0.1 * shaking / peak, name, unit="g")
