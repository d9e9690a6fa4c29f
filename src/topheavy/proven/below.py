"""Every factor on a pulse from zero up to a bound survives: boxes of factors, each proven.

0 ─ no uplift ─ bounded by the lemma ─ followed and bounded ─ followed ─ high
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.pulses import Pulse
from topheavy.proven.balls import decimal
from topheavy.proven.certificate import BITS, certified

NARROWEST = 1e-11
"""Of the highest factor: a box that is not wider counts as open if it is not proven."""

NARROW = 1e-9
"""Of the highest factor: narrower boxes get more digits."""

SPARE = 0.1
"""Of a box: so far beyond each end it is proven, since the enclosures of the checker are wider."""

NARROWER, AGAIN, WIDER = 0.7, 0.95, 1.1
"""The width of the next box over that of one that is not proven, of one that had to become narrower
before it was, and of one that is proven at once."""


@dataclass(frozen=True)
class Below:
    """What is proven of all factors from 0 to `high`.

    Attributes
    ----------
    certificates : list of dict
        One for each box of factors that survives, in ascending order (`certified`).
    open : list of (float, float)
        The boxes that stayed undecided, or that overturn: none if nothing overturns below.
    """

    high: float
    certificates: list[dict[str, Any]]
    open: list[tuple[float, float]]


def survives_below(
    structure: Structure,
    pulse: Pulse,
    high: float,
    *,
    linearised: bool = False,
    accepts: Callable[[dict[str, Any]], bool] = lambda certificate: True,
) -> Below:
    """Return boxes that prove which factors from 0 to `high` on a pulse are survived.

    A box that is not proven, or whose certificate `accepts` refuses, is tried again narrower, down
    to `NARROWEST`. `accepts` may be a second proof (false where `checking.check` raises).

    Raises
    ------
    ValueError
        As `topheavy.proven.search`, and for a `high` that is not positive.
    """
    high = checks.positive("high", high)
    below, low, width, after = Below(high, [], []), 0.0, high, WIDER
    while low < high:
        top = min(low + width, high)
        width = top - low
        spare = SPARE * width
        found, certificate = certified(
            structure,
            pulse,
            factor=(max(0.0, low - spare), top + spare),
            linearised=linearised,
            bits=BITS if width < NARROW * high else 72,
            bounded=True,
        )
        if certificate is not None:
            certificate["factor"] = [str(decimal(end)) for end in (low, top)]
        if found.outcome == "survives" and certificate is not None and accepts(certificate):
            below.certificates.append(certificate)
        elif found.outcome == "overturns" or width < NARROWEST * high:
            below.open.append((low, top))
        else:
            width, after = NARROWER * width, AGAIN
            continue
        low, width, after = top, after * width, WIDER
    return below
