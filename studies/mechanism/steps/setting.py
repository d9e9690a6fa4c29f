"""Caps, pulses and columns from the config: what the steps of the study share."""

import math
from collections.abc import Mapping
from typing import Any

from topheavy import Cap, Column, Pulse


def cap_of(entry: Mapping[str, float]) -> Cap:
    """Return the cap of a config entry, which has its whole depth (m)."""
    return Cap(span=entry["span"], half_depth=entry["depth"] / 2.0)


def pulse_on(column: Column, entry: Mapping[str, Any], amplitude: float | None = None) -> Pulse:
    """Return a pulse from ω/p and its amplitude over g tan α, with p and α of a solitary column."""
    factor = entry["amplitude"] if amplitude is None else amplitude
    return Pulse(
        entry["shape"],
        factor * column.uplift_acceleration,
        entry["frequency_ratio"] * column.frequency_parameter,
    )


def slender(degrees: float, half_width: float) -> Column:
    """Return a column of this slenderness α."""
    return Column(half_width, half_width / math.tan(math.radians(degrees)))
