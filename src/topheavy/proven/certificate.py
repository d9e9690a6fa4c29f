"""Certificates: inputs as decimals, and the steps of the proof."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.structures import STANDARD_GRAVITY, Column, RockingFrame, Structure
from topheavy.checks import short
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.proven.balls import arb, decimal
from topheavy.proven.blocks import BlockBox, Range
from topheavy.proven.march import Outcome
from topheavy.proven.search import outcome

BITS = 136
"""The steps are short enough for them: the checker has some digits to lose."""


def certified(
    structure: Structure | BlockBox,
    excitation: Pulse | Record,
    *,
    factor: Range = 1.0,
    linearised: bool = False,
    bits: int = BITS,
    bounded: bool = False,
) -> tuple[Outcome, dict[str, Any] | None]:
    """Return the outcome of `topheavy.proven.search` and its certificate; None if undecided.

    `topheavy.proven.checking.check` verifies it, but for wide boxes of factors that it refuses;
    parameters and errors are those of `outcome`. A BlockBox is refused.
    """
    if isinstance(structure, BlockBox):
        raise ValueError(
            f"structure is {short(structure)}; expected one, as a box has no certificate"
        )
    steps: list[dict[str, Any]] = []
    found = outcome(
        structure,
        excitation,
        factor=factor,
        linearised=linearised,
        bits=bits,
        bounded=bounded,
        trace=steps,
    )
    if found.outcome == "undecided":
        return found, None
    low, high = factor if isinstance(factor, tuple) else (factor, factor)
    return found, {
        "structure": _structure(structure),
        "linearised": linearised or structure.block().linearised,
        "excitation": _excitation(excitation),
        "factor": [str(decimal(low)), str(decimal(high))],
        "outcome": found.outcome,
        "impacts": found.impacts,
        "bits": max([bits, *(step.pop("bits") for step in steps)]),
        "order": max([2, *(step.pop("order") for step in steps)]),
        "events": [{key: _plain(value) for key, value in step.items()} for step in steps],
    }


def _decimal(number: float) -> str:
    return repr(float(number))


def _structure(structure: Structure) -> dict[str, str]:
    match structure:
        case Column() | RockingFrame():
            column = structure if isinstance(structure, Column) else structure.column
            ratio = 0.0 if isinstance(structure, Column) else structure.mass_ratio
            return {"kind": "frame", **_sides(column, ratio)}
        case FixedMassColumn(column=column, mass_ratio=ratio):
            axis, width = Fraction(0), decimal(structure.cap_width)
            depth = decimal(structure.cap_depth)
        case MonolithicPortal(column=column, mass_ratio=ratio):
            axis = decimal(structure.span) / 2
            width = 2 * (axis + decimal(column.half_width) + decimal(structure.overhang))
            depth = decimal(structure.cap_depth)
        case _:
            block = structure.block()
            names = ("slenderness", "frequency_parameter", "restitution")
            return {"kind": "block", **{name: _decimal(getattr(block, name)) for name in names}}
    cap = {"axis": str(axis), "cap_width": str(width), "cap_depth": str(depth)}
    return {"kind": "body", **_sides(column, ratio), **cap}


def _sides(column: Column, ratio: float) -> dict[str, str]:
    return {
        "half_width": _decimal(column.half_width),
        "half_height": _decimal(column.half_height),
        "mass_ratio": "infinite" if ratio == math.inf else _decimal(ratio),
        "gravity": _decimal(STANDARD_GRAVITY),
    }


def _excitation(excitation: Pulse | Record) -> dict[str, Any]:
    if isinstance(excitation, Record):
        samples = [_decimal(x) for x in excitation.acceleration.tolist()]
        return {"time_step": _decimal(excitation.time_step), "acceleration": samples}
    return {
        "shape": excitation.shape,
        "amplitude": _decimal(excitation.amplitude),
        "angular_frequency": _decimal(excitation.angular_frequency),
    }


def _plain(value: object) -> object:
    """Return a ball as the two dyadic numbers that enclose it, and a float exactly."""
    if isinstance(value, arb):
        return [_dyadic(value.lower()), _dyadic(value.upper())]
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    return _ratio(*value.as_integer_ratio()) if isinstance(value, float) else value


def _dyadic(number: arb) -> str:
    """Return a fraction next to the number, wide enough for a hint."""
    mantissa, exponent = map(int, number.mid().man_exp())  # which is odd, or 0
    return _ratio(mantissa << max(exponent, 0), 1 << max(-exponent, 0))


def _ratio(top: int, below: int) -> str:
    return f"{top}/{below}" if below > 1 else str(top)
