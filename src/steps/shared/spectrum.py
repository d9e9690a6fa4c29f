"""Lines of overturning spectra: all amplitudes at a frequency that overturn a block."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from topheavy import Column, Interval, Pulse, RockingBlock, RockingFrame
from topheavy.outcomes.search import intervals_of_many

FRAME, SIZE, RESTITUTION = CHANGES = "frame", "size", "restitution"
"""What a cap beam changes of the column: p and √r, p alone (the equivalent column), √r alone."""
MODES = "without impact", "with impact"
KEYS = ["change", "mass_ratio", "slenderness_deg", "shape", "frequency_ratio"]
TOGETHER = 400  # lines that are searched in the same calls of the kernel


class Line(NamedTuple):
    """A block under pulses of one frequency; `pulse` has the amplitude g tan α of the column."""

    labels: dict[str, Any]
    block: RockingBlock
    pulse: Pulse


def column_of(slenderness: float) -> Column:
    """Return the column of R = 1 m with a slenderness in degrees, to the rounding of its sides."""
    alpha = math.radians(slenderness)
    return Column(math.sin(alpha), math.cos(alpha))


def line(change: str, gamma: float, slenderness: float, shape: str, ratio: float) -> Line:
    """Return the line of a frame, by the `KEYS`.

    A slenderness is in degrees; a frequency is over p of the column.
    """
    column = column_of(slenderness)
    frame, alone = RockingFrame(column, gamma).block(), column.block()
    block = {
        FRAME: frame,
        SIZE: frame.with_restitution(alone.restitution),
        RESTITUTION: alone.with_restitution(frame.restitution),
    }[change]
    pulse = Pulse(shape, column.uplift_acceleration, ratio * column.frequency_parameter)
    labels = dict(zip(KEYS, (change, gamma, slenderness, shape, ratio), strict=True))
    return Line(labels, block, pulse)


def solve(lines: Sequence[Line], settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the intervals of amplitudes, over g tan α, that overturn the block of each line.

    Close to uplift, under long pulses, the lowest intervals are narrow. Below the first interval
    the search is therefore repeated at the finer resolution.
    """
    amplitudes, finer = settings["amplitudes"], settings["finer"]
    first, rows = amplitudes["lowest"], []
    for begin in range(0, len(lines), TOGETHER):
        some = lines[begin : begin + TOGETHER]
        whole = [(first, amplitudes["highest"])] * len(some)
        found = search(some, whole, amplitudes["resolution"])
        ends = {place: of[0].lower[0] for place, of in enumerate(found) if of}
        low = {place: (first, end) for place, end in ends.items() if first < end < finer["below"]}
        again = search([some[place] for place in low], [*low.values()], finer["resolution"])
        for place, lower in zip(low, again, strict=True):
            found[place] = lower + found[place]
        for each, intervals in zip(some, found, strict=True):
            rows += rows_of(each, intervals)
        print(f"{begin + len(some)} of {len(lines)} lines", flush=True)
    return pd.DataFrame(rows, columns=[*KEYS, "lower", "upper", "mode"])


def search(
    lines: Sequence[Line], ranges: Sequence[tuple[float, float]], resolution: float
) -> list[list[Interval]]:
    """Return the intervals of each line in its range, none wider than the resolution missed."""
    blocks, pulses = [each.block for each in lines], [each.pulse for each in lines]
    limits = {"resolution": resolution, "most_impacts": 1}
    return intervals_of_many(blocks, pulses, ranges, **limits) if lines else []


def rows_of(each: Line, intervals: Sequence[Interval]) -> Iterator[dict[str, Any]]:
    """Yield a row for each interval; it has no upper end where the range ends first."""
    for one in intervals:
        upper = sum(one.upper) / 2.0 if one.upper else None
        yield each.labels | {
            "lower": sum(one.lower) / 2.0,
            "upper": upper,
            "mode": MODES[one.impacts],
        }
