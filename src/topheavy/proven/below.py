"""Every factor on a pulse from zero up to a bound survives: boxes of factors, each proven."""

from __future__ import annotations

from typing import Any

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.pulses import Pulse
from topheavy.proven.prover import certified

MIN_BOX_WIDTH = 1e-11
"""Relative to the highest factor: a narrower box that is not proven stays undecided."""

AFTER_FAILURE, AFTER_RETRY, AFTER_SUCCESS = 0.7, 0.95, 1.1
"""Width of the next box over the last one, which was not proven, proven after a failure, or proven
at the first try."""


def survives_below(
    structure: Structure, pulse: Pulse, high: float
) -> tuple[list[dict[str, Any]], list[tuple[float, float]]]:
    """Prove, box by box, that a structure survives all factors from 0 to `high` on a pulse.

    Returns
    -------
    list of dict
        Certificates of boxes of factors that survive, in ascending order.
    list of (float, float)
        Boxes that are undecided or overturn; none if every factor is proven to survive.

    Raises
    ------
    ValueError
        As `certified`, and for a `high` that is not positive.
    """
    high = checks.positive("high", high)
    certificates, undecided = [], []
    low, width, growth = 0.0, high, AFTER_SUCCESS
    while low < high:
        top = min(low + width, high)
        width = top - low
        certificate = certified(structure, pulse, (low, top))
        if certificate and certificate["outcome"] == "survives":
            certificates.append(certificate)
        elif certificate or width < MIN_BOX_WIDTH * high:
            undecided.append((low, top))
        else:
            width, growth = AFTER_FAILURE * width, AFTER_RETRY
            continue
        low, width, growth = top, growth * width, AFTER_SUCCESS
    return certificates, undecided
