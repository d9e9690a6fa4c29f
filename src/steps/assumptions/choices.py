"""The choices that the paper leaves open: block, ground motion, criterion of overturning.

`Choices()` are ours; each alternative replaces one of them. Alternatives use only the public
functions of the library: a block of another p or √r, a record sampled from a changed pulse, or
another criterion for the same history.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from operator import attrgetter
from typing import TypeAlias

import numpy as np

from topheavy import Column, Pulse, Record, RockingBlock, RockingFrame, judge, simulate
from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.ground.excitation import Excitation
from topheavy.outcomes.simulate import TOLERANCE

Structure: TypeAlias = Column | RockingFrame
Criterion: TypeAlias = Callable[[RockingBlock, Excitation, float], bool]

RECTANGLE = 1.0 / 3.0
"""(Radius of gyration of a solid rectangular section over b)²."""


# From a structure to a block ---------------------------------------------------------------------


def solitary_restitution(structure: Structure) -> float:
    """Housner's √r of the solitary column, for the frame as well."""
    return (structure.column if isinstance(structure, RockingFrame) else structure).restitution


def massless(frame: RockingFrame) -> float:
    """√r of Eq. (25) for γ = ∞."""
    return RockingFrame(frame.column, math.inf).restitution


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


def ramped(pulse: Pulse, share: float, samples: int) -> Record:
    """Return a pulse that grows along half a cosine, over a share of its period 2π/ω."""
    times = np.linspace(0.0, pulse.duration, samples)
    grown = np.minimum(times * pulse.angular_frequency / (2.0 * math.pi * share), 1.0)
    window = 0.5 * (1.0 - np.cos(math.pi * grown))
    return Record(times[1], window * pulse.excitation(times))


def held(record: Record, parts: int = 4) -> Record:
    """Return a record whose samples are held until the next, but for the last of `parts`."""
    return Record(
        record.time_step / parts, np.repeat(record.acceleration, parts), record.name, unit="g"
    )


def curved(record: Record, parts: int = 4) -> Record:
    """Return a record with a cubic spline through its samples, sampled `parts` times as often."""
    from scipy.interpolate import CubicSpline

    old = np.arange(record.acceleration.size)
    new = np.arange((old.size - 1) * parts + 1) / parts
    values = CubicSpline(old, record.acceleration)(new)
    return Record(record.time_step / parts, values, record.name, unit="g")


# When it has overturned --------------------------------------------------------------------------


def by_energy(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
    """Its energy carries it over the barrier once the forcing has ended."""
    return judge(block, motion, tolerance=tolerance).overturned


def beyond_slenderness(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
    """|θ| exceeds α at any time: every block that overturns does, and some that return."""
    ending = judge(block, motion, tolerance=tolerance)
    return ending.overturned or ending.peak > block.slenderness


def after(wait: float, beyond: float = math.inf) -> Criterion:
    """Return the criterion that it is beyond `beyond` α, or flat, when `wait`/p has passed.

    The time counts from the end of the forcing. A block that lies flat has a rotation of NaN.
    """

    def criterion(block: RockingBlock, motion: Excitation, tolerance: float) -> bool:
        end = motion.duration + wait / block.frequency_parameter
        response = simulate(block, motion, samples=[end], tolerance=tolerance)
        return not abs(response.rotation[0]) <= beyond * block.slenderness

    return criterion


# All of them -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Choices:
    """The choices that the paper leaves open. The defaults are ours."""

    gravity: float = STANDARD_GRAVITY  # m/s²
    section: float | None = None  # (radius of gyration over b)²; None: the library's rectangle
    restitution: Callable[[Structure], float] = attrgetter("restitution")
    massless_restitution: Callable[[RockingFrame], float] = massless  # of Allen et al. (1986)
    linearised: bool = False
    ramp: float = 0.0  # of the period 2π/ω, over which a pulse grows
    overturned: Criterion = by_energy
    table_starts: tuple[float, ...] = (0.0, 1.0)  # shares of its speed taken up at once
    masses: tuple[float, float] | None = None  # kg, cap and both columns; None: γ as printed
    resampled: Callable[[Record], Record] = lambda record: record
    held: tuple[str, str] | None = None  # tops, and rigid or a period; None: all that are compared
    sense: str = "both"  # of "more stable": for each pulse, or for the minimum amplitude
    tolerance: float = TOLERANCE
    samples: int = 401  # of a pulse that has to be sampled

    def factors(self, structure: Structure) -> tuple[float, float]:
        """Return the factor on p of a structure, and its √r, negative if it cannot keep rocking."""
        if self.section is None:
            return 1.0, self.restitution(structure)
        return section_factors(structure, self.section)

    def block(self, structure: Structure) -> RockingBlock:
        """Return the block that a structure becomes."""
        factor, restitution = self.factors(structure)
        p = structure.frequency_parameter * factor * math.sqrt(self.gravity / STANDARD_GRAVITY)
        return RockingBlock(p, structure.slenderness, restitution, self.linearised)

    def motion(self, pulse: Pulse) -> Excitation:
        """Return the ground motion that a pulse becomes."""
        return ramped(pulse, self.ramp, self.samples) if self.ramp else pulse

    def falls(self, structure: Structure, pulse: Pulse) -> bool:
        """Return whether a pulse overturns a structure."""
        return self.overturned(self.block(structure), self.motion(pulse), self.tolerance)
