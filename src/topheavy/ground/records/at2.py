"""Records in the layout of PEER's AT2 files: a header with NPTS and DT, then the samples."""

import math
import re
from pathlib import Path

from topheavy.ground.records.reading import (
    NUMBER,
    Reading,
    check_count,
    check_header,
    decimal,
    reading,
    text_lines,
)
from topheavy.ground.records.units import stated_acceleration, time_in_seconds

_HEADER_LINES = 4
_LONGEST_STEP = 0.2
"""s. No accelerogram has fewer than five samples a second: a longer DT without unit is in ms."""

_NO_UNIT = r"(?!NPTS\b|UNITS?\b)"
# Either a whole unit with its bracket, or nothing that could be one. Possessive quantifiers would
# say it in fewer signs; Python 3.11 before 3.11.5 matches them wrongly.
_STEP = rf"""(?P<step>{NUMBER})(?![\d.])
    (?:\s*[(\[]?{_NO_UNIT}(?P<unit>[^\W\d_]+)(?![^\W\d_])(?:[)\]]|(?![)\]]))
      |(?!\s*[(\[]?{_NO_UNIT}[^\W\d_]))
    (?!\w|\s*[/*^]|-|[.,]\d)"""
_UNIT_BEFORE = r"(?:\s*[(\[]\s*(?P<before>[^\W\d_]+)\s*[)\]])?"
_TOKEN = re.compile(r"\S+")
_FLAGS = re.IGNORECASE | re.VERBOSE
_COUNT = re.compile(r"\bNPTS\s*[=:]\s*(?P<count>[0-9]+)(?![\d.]|,\d)", _FLAGS)
_NAMED_STEP = re.compile(rf"\bDT{_UNIT_BEFORE}\s*[=:]\s*{_STEP}", _FLAGS)
_OLD_HEADER = re.compile(
    rf"\s*(?P<count>[0-9]+)[\s,]+{_STEP}[\s,]*NPTS\s*(?:,\s*)?DT\b{_UNIT_BEFORE}", _FLAGS
)


def read(path: Path) -> Reading:
    """Read a file in the AT2 layout; see `topheavy.ground.records.read_at2`."""
    lines = text_lines(path)
    header = _header_line(path, lines)
    check_header(path, lines[:header])
    count, step = _count_and_step(path, header, lines[header - 1])
    try:
        unit = stated_acceleration(lines[:header])
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    check_count(path, f"line {header} gives NPTS as", count)
    values: list[float] = []
    places: list[int] = []
    for place, line in enumerate(lines[header:], start=header + 1):
        for token in _TOKEN.finditer(line):
            try:
                values.append(decimal(token[0]))
            except ValueError as error:
                raise ValueError(
                    f"{path}: line {place}: {error}; expected accelerations in {unit.unit}"
                ) from None
            places.append(place)
            check_count(path, f"line {place} holds sample", len(values))
    if len(values) != count:
        raise ValueError(
            f"{path}: line {header} says {count} samples, {lines[header - 1].strip()!r}, and the "
            f"lines after it hold {len(values)}; "
            f"{'the file is cut short' if len(values) < count else 'there are too many'}"
        )
    if count < 2:
        raise ValueError(f"{path}: line {header} says {count} samples; expected at least two")
    return reading(path, step, values, places, unit, header)


def _header_line(path: Path, lines: list[str]) -> int:
    """Return the number of the line that has NPTS."""
    for place, line in enumerate(lines[:_HEADER_LINES], start=1):
        if re.search(r"\bNPTS\b", line, re.IGNORECASE):
            return place
    raise ValueError(
        f"{path}: no NPTS in lines 1 to {_HEADER_LINES}; expected a PEER AT2 file, with a line "
        "'NPTS= n, DT= s SEC' after its title"
    )


def _count_and_step(path: Path, place: int, line: str) -> tuple[int, float]:
    """Return the number of samples and the time step, s, of the header's last line."""
    count, step = _COUNT.search(line), _NAMED_STEP.search(line)
    if count is None or step is None:
        count = step = _OLD_HEADER.match(line)
    if count is None or step is None:
        raise ValueError(
            f"{path}: line {place} is {line.strip()!r}; expected 'NPTS= n, DT= s SEC' "
            "or 'n s NPTS, DT', n a whole number and s a time step"
        )
    stated = [unit for unit in (step["before"], step["unit"]) if unit]
    factors = {time_in_seconds(unit) or math.nan for unit in stated} or {1.0}
    factor = factors.pop()
    if factors or math.isnan(factor):
        raise ValueError(
            f"{path}: line {place} gives DT the unit {' and '.join(map(repr, stated))}, "
            f"{line.strip()!r}; expected SEC, S, MSEC or MS"
        )
    number = decimal(step["step"])
    if not stated and number > _LONGEST_STEP:
        raise ValueError(
            f"{path}: line {place} gives a DT of {number:g} without a unit, {line.strip()!r}; "
            f"expected at most {_LONGEST_STEP:g} s: write SEC or MSEC after it"
        )
    return int(count["count"]), number * factor
