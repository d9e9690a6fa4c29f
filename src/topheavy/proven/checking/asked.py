"""Whether a certificate is about the problem that was asked."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from topheavy.proven.checking import intervals
from topheavy.proven.checking.intervals import Refused, of
from topheavy.proven.checking.model import Block

CLOSE = Fraction(1, 10**12)  # a certificate has the dimensions, a block floats computed from them


def concerns(
    certificate: dict[str, Any],
    structure: Any,
    excitation: Any,
    factor: float | tuple[float, float] = 1.0,
) -> None:
    """Raise `Refused` if a certificate is about another problem than this one.

    Parameters
    ----------
    certificate : dict
        As `check` takes it.
    structure, excitation, factor
        As `topheavy.proven.outcome` takes them. α, p² and √r are compared to twelve digits with
        those that the structure's own formulas give, all else exactly.
    """
    intervals.precision(100)
    block = structure.block()
    mine = Block(certificate["structure"], certificate["linearised"])
    square = Fraction(block.frequency_parameter) ** 2
    for found, asked in (
        (mine.alpha, block.slenderness),
        (mine.square, square),
        (mine.restitution, block.restitution),
    ):
        if not (found - of(Fraction(asked))).size() < of(CLOSE):
            raise Refused("it is about another structure")
    if certificate["linearised"] != block.linearised:
        raise Refused("it is about another equation")
    if not _moves(certificate["excitation"], excitation):
        raise Refused("it is about another ground motion")
    if not _equal(certificate["factor"], factor if isinstance(factor, tuple) else [factor] * 2):
        raise Refused("it is about another factor")


def _equal(given: Sequence[str], asked: Sequence[float]) -> bool:
    return [Fraction(x) for x in given] == [Fraction(repr(float(x))) for x in asked]


def _moves(given: dict[str, Any], excitation: Any) -> bool:
    if given.get("shape") != getattr(excitation, "shape", None):
        return False
    if "shape" not in given:
        values = [excitation.time_step, *excitation.acceleration]
        return _equal([given["time_step"], *given["acceleration"]], values)
    names = "amplitude", "angular_frequency"
    return _equal([given[x] for x in names], [getattr(excitation, x) for x in names])
