"""Lines of overturning spectra: all overturning amplitudes at a frequency, as table rows."""

import math
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from topheavy import Column, Pulse, RockingBlock, RockingFrame, Search, intervals_together
from topheavy.outcomes.overturning import Interval

MODES = ("without impact", "with impact")


class Line(NamedTuple):
    """A block under pulses of one frequency; `pulse` has the amplitude that a scale of 1 means."""

    labels: dict[str, Any]
    block: RockingBlock
    pulse: Pulse


def column_of(slenderness: float) -> Column:
    """Return the column of R = 1 m with a slenderness in degrees, to the rounding of its sides."""
    alpha = math.radians(slenderness)
    return Column(math.sin(alpha), math.cos(alpha))


def line(slenderness: float, shape: str, gamma: float, linearised: bool, ratio: float) -> Line:
    """Return the line of a frame whose columns have a slenderness in degrees."""
    column = column_of(slenderness)
    block = RockingFrame(column, gamma).block()
    labels = {
        "slenderness_deg": slenderness,
        "shape": shape,
        "mass_ratio": gamma,
        "linearised": linearised,
        "frequency_ratio": ratio,
    }
    return Line(
        labels,
        block.linear() if linearised else block,
        Pulse(shape, column.uplift_acceleration, ratio * column.frequency_parameter),
    )


TOGETHER = 400
"""Lines that are searched together, so that blocks and frequencies share the kernel's calls."""


def intervals(lines: Sequence[Line], settings: Mapping[str, Any]) -> Iterator[list[Interval]]:
    """Yield the intervals of every line over the amplitudes of a config entry.

    Close to uplift, under long pulses, the lowest intervals are narrow. The search is therefore
    repeated at the finer resolution below the first interval.
    """
    amplitudes, finer = settings["amplitudes"], settings["finer"]
    first = amplitudes["lowest"]
    for begin in range(0, len(lines), TOGETHER):
        some = lines[begin : begin + TOGETHER]
        ranges = [(first, amplitudes["highest"])] * len(some)
        found = searched(some, ranges, amplitudes["resolution"])
        ends = {k: of[0].lower[0] for k, of in enumerate(found) if of}
        again = {k: (first, end) for k, end in ends.items() if first < end < finer["below"]}
        if again:
            below = searched([some[k] for k in again], [*again.values()], finer["resolution"])
            for k, lower in zip(again, below, strict=True):
                found[k] = lower + found[k]
        yield from found


def search(line: Line, scales: tuple[float, float], resolution: float) -> list[Interval]:
    """Return the intervals in a range, labelled only by whether an impact precedes overturning."""
    (found,) = searched([line], [scales], resolution)
    return found


def searched(
    lines: Sequence[Line], ranges: Sequence[tuple[float, float]], resolution: float
) -> list[list[Interval]]:
    """Return the intervals of every line in its range, labelled as by `search`."""
    searches = [
        Search(line.block, line.pulse, scales) for line, scales in zip(lines, ranges, strict=True)
    ]
    return intervals_together(searches, resolution=resolution, most_impacts=len(MODES) - 1)


def solve(lines: Sequence[Line], settings: Mapping[str, Any]) -> pd.DataFrame:
    """Return the overturning intervals of every line, over the scale of its pulse.

    A row has the middles of the brackets of both ends (no upper one where the range ends first),
    the width of the wider bracket, and whether the block overturns before any impact.
    """

    found = progress(intervals(lines, settings), len(lines), "lines")
    table = [
        line.labels | _row(interval)
        for line, several in zip(lines, found, strict=True)
        for interval in several
    ]
    return pd.DataFrame(table, columns=[*lines[0].labels, "lower", "upper", "mode", "bracket"])


def shard_of(lines: Sequence[Any], shard: str) -> Sequence[Any]:
    """Return every n-th line, as the name of a shard has it: "2-of-8"."""
    number, of = map(int, shard.split("-of-"))
    return lines[number - 1 :: of]


def progress(results: Iterable[Any], count: int, what: str) -> Iterator[Any]:
    """Yield the results, and write every tenth of them to the log."""
    start = time.monotonic()
    for number, result in enumerate(results, start=1):
        yield result
        if number * 10 // count > (number - 1) * 10 // count:
            print(f"{number} of {count} {what}, {time.monotonic() - start:.0f} s", flush=True)


def _row(interval: Interval) -> dict[str, Any]:
    ends = [interval.lower, *([interval.upper] if interval.upper else [])]
    return {
        "lower": sum(interval.lower) / 2.0,
        "upper": sum(interval.upper) / 2.0 if interval.upper else None,
        "mode": MODES[interval.impacts],
        "bracket": max(high - low for low, high in ends),
    }
