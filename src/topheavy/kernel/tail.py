"""Free rocking after the forcing, for the kernel: see `topheavy.bodies.free_rocking`."""

import math

from topheavy.bodies import free_rocking as closed
from topheavy.kernel.compiled import compiled

#: If the energy is within this relative distance of the barrier, the scalar kernel decides.
POISED_ENERGY = 1e-6

free_rocking = compiled(closed.ending)


@compiled
def safe_speed(block):
    """Return the speed below which, with the impulse still to come, a block surely survives.

    Between impacts de = −s a cos(α − φ) φ' dτ, |φ'| ≤ √(2e) below φ = α, and impacts lower e: hence
    √(2e) grows by ∫|a| dτ at most, and a block that stays below the barrier survives. A thousandth
    covers the errors of the steps.
    """
    return 0.999 * math.sqrt(2.0 * closed.barrier(block))


@compiled
def is_poised(block, rotation, velocity):
    """Return whether an energy is so near the barrier that rounding may decide what happens."""
    energy = 0.5 * velocity * velocity + closed.potential(block, rotation)
    after_impact = energy * block.restitution * block.restitution - closed.barrier(block)
    nearest = min(abs(closed.surplus(block, rotation, velocity)), abs(after_impact))
    return nearest < POISED_ENERGY * closed.barrier(block)
