"""What the paper leaves open, as one value: how a structure becomes a block, how it is shaken and
when it is called overturned. `Choices()` are ours; each alternative replaces one of them.

All is done from outside, by what the library offers: a block of another p or √r, a record that is
sampled from a changed pulse, another reading of the same history.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from topheavy import Column, Pulse, Record, RockingBlock, RockingFrame, judge, simulate
from topheavy.excitation import Excitation
from topheavy.simulate import TOLERANCE
from topheavy.structures import STANDARD_GRAVITY

Structure: TypeAlias = Column | RockingFrame
Shaking: TypeAlias = Callable[[Pulse, RockingBlock, int], Excitation]
Criterion: TypeAlias = Callable[[RockingBlock, Excitation, float], bool]

RECTANGLE = 1.0 / 3.0
"""(Radius of gyration of a solid rectangular section over b)²."""


# From a structure to a block ---------------------------------------------------------------------


def own_restitution(structure: Structure) -> float:
    """√r of Eq. (25), or Housner's of a solitary column."""
    return structure.restitution


def solitary_restitution(structure: Structure) -> float:
    """Housner's √r of the solitary column, for the frame as well."""
    return (structure.column if isinstance(structure, RockingFrame) else structure).restitution


def gravity_factor(gravity: float) -> float:
    """Return what p is multiplied by when g is `gravity` (m/s²) in place of the library's."""
    return math.sqrt(gravity / STANDARD_GRAVITY)


def section_factors(structure: Structure, section: float) -> tuple[float, float]:
    """Return the factor on p and the √r of columns whose section is not a solid rectangle.

    With I_o = ι m R², ι = (4/3) cos²α + (1 + section) sin²α, Eqs. (18) and (25) become

        p̂² = (g/R) (1 + 2γ)/(ι + 4γ),    √r = (ι − 2 sin²α + 4γ cos 2α)/(ι + 4γ)

    where section is (radius of gyration of the section over b)²: 1/3 for the solid rectangle.
    """
    alpha = structure.slenderness
    sine, cosine = math.sin(alpha) ** 2, math.cos(alpha) ** 2
    inertia = 4.0 / 3.0 * cosine + (1.0 + section) * sine
    gamma = structure.mass_ratio if isinstance(structure, RockingFrame) else 0.0
    if gamma == math.inf:
        return 1.0, math.cos(2.0 * alpha)
    whole = inertia + 4.0 * gamma
    factor = math.sqrt((4.0 / 3.0 + 4.0 * gamma) / whole)
    return factor, (inertia - 2.0 * sine + 4.0 * gamma * math.cos(2.0 * alpha)) / whole


# The ground motion -------------------------------------------------------------------------------


def abrupt(pulse: Pulse, block: RockingBlock, samples: int) -> Excitation:
    """The pulse itself, which begins at once."""
    return pulse


def ramped(share: float) -> Shaking:
    """Return what lets a pulse grow along half a cosine, over a share of its period 2π/ω."""

    def shaking(pulse: Pulse, block: RockingBlock, samples: int) -> Record:
        times = np.linspace(0.0, pulse.duration, samples)
        rise = share * 2.0 * math.pi / pulse.angular_frequency
        grown = np.clip(times / rise, 0.0, 1.0) if rise > 0.0 else np.ones_like(times)
        window = 0.5 * (1.0 - np.cos(math.pi * grown))
        return Record(times[1], window * pulse.excitation(times))

    return shaking


def from_uplift(pulse: Pulse, block: RockingBlock, samples: int) -> Record:
    """The pulse from the instant at which it first exceeds the uplift acceleration."""
    segments = pulse.segments(pulse.duration)
    found = (segment.uplift(segment.start, block.uplift_acceleration) for segment in segments)
    start = next((time for time in found if time is not None), 0.0)
    times = np.linspace(start, pulse.duration, samples)
    return Record(times[1] - times[0], pulse.excitation(times))


# When it has overturned --------------------------------------------------------------------------


