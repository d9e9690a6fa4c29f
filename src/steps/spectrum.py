"""The lines of overturning spectra: at one frequency, all amplitudes that overturn, as table rows."""

import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import pandas as pd

from topheavy import Pulse, RockingBlock, overturning_intervals

MODES = ("without impact", "with impact")


class Line(NamedTuple):
    """A block under pulses of one frequency; `pulse` has the amplitude that a scale of 1 means."""

    labels: dict[str, Any]
    block: RockingBlock
    pulse: Pulse


def solve(lines: Sequence[Line], amplitudes: dict[str, float], threads: int) -> pd.DataFrame:
    """Return the overturning intervals of every line, over the scale of its pulse.

    A row has the middles of the brackets of both ends (no upper one where the range ends first),
    the width of the wider bracket, and whether the block overturned before any impact.
    """
    first, last = amplitudes["lowest"], amplitudes["highest"]

    def intervals(line: Line) -> list[dict[str, Any]]:
        found = overturning_intervals(
            line.block,
            line.pulse,
            (first, last),
            resolution=amplitudes["resolution"],
            most_impacts=len(MODES) - 1,
        )
        return [
            line.labels
            | {
                "lower": sum(interval.lower) / 2.0,
                "upper": sum(interval.upper) / 2.0 if interval.upper else None,
                "mode": MODES[interval.impacts],
                "bracket": max(
                    high - low for low, high in (interval.lower, interval.upper or (0.0, 0.0))
                ),
            }
            for interval in found
        ]

    with ThreadPoolExecutor(threads) as pool:
        rows = [
            row
            for rows in progress(pool.map(intervals, lines), len(lines), "lines")
            for row in rows
        ]
    columns = [*lines[0].labels, "lower", "upper", "mode", "bracket"]
    return pd.DataFrame(rows, columns=columns)


def progress(results: Iterable[Any], count: int, what: str) -> Iterable[Any]:
    """Pass results on, and tell the log of every tenth of them."""
    start = time.monotonic()
    for number, result in enumerate(results, start=1):
        yield result
        if number * 10 // count > (number - 1) * 10 // count:
            spent = time.monotonic() - start
            print(f"{number} of {count} {what}, {spent:.0f} s", flush=True)
