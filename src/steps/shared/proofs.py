"""Outcomes that search and checker prove, and how close to a boundary."""

import json
from collections.abc import Iterable

from topheavy import Pulse, Record
from topheavy.bodies.structures import Structure
from topheavy.proven import certified
from topheavy.proven.certificate import BITS
from topheavy.proven.checking import Refused, check, concerns

WIDTHS = (1e-8, 1e-7, 1e-6)  # of a boundary: the tables have nine digits
DIGITS = (72, BITS)  # bits: the checker takes a quarter of the time where the first suffice


def proven(structure: Structure, motion: Pulse | Record) -> tuple[str, dict | None]:
    """Return an outcome that search and checker prove, or "undecided", and its certificate."""
    for bits in DIGITS:
        found, certificate = certified(structure, motion, bits=bits)
        if is_checked(certificate, structure, motion):
            return found.outcome, certificate
    return "undecided", None


def is_checked(
    certificate: dict | None,
    structure: Structure,
    motion: Pulse | Record,
    factor: float | tuple[float, float] = 1.0,
) -> bool:
    """Return whether there is a certificate of this problem, and the checker proves the same."""
    if certificate is None:
        return False
    try:
        concerns(certificate, structure, motion, factor)
        return check(certificate) == certificate["outcome"]
    except Refused:
        return False


def as_lines(certificates: Iterable[tuple[str, dict]]) -> str:
    """Return certificates in JSON Lines, each with the claim that it is a part of."""
    made = ({"claim": claim, **certificate} for claim, certificate in certificates)
    return "".join(f"{json.dumps(each, ensure_ascii=False, allow_nan=False)}\n" for each in made)
