"""Columns, cap beams, pulses and minima by numbers of the config, as several rules take them."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from replication.step import check
from topheavy import Cap, Column, LowestOverturning, Pulse, RockingBlock, lowest_overturning
from topheavy.bodies.structures import Structure

HIGHEST, FLOOR = 40.0, 1e-3
"""End of a search, and the widest interval that it may miss, times the uplift acceleration."""


def column_of(degrees: float, size: float = 1.0) -> Column:
    """Return the column of a slenderness (degrees) and a size R (m)."""
    slenderness = math.radians(degrees)
    return Column(size * math.sin(slenderness), size * math.cos(slenderness))


def lowered(block: RockingBlock, reduction: float) -> RockingBlock:
    """Return a block with √r lower by a relative reduction."""
    return block.with_restitution((1.0 - reduction) * block.restitution)


def cap_of(spec: dict[str, float]) -> Cap:
    """Return the cap beam of a config entry with span and depth (m)."""
    return Cap(spec["span"], spec["depth"] / 2.0)


def pulse_on(
    column: Column, shape: str, frequency_ratio: float, amplitude: float = 1.0, cycles: int = 1
) -> Pulse:
    """Return a pulse of a given ω/p and of an acceleration amplitude times g tan α of a column."""
    return Pulse(
        shape,
        amplitude * column.uplift_acceleration,
        angular_frequency=frequency_ratio * column.frequency_parameter,
        cycles=cycles,
    )


def lowest(
    structure: Structure, pulse: Pulse, highest: float | None = None, floor: float = FLOOR
) -> LowestOverturning | None:
    """Return the lowest interval of peak accelerations of a pulse that overturn a structure, g.

    The search begins at uplift and ends at `highest`, g; None if no acceleration up to it overturns
    the structure. The floor is normalised by the uplift acceleration.
    """
    level = structure.block().uplift_acceleration
    end = HIGHEST * level if highest is None else highest
    if level >= end:
        return None
    unit = replace(pulse, amplitude=1.0)
    interval = lowest_overturning(structure, unit, (level, end), floor=floor * level)
    return interval if interval.bracket else None


def bisected(
    survives: Callable[[float], bool], ends: Sequence[float], width: float, case: str
) -> float:
    """Return the number between two ends up to which a structure survives, to half a width."""
    low, high = ends
    outcomes = [survives(low), survives(high)]
    message = f"{case}: survival at {low:g} and {high:g} is {outcomes}; expected [True, False]"
    check(outcomes == [True, False], message)
    while high - low > width:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if survives(middle) else (low, middle)
    return 0.5 * (low + high)
