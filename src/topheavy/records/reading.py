"""Common parts of both file formats: lines of text, numbers, and the record."""

import codecs
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from topheavy.records.record import Record
from topheavy.records.units import Statement

NUMBER = r"(?>[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?)"
"""A decimal number as C and Fortran print it, for a regular expression.

Not by `\\d`, which takes the digits of every script.
"""

_LONGEST_HEADER_LINE = 1000
"""Characters. A line of a header has eighty or so; a longer one is no header."""

_SHOWN = 80
"""Characters of a faulty text that a message repeats."""

_SHORTEST_STEP = 1e-6
"""s. No accelerogram has a million samples a second: a shorter step is in another unit."""

_LARGEST = 5.0
"""g. No ground acceleration above it has been recorded: what exceeds it is in another unit."""


@dataclass(frozen=True)
class Reading:
    """A record, the unit that its file states, and the line of the header with its step."""

    record: Record
    unit: Statement
    header: int


def text_lines(path: Path) -> list[str]:
    """Return the lines of a UTF-8 file, with or without a mark of byte order.

    Raises
    ------
    ValueError
        With the first line that is not UTF-8.
    """
    found = []
    raw = path.read_bytes().removeprefix(codecs.BOM_UTF8)
    for place, line in enumerate(raw.splitlines(), start=1):
        try:
            found.append(line.decode())
        except UnicodeDecodeError as error:
            raise ValueError(
                f"{path}: line {place} is not UTF-8 at byte {error.start + 1} "
                f"(0x{line[error.start]:02x}); expected a UTF-8 file: save it as such"
            ) from None
    return found


def check_header(path: Path, lines: Sequence[str]) -> None:
    """Refuse a file with a line of the header that is too long to be one.

    Raises
    ------
    ValueError
        With the file and the line.
    """
    for place, line in enumerate(lines, start=1):
        if len(line) > _LONGEST_HEADER_LINE:
            raise ValueError(
                f"{path}: line {place} has {len(line)} characters, {quoted(line)}; expected at "
                f"most {_LONGEST_HEADER_LINE} in a line of the header"
            )


def quoted(text: str) -> str:
    """Return a text for a message: in quotes, and only its beginning if it is long."""
    return repr(text) if len(text) <= _SHOWN else f"{text[:_SHOWN]!r}…"


def decimal(text: str) -> float:
    """Return a number, with the exponent of Fortran (1.0D-02) also.

    Raises
    ------
    ValueError
        For a text that is none; NaN and infinity are none.
    """
    if re.fullmatch(NUMBER, text.strip()):
        found = float(re.sub("[dD]", "e", text))
        if math.isfinite(found):
            return found
    raise ValueError(f"{quoted(text.strip())} is not a number")


def reading(
    path: Path,
    time_step: float,
    values: Sequence[float],
    places: Sequence[int],
    unit: Statement,
    header: int,
) -> Reading:
    """Return the record of a file; `places` are the lines of its samples.

    Raises
    ------
    ValueError
        With the file, for what cannot be a record: a time step below 1 µs, accelerations that are
        all zero, one beyond 5 g, with its line.
    """
    if 0.0 < time_step < _SHORTEST_STEP:
        raise ValueError(
            f"{path}: the time step is {time_step:.6g} s; expected at least {_SHORTEST_STEP:g} s: "
            "is its unit another?"
        )
    accelerations = np.array(values) * unit.in_g
    try:
        record = Record(time_step, accelerations, path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if record.peak_acceleration == 0.0:
        raise ValueError(
            f"{path}: all {record.acceleration.size} accelerations are zero; expected a ground "
            "motion: is it another file or column?"
        )
    if record.peak_acceleration > _LARGEST:
        k = int(np.abs(accelerations).argmax())
        raise ValueError(
            f"{path}: line {places[k]}: the largest acceleration is {values[k]:g} {unit.unit}, "
            f"{accelerations[k]:g} g; expected at most {_LARGEST:g} g, which no record exceeds: "
            f"line {unit.place} states the unit, {unit.line!r}; is it another?"
        )
    return Reading(record, unit, header)
