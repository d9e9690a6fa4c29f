"""Whether a certificate is about the problem that was asked."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from .intervals import Refused
from .schema import validated


def concerns(
    certificate: dict[str, Any],
    structure: Any,
    excitation: Any,
    factor: float | tuple[float, float] = 1.0,
) -> None:
    """Raise `Refused` if a certificate is about another problem than this one.

    All dimensions are compared exactly, as the shortest decimals of the numbers that were given.

    Parameters
    ----------
    certificate : dict
        As `check` takes it.
    structure, excitation, factor
        As `topheavy.proven.search` takes them, but for a box of structures: a certificate is of
        one.
    """
    validated(certificate)
    if _numbers(certificate["structure"]) != _numbers(_dimensions(structure)):
        raise Refused("it is about another structure")
    if certificate["linearised"] != structure.block().linearised:
        raise Refused("it is about another equation")
    if not _moves(certificate["excitation"], excitation):
        raise Refused("it is about another ground motion")
    if not _equal(certificate["factor"], factor if isinstance(factor, tuple) else [factor] * 2):
        raise Refused("it is about another factor")


def _decimal(number: float) -> Fraction:
    return Fraction(repr(float(number)))


def _numbers(given: dict[str, Any]) -> dict[str, Any]:
    words = ("kind", "infinite")
    return {
        key: value if key in words or value in words else Fraction(value)
        for key, value in given.items()
    }


def _dimensions(structure: Any) -> dict[str, Any]:
    """Return what a certificate has to say of a structure, known by the names of its class."""
    kinds = {each.__name__ for each in type(structure).__mro__}
    if "BlockBox" in kinds:
        raise Refused("a box of structures has no certificate")
    if not kinds & {"Column", "RockingFrame", "FixedMassColumn", "MonolithicPortal"}:
        names = "slenderness", "frequency_parameter", "restitution"
        return {"kind": "block"} | _decimals(structure.block(), *names)
    ratio = getattr(structure, "mass_ratio", 0.0)
    found = _decimals(getattr(structure, "column", structure), "half_width", "half_height")
    found |= {"mass_ratio": "infinite" if ratio == float("inf") else _decimal(ratio)}
    found |= {"gravity": _decimal(9.81)}
    if kinds & {"Column", "RockingFrame"}:
        return found | {"kind": "frame"}
    cap = {"axis": Fraction(0)} | _decimals(structure, "cap_depth")
    if "MonolithicPortal" in kinds:
        cap["axis"] = _decimal(structure.span) / 2
        width = 2 * (cap["axis"] + found["half_width"] + _decimal(structure.overhang))
    else:
        width = _decimal(structure.cap_width)
    return found | cap | {"cap_width": width, "kind": "body"}


def _decimals(of: Any, *names: str) -> dict[str, Any]:
    return {name: _decimal(getattr(of, name)) for name in names}


def _equal(given: Sequence[str], asked: Sequence[float]) -> bool:
    return [Fraction(x) for x in given] == [_decimal(x) for x in asked]


def _moves(given: dict[str, Any], excitation: Any) -> bool:
    if given.get("shape") != getattr(excitation, "shape", None):
        return False
    if "shape" not in given:
        values = [excitation.time_step, *excitation.acceleration]
        return _equal([given["time_step"], *given["acceleration"]], values)
    names = "amplitude", "angular_frequency"
    return _equal([given[x] for x in names], [getattr(excitation, x) for x in names])
