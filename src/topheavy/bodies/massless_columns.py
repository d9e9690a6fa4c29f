"""The model of Allen et al. (1986): linearised, with columns of no mass, as the paper tells it.

Their equation is the linearised one in the limit γ → ∞ (p. 1). What impact law they used the paper
does not say: Eq. (25) in the same limit, √r = cos 2α, is an assumption.

The three simplifications can be made one at a time, so that the error of each is seen apart.
"""

import math

from topheavy.bodies.structures import RockingBlock, RockingFrame

SIMPLIFICATIONS = ("linearised", "massless frequency", "massless restitution", "all")
"""The equation of motion; p̂ of γ = ∞; √r of γ = ∞; and the three together, Allen et al. (1986)."""


def simplified(frame: RockingFrame, simplification: str) -> RockingBlock:
    """Return the block of a frame under one of `SIMPLIFICATIONS`.

    Raises
    ------
    ValueError
        For an unknown simplification, or where √r is negative.
    """
    exact, massless = frame.block(), RockingFrame(frame.column, math.inf).block()
    if simplification == "linearised":
        return exact.linear()
    if simplification == "massless frequency":
        return massless.with_restitution(exact.restitution)
    if simplification == "massless restitution":
        return exact.with_restitution(massless.restitution)
    if simplification == "all":
        return massless.linear()
    raise ValueError(
        f"simplification is {simplification!r}; expected one of {', '.join(SIMPLIFICATIONS)}"
    )
