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

NUMBER = r"(?>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?)"
"""A decimal number as C and Fortran print it, for a regular expression."""

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
    raise ValueError(f"{text.strip()!r} is not a number")


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
        With the file, for what cannot be a record, and the line of an acceleration beyond 5 g.
    """
    accelerations = np.array(values) * unit.in_g
    try:
        record = Record(time_step, accelerations, path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if record.peak_acceleration > _LARGEST:
        k = int(np.abs(accelerations).argmax())
        raise ValueError(
            f"{path}: line {places[k]}: the largest acceleration is {values[k]:g} {unit.unit}, "
            f"{accelerations[k]:g} g; expected at most {_LARGEST:g} g, which no record exceeds: "
            f"line {unit.place} states the unit, {unit.line!r}; is it another?"
        )
    return Reading(record, unit, header)
