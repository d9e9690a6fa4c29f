"""Records in columns of text, times and accelerations, with a line that names their units."""

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from itertools import takewhile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from topheavy.ground.records.reading import (
    Reading,
    check_count,
    check_header,
    decimal,
    in_c,
    quoted,
    reading,
    text_lines,
)
from topheavy.ground.records.units import UNDERSTOOD, Statement, acceleration_in_g, time_in_seconds

_COLUMN = re.compile(r"[^()\[\]]*[(\[](?P<unit>[^()\[\]]*)[)\]]\s*")
_HEADER = "time (s),acceleration (g)"
_COMPUTED = 0.01
"""Of a step: additional tolerance for times that were computed in single precision."""


_COMMENT = ("#", "%")
_SEPARATORS = {";": "a semicolon", "\t": "a tab", ",": "a comma"}
"""Beside one that is no comma, a comma is a decimal point."""


@dataclass(frozen=True)
class _Layout:
    """The line of the header, what separates columns, which two are read, and their units."""

    place: int
    separator: str
    count: int
    columns: tuple[int, int]
    in_seconds: float
    unit: Statement

    def pair(self, line: str) -> tuple[str, float]:
        """Return the time as it is printed, and the acceleration; raise ValueError for neither."""
        parts = line.split(self.separator)
        if len(parts) != self.count:
            raise ValueError
        if self.separator != ",":
            parts = [part.replace(",", ".") for part in parts]
        time, acceleration = (parts[k] for k in self.columns)
        decimal(time)
        return time.strip(), decimal(acceleration)


def read(path: Path, column: str = "") -> Reading:
    """Read a file of columns; see `topheavy.ground.records.read_csv`."""
    lines = text_lines(path)
    above = sum(1 for _ in takewhile(lambda line: line.startswith(_COMMENT), lines))
    header, *rows = lines[above:] or [""]
    check_header(path, [*lines[:above], header])
    layout = _layout(path, header, above + 1, column)
    times: list[str] = []
    values: list[float] = []
    places: list[int] = []
    for place, line in enumerate(rows, start=above + 2):
        if not line.strip():
            continue
        try:
            time, acceleration = layout.pair(line)
        except ValueError:
            wanted = "two numbers" if layout.count == 2 else f"{layout.count} columns"
            raise ValueError(
                f"{path}: line {place} is {quoted(line)}; expected a time and an acceleration, "
                f"{wanted} with {_SEPARATORS[layout.separator]} between them"
            ) from None
        values.append(acceleration)
        times.append(time)
        places.append(place)
        check_count(path, f"line {place} holds sample", len(values))
    if len(values) < 2:
        raise ValueError(f"{path}: holds {len(values)} samples; expected at least two")
    step = layout.in_seconds * regular_step(path, times, places)
    return reading(path, step, values, places, layout.unit, header=layout.place)


@np.errstate(over="ignore", invalid="ignore")  # times beyond the largest float are not regular
def regular_step(path: Path, printed: list[str], places: list[int]) -> float:
    """Return the step of the times, as they are printed, from the first to the last.

    Times are regular if a series of equal steps gives them when it is rounded to their printed
    digits. First and last time may each be off by half a unit of the last digit, and so may every
    other: none is further than one unit from the straight line between these two. No step may
    differ by half of the usual one, so that rounding never hides a missing sample.

    Raises
    ------
    ValueError
        With the line of the first time for which this does not hold.
    """
    times = np.array([decimal(text) for text in printed])
    step = float(times[-1] - times[0]) / (times.size - 1)
    steps = np.diff(times)
    usual = float(np.median(steps))
    half = _last_digits(printed) / 2.0
    allowed = half + max(half[0], half[-1]) + _COMPUTED * abs(step)
    gaps = np.flatnonzero(~(np.abs(steps - usual) < usual / 2.0)) + 1
    off = np.flatnonzero(np.abs(times - times[0] - step * np.arange(times.size)) > allowed)
    if gaps.size or off.size:
        k = int(gaps[0] if gaps.size else off[0])
        raise ValueError(
            f"{path}: line {places[k]}: the time {printed[k]} follows {printed[k - 1]} of line "
            f"{places[k - 1]}; expected equal steps of {usual:g}, but for the rounding of the "
            "printed digits: is a sample missing, or the file not sampled evenly?"
        )
    return step


def _last_digits(printed: list[str]) -> NDArray[np.float64]:
    """Return the unit of the last printed digit of each time; trailing zeros count.

    Programs print either so many decimals or so many significant digits: the most that any of the
    times has.
    """
    numbers = [Decimal(in_c(text)) for text in printed]
    last = np.array([int(number.as_tuple().exponent) for number in numbers])
    first = np.array([number.adjusted() if number else last.min() for number in numbers])
    digits = (first - last).max()
    finest: NDArray[np.float64] = 10.0 ** np.maximum(last.min(), first - digits)
    return finest


def _layout(path: Path, header: str, place: int, column: str) -> _Layout:
    """Return how the columns lie; `column` names that of the acceleration, where there are several.

    Raises
    ------
    ValueError
        With the line: no two columns with units, units that are not understood, several
        accelerations of which none is named, a name that none has.
    """
    separator = next(mark for mark in _SEPARATORS if mark in header or mark == ",")
    parts = header.split(separator)
    matches = [_COLUMN.fullmatch(part) for part in parts]
    units = [match["unit"].strip() if match else "" for match in matches]
    said = f"{path}: line {place} is {header!r}"
    if len(parts) < 2 or (len(parts) == 2 and not all(units)):
        raise ValueError(f"{said}; expected, for example, {_HEADER!r}")
    seconds = [time_in_seconds(unit) for unit in units]
    in_g = [acceleration_in_g(unit) for unit in units]
    if len(parts) == 2:
        times, found = [0] if seconds[0] else [], [1] if in_g[1] else []
    else:
        times = [k for k, one in enumerate(seconds) if one]
        found = [k for k, one in enumerate(in_g) if one]
    if not times or not found:
        listed = ", ".join(filter(None, units)) if len(parts) > 2 else " and ".join(units)
        raise ValueError(
            f"{said}, with the units {listed}; expected "
            f"s or ms for the times, and {UNDERSTOOD} for the accelerations"
        )
    names = {k: re.split(r"[(\[]", parts[k])[0].strip() for k in found}
    if column:
        found = [k for k in found if names[k].casefold() == column.strip().casefold()]
    if len(found) != 1:
        raise ValueError(
            f"{said}; expected one column of acceleration"
            + (f" that is called {column!r}" if column else "")
            + f"; those are {', '.join(map(repr, names.values()))}: "
            "name one as `column`, or take the others out"
        )
    k = found[0]
    unit = Statement(units[k], in_g[k] or math.nan, place, header)
    return _Layout(place, separator, len(parts), (times[0], k), seconds[times[0]] or math.nan, unit)
