"""The model of Allen et al. (1986) as the paper describes it: linearised, with massless columns.

Their equation is the linearised one in the limit γ → ∞ (p. 1). The paper does not say which impact
law they used; we assume Eq. (25) in the same limit, √r = cos 2α. Each of the three simplifications
can be applied alone, which shows the error of each.
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
