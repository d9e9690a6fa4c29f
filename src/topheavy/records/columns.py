"""Records in two columns of CSV, times and accelerations, with a line that names their units."""

import re
from decimal import Decimal
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from topheavy.records.reading import (
    Reading,
    check_count,
    check_header,
    decimal,
    in_c,
    quoted,
    reading,
    text_lines,
)
from topheavy.records.units import UNDERSTOOD, Statement, acceleration_in_g, time_in_seconds

_COLUMN = re.compile(r"[^()\[\]]*[(\[](?P<unit>[^()\[\]]*)[)\]]\s*")
_HEADER = "time (s),acceleration (g)"
_COMPUTED = 0.01
"""Of a step: additional tolerance for times that were computed in single precision."""


def read(path: Path) -> Reading:
    """Read a file of two columns; see `topheavy.read_csv`."""
    header, *lines = text_lines(path) or [""]
    check_header(path, [header])
    in_seconds, unit = _units(path, header)
    times: list[str] = []
    values: list[float] = []
    places: list[int] = []
    for place, line in enumerate(lines, start=2):
        if not line.strip():
            continue
        try:
            time, acceleration = line.split(",")
            decimal(time)
            values.append(decimal(acceleration))
        except ValueError:
            raise ValueError(
                f"{path}: line {place} is {quoted(line)}; expected a time and an acceleration, "
                "two numbers with a comma between them"
            ) from None
        times.append(time.strip())
        places.append(place)
        check_count(path, f"line {place} holds sample", len(values))
    if len(values) < 2:
        raise ValueError(f"{path}: holds {len(values)} samples; expected at least two")
    step = in_seconds * regular_step(path, times, places)
    return reading(path, step, values, places, unit, header=1)


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
    """Return one unit of the last digit of each time, zeros that are left out counted.

    Programs print either so many decimals or so many significant digits: the most that any of the
    times has.
    """
    numbers = [Decimal(in_c(text)) for text in printed]
    last = np.array([int(number.as_tuple().exponent) for number in numbers])
    first = np.array([number.adjusted() if number else last.min() for number in numbers])
    digits = (first - last).max()
    finest: NDArray[np.float64] = 10.0 ** np.maximum(last.min(), first - digits)
    return finest


def _units(path: Path, header: str) -> tuple[float, Statement]:
    """Return the units of the two columns: of time in s, and of acceleration."""
    columns = [_COLUMN.fullmatch(part) for part in header.split(",")]
    units = [match["unit"].strip() for match in columns if match]
    if len(units) != 2 or len(columns) != 2:
        raise ValueError(f"{path}: line 1 is {header!r}; expected, for example, {_HEADER!r}")
    in_seconds, in_g = time_in_seconds(units[0]), acceleration_in_g(units[1])
    if in_seconds is None or in_g is None:
        raise ValueError(
            f"{path}: line 1 is {header!r}, with the units {units[0]} and {units[1]}; expected "
            f"s or ms for the times, and {UNDERSTOOD} for the accelerations"
        )
    return in_seconds, Statement(units[1], in_g, 1, header)