def by_energy(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
    """Its energy carries it over the barrier once the forcing has ended."""
    return judge(block, motion, tolerance=tolerance).overturned


def beyond_slenderness(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
    """|θ| exceeds α at any time. Whatever overturns does; so do some that come back."""
    ending = judge(block, motion, tolerance=tolerance)
    return ending.overturned or ending.peak > block.slenderness


def _waited(block: RockingBlock, motion: Excitation, wait: float, tolerance: float) -> float:
    """Return |θ| (rad) when `wait`/p has passed since the end of the forcing; NaN lies flat."""
    end = motion.duration + wait / block.frequency_parameter
    return abs(float(simulate(block, motion, samples=[end], tolerance=tolerance).rotation[0]))


def flat_after(wait: float) -> Criterion:
    """Return the criterion that it lies flat, |θ| = π/2, when `wait`/p has passed."""
    return lambda block, motion, tolerance: math.isnan(_waited(block, motion, wait, tolerance))


def beyond_after(wait: float) -> Criterion:
    """Return the criterion that |θ| > α when `wait`/p has passed since the forcing ended."""
    return lambda block, motion, tolerance: (
        not _waited(block, motion, wait, tolerance) <= block.slenderness
    )


def settled(threshold: float, samples: int = 400) -> Criterion:
    """Return the criterion of energy, of a block that rests once a bounce stays below a threshold.

    The threshold is in α. The forcing that follows the rest shakes the block anew, from rest.
    """

    def criterion(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
        rest = first_small_bounce(block, motion, threshold, tolerance)
        if rest is None:
            return by_energy(block, motion, tolerance)
        times = np.linspace(rest, motion.duration, samples)
        remaining = Record(times[1] - times[0], motion.excitation(times))
        return criterion(block, remaining, tolerance)

    return criterion


def flights(block: RockingBlock, motion: Excitation, tolerance: float) -> list[tuple[float, float]]:
    """Return when each flight of a forced motion ended, s, and its peak over α.

    Impacts that follow the forcing are left out; the last one is what ends the last flight.
    """
    response = simulate(block, motion, samples=2, tolerance=tolerance)
    ends = response.impacts[response.impacts < motion.duration]
    if not len(ends):
        return []
    starts = np.concatenate([[0.0], ends[:-1]])
    inside = np.linspace(0.0, 1.0, 22)[1:-1]
    times = starts[:, None] + inside * (ends - starts)[:, None]
    history = simulate(block, motion, samples=times.ravel(), tolerance=tolerance)
    peaks = np.abs(history.rotation).reshape(times.shape).max(axis=1) / block.slenderness
    return list(zip(ends.tolist(), peaks.tolist(), strict=True))


def first_small_bounce(
    block: RockingBlock, motion: Excitation, threshold: float, tolerance: float
) -> float | None:
    """Return the first impact, s, after a flight that peaked below `threshold` α, or None.

    A flight that begins from rest is none that ends in it: its peak grows from nothing.
    """
    if judge(block, motion, tolerance=tolerance).impacts < 2:
        return None  # the short way for most
    found = flights(block, motion, tolerance)
    return next((time for time, peak in found[1:] if peak < threshold), None)


# All of them -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Choices:
    """What the paper leaves open. The defaults are ours."""

    gravity: float = STANDARD_GRAVITY  # m/s²
    section: float | None = None  # (radius of gyration over b)²; None: the library's rectangle
    restitution: Callable[[Structure], float] = own_restitution
    massless_restitution: Callable[[RockingFrame], float] | None = None  # of Allen et al.; None:
    # Eq. (25) for γ = ∞
    linearised: bool = False
    shaking: Shaking = abrupt
    overturned: Criterion = by_energy
    table_starts: tuple[float, ...] = (0.0, 1.0)  # shares of its speed taken up at once
    rest: float = 0.0  # of α: rocking that stays below is called rest; 0: the library's 1e-6
    masses: tuple[float, float] | None = None  # kg, cap and both columns; None: γ as printed
    carried: bool = False  # the printed digits are what the passage goes on with
    counted: float = 0.0  # of α: flights below do not count; 0: the library's 1e-6
    resampled: Callable[[Record], Record] = lambda record: record
    sense: str = "both"  # of "more stable": pulse by pulse, or by the lowest amplitude
    tolerance: float = TOLERANCE
    samples: int = 401  # of a pulse that has to be sampled

    def block(self, structure: Structure) -> RockingBlock:
        """Return the block that a structure becomes."""
        p, restitution = structure.frequency_parameter, self.restitution(structure)
        if self.section is not None:
            factor, restitution = section_factors(structure, self.section)
            p *= factor
        p *= gravity_factor(self.gravity)
        return RockingBlock(p, structure.slenderness, restitution, self.linearised)

    def motion(self, structure: Structure, pulse: Pulse) -> Excitation:
        """Return the ground motion that a pulse becomes."""
        return self.shaking(pulse, self.block(structure), self.samples)

    def falls(self, structure: Structure, pulse: Pulse) -> bool:
        """Return whether a pulse overturns a structure."""
        return self.overturned(self.block(structure), self.motion(structure, pulse), self.tolerance)


def held(record: Record, parts: int = 4) -> Record:
    """Return a record whose samples are held until the next, but for the last of `parts`."""
    return Record(record.time_step / parts, np.repeat(record.acceleration, parts), record.name)


def curved(record: Record, parts: int = 4) -> Record:
    """Return a record with a cubic spline through its samples, sampled `parts` times as often."""
    from scipy.interpolate import CubicSpline

    old = np.arange(record.acceleration.size)
    new = np.arange((old.size - 1) * parts + 1) / parts
    values = CubicSpline(old, record.acceleration)(new)
    return Record(record.time_step / parts, values, record.name)
