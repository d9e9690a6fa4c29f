"""Lines of overturning spectra: all amplitudes at a frequency that overturn a block."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from steps.shared.cases import column_of, pulse_on
from topheavy import FactorInterval, Pulse, RockingBlock, RockingFrame
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


def line(
    change: str, gamma: float, slenderness: float, shape: str, ratio: float, cycles: int = 1
) -> Line:
    """Return the line of a frame, by the `KEYS`, and the number of cycles of its pulse.

    A slenderness is in degrees; a frequency is over p of the column.
    """
    column = column_of(slenderness)
    frame, alone = RockingFrame(column, gamma).block(), column.block()
    block = {
        FRAME: frame,
        SIZE: frame.with_restitution(alone.restitution),
        RESTITUTION: alone.with_restitution(frame.restitution),
    }[change]
    pulse = pulse_on(column, shape, ratio, cycles=cycles)
    labels = dict(zip(KEYS, (change, gamma, slenderness, shape, ratio), strict=True))
    return Line(labels, block, pulse)


def solve(lines: Sequence[Line], settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the intervals of amplitudes, over g tan α, that overturn the block of each line."""
    amplitudes = settings["amplitudes"]
    ends = (amplitudes["lowest"], amplitudes["highest"])
    finer = (settings["finer"]["below"], settings["finer"]["resolution"])
    rows: list[dict[str, Any]] = []
    for begin in range(0, len(lines), TOGETHER):
        some = lines[begin : begin + TOGETHER]
        intervals = search(some, ends, amplitudes["resolution"], finer)
        for one, of_line in zip(some, intervals, strict=True):
            rows += rows_of(one, of_line)
        print(f"{begin + len(some)} of {len(lines)} lines", flush=True)
    return pd.DataFrame(rows, columns=[*KEYS, "lower", "upper", "mode"])


def search(
    lines: Sequence[Line],
    ends: tuple[float, float],
    resolution: float,
    finer: tuple[float, float] | None = None,
) -> list[list[FactorInterval]]:
    """Return the intervals of each line in a range, none wider than the resolution missed."""
    blocks, pulses = [one.block for one in lines], [one.pulse for one in lines]
    return intervals_of_many(
        blocks, pulses, ends, resolution=resolution, most_impacts=1, finer=finer
    )


def rows_of(of: Line, intervals: Sequence[FactorInterval]) -> Iterator[dict[str, Any]]:
    """Yield a row for each interval; it has no upper end where the range ends first."""
    for one in intervals:
        upper = sum(one.upper) / 2.0 if one.upper else None
        yield of.labels | {
            "lower": sum(one.lower) / 2.0,
            "upper": upper,
            "mode": MODES[one.number_of_impacts],
        }
