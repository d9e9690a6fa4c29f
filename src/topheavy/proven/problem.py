"""The problem of a certificate: structure, pulse and factors as decimals, without the proof."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from topheavy import checks
from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.structures import STANDARD_GRAVITY, Column, RockingFrame, Structure
from topheavy.ground.excitation import checked_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.shapes import SHAPES


def problem_of(
    structure: Structure, pulse: Pulse, factor: float | tuple[float, float]
) -> dict[str, Any]:
    """Return the entries of a certificate that say what it is about.

    Raises
    ------
    ValueError
        For a ground motion that is no pulse or does not end, a factor that is not finite or does
        not ascend, and a structure whose √r is negative.
    """
    if not isinstance(pulse, Pulse):
        raise ValueError(f"pulse is {checks.short_repr(pulse)}; expected a Pulse")
    checked_excitation(pulse, ends=True)
    ends = factor if isinstance(factor, tuple) else (factor, factor)
    low, high = (checks.finite("factor", end) for end in ends)
    if low > high:
        raise ValueError(f"factor is ({low:.6g}, {high:.6g}); expected the lower end first")
    return {
        "structure": _dimensions(structure),
        "linearised": structure.block().linearised,
        "pulse": {
            "wave": SHAPES[pulse.shape].wave,
            "half_periods": int(pulse.half_periods),
            **_decimals(pulse, "amplitude", "angular_frequency"),
        },
        "factor": [_decimal(low), _decimal(high)],
    }


def _dimensions(structure: Structure) -> dict[str, str]:
    match structure:
        case Column() | RockingFrame():
            column = structure if isinstance(structure, Column) else structure.column
            ratio = 0.0 if isinstance(structure, Column) else structure.mass_ratio
            return {"kind": "frame", **_sides(column, ratio)}
        case FixedMassColumn(column=column, mass_ratio=ratio):
            axis, width = Fraction(0), Fraction(_decimal(structure.cap_width))
        case MonolithicPortal(column=column, mass_ratio=ratio):
            axis = Fraction(_decimal(structure.span)) / 2
            overhang = Fraction(_decimal(structure.overhang))
            width = 2 * (axis + Fraction(_decimal(column.half_width)) + overhang)
        case _:
            names = "slenderness", "frequency_parameter", "restitution"
            return {"kind": "block", **_decimals(structure.block(), *names)}
    cap = {"axis": str(axis), "cap_width": str(width), **_decimals(structure, "cap_depth")}
    return {"kind": "body", **_sides(column, ratio), **cap}


def _sides(column: Column, ratio: float) -> dict[str, str]:
    return {
        **_decimals(column, "half_width", "half_height"),
        "mass_ratio": "infinite" if ratio == math.inf else _decimal(ratio),
        "gravity": _decimal(STANDARD_GRAVITY),
    }


def _decimals(thing: Any, *names: str) -> dict[str, str]:
    return {name: _decimal(getattr(thing, name)) for name in names}


def _decimal(number: float) -> str:
    """Return the shortest decimal of a float, which it stands for in a proof."""
    return repr(float(number))
