"""Common parts of both file formats: lines of text, numbers, and the record."""

import codecs
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from topheavy import checks
from topheavy.ground.records.record import Record
from topheavy.ground.records.units import Statement

NUMBER = r"(?>[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][-+]?[0-9]{1,4})?)"
"""A decimal number as C and Fortran print it, for a regular expression.

Not by `\\d`, which takes the digits of every script. No number has an exponent of five digits,
and `decimal.Decimal` refuses those of twenty.
"""

_DECIMAL = re.compile(NUMBER)

MOST_SAMPLES = 2_000_000
"""In a record: almost three hours at 200 Hz."""

LARGEST_FILE = 100_000_000
"""Bytes: fifty for each of so many samples."""

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
    """Return the lines of a UTF-8 file; a byte-order mark is allowed.

    Raises
    ------
    ValueError
        For a file beyond LARGEST_FILE; with the first line that is not UTF-8.
    """
    size = path.stat().st_size
    if size > LARGEST_FILE:
        raise ValueError(
            f"{path}: the file has {size} bytes; expected at most {LARGEST_FILE}, fifty for each "
            f"of {MOST_SAMPLES} samples: shorten the record"
        )
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
    """Raise ValueError if a line of the header is longer than any header's.

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


def check_count(path: Path, says: str, count: int) -> None:
    """Refuse a record of more than MOST_SAMPLES; `says` is what gives the count, with its line.

    Raises
    ------
    ValueError
        With the file and the line.
    """
    if count > MOST_SAMPLES:
        raise ValueError(
            f"{path}: {says} {count}; expected at most {MOST_SAMPLES} samples: shorten the record, "
            "or take fewer samples a second"
        )


def quoted(text: str) -> str:
    """Return a text for a message: in quotes, and only its beginning if it is long."""
    return repr(text) if len(text) <= _SHOWN else f"{text[:_SHOWN]!r}…"


def in_c(number: str) -> str:
    """Return a number as C prints it: with an e in place of the d of Fortran."""
    return number.replace("d", "e").replace("D", "e")


def decimal(text: str) -> float:
    """Return a number, with the exponent of Fortran (1.0D-02) also.

    Raises
    ------
    ValueError
        For a text that is none; NaN and infinity are none.
    """
    bare = text.strip()
    if _DECIMAL.fullmatch(bare):
        found = float(in_c(bare))
        if math.isfinite(found):
            return found
    raise ValueError(f"{quoted(bare)} is not a number")


def reading(
    path: Path,
    time_step: float,
    values: Sequence[float],
    places: Sequence[int],
    unit: Statement,
    header: int,
) -> Reading:
    """Return the record of a file; `places` are the lines of its samples, two or more.

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
    k = int(np.abs(accelerations).argmax())
    largest = accelerations[k]
    if largest == 0.0:
        raise ValueError(
            f"{path}: all {len(values)} accelerations are zero; expected a ground motion: is it "
            "another file or column?"
        )
    if abs(largest) > _LARGEST:
        raise ValueError(
            f"{path}: line {places[k]}: the largest acceleration is {values[k]:g} {unit.unit}, "
            f"{largest:g} g; expected at most {_LARGEST:g} g, which no record exceeds: line "
            f"{unit.place} states the unit, {unit.line!r}; is it another?"
        )
    if unit.in_g == 1.0 and abs(largest) > checks.LARGEST_RECORDED:
        checks.warn(
            f"{path}: line {places[k]}: the largest acceleration is {largest:.3g} g, and few "
            f"records exceed {checks.LARGEST_RECORDED:g} g: is the unit m/s²?"
        )
    try:
        record = Record(time_step, accelerations, path.stem, unit="g")
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if time_step > checks.LONGEST_STEP:
        checks.warn(f"{path}: the time step is {time_step:.6g} s, and few are longer: is it in ms?")
    return Reading(record, unit, header)
