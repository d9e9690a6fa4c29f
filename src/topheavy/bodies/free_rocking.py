"""Free rocking in closed form: energy, turning rotation, quarter period, the end of a motion.

Without ground motion the energy per unit inertia is conserved between impacts, so that no
integration is necessary. With φ = |θ| and φ' = φ̇/p,

    e = φ'²/2 + w(φ),    w = cos(α − φ) − cos α  (exact),    w = φ (α − φ/2)  (linearised)

where w is the area under the moment–rotation curve of Fig. 1(b). Its summit is at φ = α. An impact
multiplies e by r. The kernel compiles these functions.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.bodies.response import Response
from topheavy.bodies.structures import Column, RockingBlock, RockingFrame, Structure


class Outcome(NamedTuple):
    """How a motion ends when the ground has come to rest.

    Attributes
    ----------
    overturned : bool
    peak_rotation : float
        Largest φ still to come, rad; NaN if overturned.
    number_of_impacts : int
        Impacts on the way to overturning; 0 for a survivor, whose bouncing is not counted.

    Examples
    --------
    >>> pulse = th.Pulse("one-sine", 1.0, angular_frequency=2.0)
    >>> th.judge(th.Column(0.5, 3.0), pulse.scaled(0.18)).number_of_impacts
    5
    """

    overturned: bool
    peak_rotation: float
    number_of_impacts: int


@register_jitable
def potential(block: Any, rotation: float) -> float:
    """Return w(φ), the potential energy normalised by I·p², of φ in rad."""
    half, alpha = 0.5 * rotation, block.slenderness
    if block.linearised:
        return float(rotation * (alpha - half))
    return 2.0 * math.sin(alpha - half) * math.sin(half)


@register_jitable
def barrier(block: Any) -> float:
    """Return w(α), the energy at the point of unstable equilibrium."""
    return potential(block, block.slenderness)


@register_jitable
def surplus(block: Any, rotation: float, velocity: float) -> float:
    """Return e − w(α), without cancellation near φ = α."""
    kinetic, off = 0.5 * velocity * velocity, block.slenderness - rotation
    if block.linearised:
        return float(kinetic - 0.5 * off**2)
    return float(kinetic - 2.0 * math.sin(0.5 * off) ** 2)


@register_jitable
def turning_rotation(block: Any, level: float) -> float:
    """Return the φ in [0, α] (rad) at which a block of energy `level` ≤ w(α) turns back."""
    alpha, below = block.slenderness, barrier(block) - level
    if block.linearised:
        return float(level / (0.5 * (alpha + math.sqrt(2.0 * below))))
    # φ = α − 2 asin √(below/2), with sin²x − sin²y = sin(x − y) sin(x + y), x = α/2:
    half_angle = math.asin(math.sqrt(0.5 * below))
    return 2.0 * math.asin(0.5 * level / math.sin(0.5 * alpha + half_angle))


@register_jitable
def outcome_of_energy(block: Any, rotation: float, velocity: float) -> Outcome:
    """Return how the motion ends from the state (φ in rad, φ̇/p) at the end of the forcing.

    Overturned is: φ > α and moving outward, or inward with less energy than the barrier; or φ ≤ α,
    moving outward with at least that energy. Otherwise the block goes through its next impact and
    is judged again. φ > α alone is not overturning.
    """
    excess = surplus(block, rotation, velocity)
    if rotation > block.slenderness and (velocity >= 0.0 or excess < 0.0):
        return Outcome(True, math.nan, 0)
    if velocity > 0.0 and excess >= 0.0:
        return Outcome(True, math.nan, 0)
    level = 0.5 * velocity * velocity + potential(block, rotation)
    if velocity < 0.0:
        level *= block.restitution * block.restitution
        if level >= barrier(block):  # it passes through upright and overturns to the other side
            return Outcome(True, math.nan, 1)
    return Outcome(False, max(rotation, turning_rotation(block, level)), 0)


def energy(block: RockingBlock, rotation: float, rate: float) -> float:
    """Return e of φ in rad and φ̇ in rad/s."""
    return 0.5 * (rate / block.frequency_parameter) ** 2 + potential(block, rotation)


def quarter_period(structure: Structure, rotation: float) -> float:
    """Return the time (s) from rest at θ0 (rad) to the first impact.

    The linearised block has arccosh(1/(1 − θ0/α))/p (Housner 1963). The exact one has ∫ dφ / φ̇ by
    the conservation of energy; with φ = θ0 (1 − x²) the integrand is smooth. 0 < θ0 < α.
    """
    from scipy.integrate import quad

    block = structure.block()
    alpha, p = block.slenderness, block.frequency_parameter
    start = checks.finite("rotation", rotation)
    if not 0.0 < start < alpha:
        raise ValueError(f"rotation is {start:.6g} rad; expected between 0 and α = {alpha:.6g} rad")
    if block.linearised:
        return math.acosh(1.0 / (1.0 - start / alpha)) / p

    def integrand(x: float) -> float:
        if x == 0.0:
            return math.sqrt(2.0 * start / math.sin(alpha - start))
        half_drop = start * x * x / 2.0
        # w(θ0) − w(φ) = 2 sin(α − θ0 + half_drop) sin(half_drop)
        drop = 2.0 * math.sin(alpha - start + half_drop) * math.sin(half_drop)
        return 2.0 * start * x / math.sqrt(2.0 * drop)

    value, _ = quad(integrand, 0.0, 1.0, epsabs=0.0, epsrel=1e-12)
    return float(value) / p


def energy_drift(block: RockingBlock, response: Response, flights: int) -> float:
    """Return the largest change of energy over the first flights of free rocking, relative to it.

    Between impacts the moment–rotation curve of Fig. 1(b) encloses no area, so that any change is
    an error of the solver.
    """
    motion = zip(np.abs(response.rotation), np.abs(response.velocity), strict=True)
    levels = np.array([energy(block, phi, rate) for phi, rate in motion])
    flight = np.searchsorted(response.impact_times[:flights], response.time, side="right")
    inside = [levels[flight == number] for number in range(flights)]
    return max(float(np.ptp(level) / level.mean()) for level in inside)


def restoring_moment(structure: Column | RockingFrame, rotation: ArrayLike) -> NDArray[np.float64]:
    """Return the restoring moment normalised by m_c g R of one column at rotations θ (rad, signed).

    For the solitary column it is sin(α − |θ|), opposed to the rotation. In the frame each column
    also carries half of the cap beam at the end of its diagonal, twice as far from the pivot; the
    moment is therefore 1 + 2γ times as high. At θ = 0 the moment balances the ground motion, up to
    the value returned for θ → 0 from above.
    """
    share = 1.0
    if isinstance(structure, RockingFrame):
        if structure.mass_ratio == math.inf:
            raise ValueError("mass_ratio is inf; expected a finite γ, as m_c g R is 0 for γ = ∞")
        share += 2.0 * structure.mass_ratio
    theta = np.asarray(rotation, dtype=float)
    side = np.where(theta < 0.0, -1.0, 1.0)
    moment: NDArray[np.float64] = share * side * np.sin(structure.slenderness - np.abs(theta))
    return moment
