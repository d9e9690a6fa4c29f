"""Outcomes that search and checker prove, and how close to a boundary."""

from topheavy import Pulse, Record
from topheavy.proven import certified
from topheavy.proven.checking import Refused, check
from topheavy.structures import Structure

WIDTHS = (1e-8, 1e-7, 1e-6)  # of a boundary: the tables have nine digits


def proven(structure: Structure, motion: Pulse | Record) -> tuple[str, dict | None]:
    """Return an outcome that search and checker prove, or "undecided", and its certificate."""
    found, certificate = certified(structure, motion)
    return (found.outcome, certificate) if is_checked(certificate) else ("undecided", None)


def is_checked(certificate: dict | None) -> bool:
    """Return whether there is a certificate, and the checker proves the same."""
    try:
        return certificate is not None and check(certificate) == certificate["outcome"]
    except Refused:
        return False
