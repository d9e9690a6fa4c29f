"""Free rocking in closed form: what happens once the ground stands still.

With K the kinetic energy (over p²) that the block would land with, and H that which it would have
at φ = α, energy conservation between impacts gives everything:

    K = φ'²/2 + cos(α − φ) − cos α        H = K − (1 − cos α)        (exact)
    K = φ'²/2 + α φ − φ²/2                H = K − α²/2               (linearised)

and an impact multiplies K by r. A block with H < 0 on the near side of φ = α stays there.
"""

import math
from typing import NamedTuple

from topheavy.kernel.compiled import compiled

#: Histories whose energy is nearer the barrier, relative to it, are followed by one routine alone.
POISED = 1e-6


class Tail(NamedTuple):
    """The outcome of free rocking; `peak` is the largest φ still to come, `impacts` those on the
    way to overturning."""

    overturned: bool
    peak: float
    impacts: int


@compiled
def landing_energy(block, rotation, velocity):
    """Return K, without cancellation for small φ."""
    kinetic = 0.5 * velocity * velocity
    if block.linearised:
        return kinetic + rotation * (block.slenderness - 0.5 * rotation)
    half = 0.5 * rotation
    return kinetic + 2 * math.sin(block.slenderness - half) * math.sin(half)


@compiled
def barrier(block):
    """Return K − H: the energy between lying at φ = 0 and standing at φ = α."""
    if block.linearised:
        return 0.5 * block.slenderness * block.slenderness
    return 2 * math.sin(0.5 * block.slenderness) ** 2


@compiled
def safe_speed(block):
    """Return the speed below which, with the impulse still to come, a block surely survives.

    Between impacts dK = −s a cos(α − φ) φ' dτ, |φ'| ≤ √(2K) below φ = α, and impacts lower K: hence
    √(2K) grows by ∫|a| dτ at most, and a block that stays below the barrier survives. A thousandth
    covers the errors of the steps.
    """
    return 0.999 * math.sqrt(2.0 * barrier(block))


@compiled
def surplus(block, rotation, velocity):
    """Return H, without cancellation near φ = α."""
    kinetic = 0.5 * velocity * velocity
    if block.linearised:
        return kinetic - 0.5 * (block.slenderness - rotation) ** 2
    return kinetic - 2 * math.sin(0.5 * (block.slenderness - rotation)) ** 2


@compiled
def turning_rotation(block, energy):
    """Return the φ < α at which a block of landing energy K below the barrier turns back."""
    below = barrier(block) - energy
    if block.linearised:
        return energy / (0.5 * (block.slenderness + math.sqrt(2 * below)))
    # φ = α − 2 asin √(below/2), with sin²x − sin²y = sin(x − y) sin(x + y), x = α/2:
    half_angle = math.asin(math.sqrt(0.5 * below))
    return 2 * math.asin(0.5 * energy / math.sin(0.5 * block.slenderness + half_angle))


@compiled
def is_poised(block, rotation, velocity):
    """Return whether an energy is so near the barrier that rounding may decide what happens."""
    energy = landing_energy(block, rotation, velocity)
    after_impact = energy * block.restitution * block.restitution - barrier(block)
    nearest = min(abs(surplus(block, rotation, velocity)), abs(after_impact))
    return nearest < POISED * barrier(block)


@compiled
def free_rocking(block, rotation, velocity):
    """Return the `Tail` from φ and φ' at the end of the forcing."""
    surplus_now = surplus(block, rotation, velocity)
    if rotation > block.slenderness and (velocity >= 0.0 or surplus_now < 0.0):
        return Tail(True, math.nan, 0)
    if velocity > 0.0 and surplus_now >= 0.0:
        return Tail(True, math.nan, 0)
    energy = landing_energy(block, rotation, velocity)
    if velocity >= 0.0:
        return Tail(False, max(rotation, turning_rotation(block, energy)), 0)
    energy *= block.restitution * block.restitution
    if energy >= barrier(block):  # it passes through upright and overturns to the other side
        return Tail(True, math.nan, 1)
    return Tail(False, max(rotation, turning_rotation(block, energy)), 0)
