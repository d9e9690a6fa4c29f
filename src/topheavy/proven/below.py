"""Every factor on a pulse from zero up to a bound survives: boxes of factors, each proven."""

from __future__ import annotations

from typing import Any

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.pulses import Pulse
from topheavy.proven.search import certified

NARROWEST = 1e-11
"""Of the highest factor: a box that is not wider counts as open if it is not proven."""

NARROWER, AGAIN, WIDER = 0.7, 0.95, 1.1
"""The width of the next box over that of one that is not proven, of one that had to become narrower
before it was, and of one that is proven at once."""


def survives_below(
    structure: Structure, pulse: Pulse, high: float
) -> tuple[list[dict[str, Any]], list[tuple[float, float]]]:
    """Return what proves that a structure survives all factors from 0 to `high` on a pulse.

    Returns
    -------
    list of dict
        Certificates of boxes of factors that survive, in ascending order.
    list of (float, float)
        The boxes that stay undecided, or that overturn: none if nothing overturns below.

    Raises
    ------
    ValueError
        As `certified`, and for a `high` that is not positive.
    """
    high = checks.positive("high", high)
    certificates, left = [], []
    low, width, after = 0.0, high, WIDER
    while low < high:
        top = min(low + width, high)
        width = top - low
        certificate = certified(structure, pulse, (low, top))
        if certificate and certificate["outcome"] == "survives":
            certificates.append(certificate)
        elif certificate or width < NARROWEST * high:
            left.append((low, top))
        else:
            width, after = NARROWER * width, AGAIN
            continue
        low, width, after = top, after * width, WIDER
    return certificates, left
