"""Files of ground motions: PEER's AT2, CSV with units in its header, plain columns of numbers."""

from __future__ import annotations

import codecs
import csv
import math
import re
from collections.abc import Sequence
from contextlib import suppress
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy import checks
from topheavy.ground.records import MAX_RECORDED, UNITS, Record, acceleration_in_g

_NAMED = """\
stats, name = trace.stats, f"{trace.stats.standard.source_file} {trace.stats.channel}"
unit, start = stats.standard.units, stats.starttime.timestamp
record = Record(stats.delta, trace.data, name, unit=unit, start=start)
"""
READERS = {
    "gmprocess": f"""\
from gmprocess.io.read import read_data  # pip install gmprocess, in an environment of its own

trace = read_data("FILE")[0][0].detrend("demean")
{_NAMED}""",
    "RENADIC": f"""\
from gmprocess.io.renadic.core import read_renadic  # pip install gmprocess, likewise

trace = read_renadic("FILE")[0][0].detrend("demean")
{_NAMED}""",
    "obspy": """\
import obspy  # pip install obspy

trace = obspy.read("FILE").merge()[0].detrend("demean")  # refuses a gap
samples, start = trace.data * trace.stats.calib, trace.stats.starttime.timestamp
record = Record(trace.stats.delta, samples, trace.id, unit="m/s2", start=start)
""",
}
"""Lines that read a format of a national network."""

NETWORKS = {
    "K-NET or KiK-net": (r"Origin Time", "obspy"),
    "ESM": (r"EVENT_NAME:", "gmprocess"),
    "AFAD": (r"STRONG GROUND MOTION RECORDS OF TURK", "gmprocess"),
    "COSMOS": (r".*\(Format v", "gmprocess"),
    "SMC (of a free field)": (r"\d (UN)?CORRECTED ACCELEROGRAM", "gmprocess"),
    "GeoNet": (r"(Un)?corrected accelerogram.*\nSite ", "gmprocess"),
    "RENADIC": (r"(?s)Uncorrected accelerogram.*RENADIC", "RENADIC"),
    "CSMIP (of a known azimuth) or USC": (r"(Un)?corrected accelerogram", "gmprocess"),
}
"""How the first lines of their files begin, the first that fits, and the lines that read them."""

UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
"""How such a file begins, for example "Unicode text" of Excel."""


def read_record(
    path: str | Path,
    column: str | int = "",
    *,
    time_step: float | None = None,
    unit: str | None = None,
) -> Record:
    """Read a record from a file: PEER AT2 or CSV as its name ends, or plain columns of numbers.

    AT2 has NPTS, DT (in s, or with MSEC) and the unit of acceleration in its first ten lines. CSV
    has a header with units, such as `time (s),acceleration (cm/s2)`, and commas, semicolons or
    tabs. Plain text, with `unit`, has a column of accelerations, or times (s) and accelerations,
    below any lines of words. `start` of the record is the first time.

    Parameters
    ----------
    column : str or int
        Of a CSV with several columns of acceleration, the name of the one to read, or its number in
        the file, counted from 1. The number also chooses among several columns of plain text.
    time_step : float, optional
        s. For a file without times, or whose times have too few digits. Times and a DT that have
        the digits to tell must agree with it.
    unit : str, optional
        Of acceleration, for a file that states none; one that is stated must agree with it.

    Raises
    ------
    ValueError
        With the file and the reason: another format, no unit or two, samples or times that miss,
        numbers whose meaning nobody states, a step beyond 0.2 s, a response spectrum,
        accelerations that are all zero or beyond 5 g.

    Warns
    -----
    UserWarning
        If the last line of a table is cut, or the samples are probably no ground motion.

    Examples
    --------
    >>> th.read_record("data/records/el_centro_1940_NS.AT2").duration
    31.16
    >>> columns, rows = "time (s),acceleration (g)", [[0.0, 0.0], [0.1, 0.2], [0.2, -0.2], [0.3, 0]]
    >>> np.savetxt("motion.csv", rows, delimiter=",", header=columns, comments="")
    >>> th.read_record("motion.csv").peak_acceleration
    0.2
    """
    if not isinstance(path, str | PathLike):
        raise ValueError(f"path is {checks.short_repr(path)}; expected that of a file")
    if not isinstance(column, str):
        column = checks.whole("column", column, 1)
    if unit is not None and acceleration_in_g(str(unit)) is None:
        raise ValueError(f"unit is {unit!r}; expected one of {', '.join(UNITS)}")
    if time_step is not None:
        time_step = checks.positive("time_step", time_step, "s")
    raw, ending = (path := Path(path)).read_bytes(), path.suffix.lower()
    try:
        text = raw.decode("utf-16" if raw[:2] in UTF_16 else "utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("cp1252", errors="replace")
    lines = re.sub("\r\n?", "\n", text).split("\n")
    head = "\n".join(lines[:10])
    network = next((name for name in NETWORKS if re.match(NETWORKS[name][0], head, re.I)), None)
    try:
        if ending == ".at2" and (unit is None or _COUNT.search(head) or _OLD.search(head)):
            if column:
                raise ValueError(f"column is {column!r}; expected none, as AT2 has one record")
            return _at2(path, lines, time_step, unit)
        if ending != ".csv" and unit is None:
            raise ValueError(
                "expected a name that ends in .AT2 or .csv, or `unit` (and `time_step`, unless the "
                "first column has times) for plain columns of numbers"
            )
        if (last := lines[-1]).strip() and len(last) < min(map(len, lines[-30:-1]), default=0):
            checks.warn(
                f"record {path.stem!r}: the last line, {last!r}, has no line end and is shorter "
                "than those before: was the file cut?"
            )
        if header := _header(lines, unit):
            return _csv(path, lines, header, column, time_step, unit)
        if unit is None:
            raise ValueError(
                "expected a header such as 'time (s),acceleration (g)', with units, or `unit` (and "
                "`column`) for a file that states none"
            )
        if network:
            raise ValueError(f"the first lines are those of {network}")
        return _plain(path, lines, column, time_step, unit)
    except (ValueError, csv.Error) as error:
        message = f"{path}: {error}"
        if network or (ending not in (".at2", ".csv") and unit is None):
            reader = READERS[NETWORKS[network][1] if network else "gmprocess"]
            message += (
                f".\nThese lines read a file of {network or 'most national networks'}; for any "
                f"other, use numpy.loadtxt, then Record(…, unit=…):\n\n{reader}"
            )
        raise ValueError(message) from None


_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([ED][-+]?\d+)?\s*", re.ASCII | re.IGNORECASE)
_DT = r"(?P<step>[^\sA-Z(;]+(?:[ED][-+]?\d+)?)[ \t]*\(?(?P<unit>(?!NPTS|UNIT)[A-Z]*)"
_COUNT = re.compile(r"\bNPTS\s*[=:]\s*(?P<size>\d+)", re.IGNORECASE)
_STEP = re.compile(rf"\bDT\s*(?:\((?P<before>\w+)\)\s*)?[=:]\s*{_DT}", re.IGNORECASE)
_OLD = re.compile(rf"^\s*(?P<size>\d+)[ \t,]+{_DT}[ \t,)]*NPTS", re.IGNORECASE | re.MULTILINE)
_UNIT = re.compile(
    r"(\bunits?\s*(?:of\s+acc\w*\s*)?(?:\b(?:of|are|is|in)\b\s*[:=]?|[:=])\s*[(\[]?)?(?(1)|"
    r"(?:[(\[]|\bacc\w*\s*[:=]\s*|\bunits?\s+|\bin\s+(?!unit)))(%\s*g\b|[^\s,;()\[\]]+)(?!\s*=)",
    re.IGNORECASE,
)
_PEAK = re.compile(r"\b(peak|pga|a?max\w*)\b", re.IGNORECASE)


def _at2(path: Path, lines: list[str], time_step: float | None, unit: str | None) -> Record:
    head = "\n".join(lines[:10])
    counts, steps = [*_COUNT.finditer(head)], [*_STEP.finditer(head)]
    if not counts or not steps:
        counts = steps = [*_OLD.finditer(head)]
    if not counts:
        raise ValueError("expected 'NPTS= n, DT= s SEC' in the first ten lines")
    end = head.count("\n", 0, max(match.end() for match in (*counts, *steps))) + 1
    sizes, stated = [int(count["size"]) for count in counts], [*map(_step_of, steps)]
    _check_equal("NPTS", sizes)
    _check_equal("DT", stated)
    _check_equal("DT and `time_step`", [stated[0], time_step])
    size, step = sizes[0], stated[0]
    values = " ".join(lines[end:]).split()
    for place in [k for k, line in enumerate(lines, 1) if k > end and _COUNT.search(line)]:
        raise ValueError(f"line {place} is a second header; expected one record")
    if len(values) < size or re.match(r"[-+.\d]", "".join(values[size : size + 1])):
        raise ValueError(f"NPTS is {size}, and {len(values)} values follow; expected as many")
    samples = _floats(values[:size], "value", 1, None, [0])[:, 0]
    return _record(path, samples, _unit_of(lines[:end], unit), step)


def _check_equal(name: str, values: Sequence[float | None]) -> None:
    """Raise ValueError if a file, or a file and an argument, state two values of one quantity."""
    stated = [value for value in values if value is not None]
    for value in stated[1:]:
        if not math.isclose(value, stated[0], rel_tol=1e-6):
            raise ValueError(f"{stated[0]:.9g} and {value:.9g} as {name}; expected one value")


def _step_of(match: re.Match[str]) -> float:
    """Return the time step that a header states, s."""
    number, word = match["step"].rstrip(","), match["unit"] or match.groupdict().get("before")
    if not _NUMBER.fullmatch(number):
        raise ValueError(f"DT is {number!r}; expected a number with a point, such as 0.01")
    seconds = _in_seconds(word or "s")
    step = float(_in_c(number)) * (seconds or 1.0)
    if not seconds or (not word and step > checks.MAX_USUAL_STEP):
        raise ValueError(f"DT is {number} {word or ''}; expected SEC or MSEC behind it")
    return step


def _unit_of(header: list[str], unit: str | None) -> str:
    """Return the one unit of acceleration that lines of a header state, or else the given one."""
    units: dict[float | None, str] = {}
    for line in header:
        for match in _UNIT.finditer(line):
            text = match[2].rstrip(".:")
            factor = acceleration_in_g(text)
            if not _in_seconds(text) if match[1] else factor and not _PEAK.search(line):
                units.setdefault(factor, text)
    return _agreed_unit(units, unit)


def _agreed_unit(units: dict[float | None, str], unit: str | None) -> str:
    """Return the one unit of those that a file states and the argument, by their size in g."""
    stated = "the header states"
    if unit is not None:
        units, stated = {acceleration_in_g(unit): unit} | units, "header and `unit` state"
    if len(units) != 1 or None in units:
        texts = " and ".join(map(repr, units.values())) or "no unit"
        behind = "" if units else ", there or as `unit`"
        raise ValueError(f"{stated} {texts}; expected one of {', '.join(UNITS)}{behind}")
    return next(iter(units.values()))


_CELL = re.compile(r"^\s*(.*?)\s*(?:[(\[]([^()\[\]]*)[)\]]|\bin\s+(\S+(?:\s+g)?))?\s*$")


def _header(lines: list[str], unit: str | None) -> tuple[int, str, list[str], list[str]] | None:
    """Return the number of a header with units, and its separator, names and units."""
    separator = re.match(r"sep=(.)", lines[0])
    for above, line in enumerate(lines[:30], 1):
        mark = separator[1] if separator else next((m for m in ";\t" if m in line), ",")
        cells = [_CELL.findall(cell)[0] for cell in _cells(line.lstrip("#% "), mark)]
        names, units = [cell[0] for cell in cells], [cell[1] + cell[2] for cell in cells]
        rest = [k for k, text in enumerate(units) if not _in_seconds(text)]
        stated = unit is not None and any(names[k] and not _NUMBER.match(names[k]) for k in rest)
        if len(rest) < len(units) and (stated or any(acceleration_in_g(units[k]) for k in rest)):
            return above, mark, names, units
    return None


def _csv(
    path: Path,
    lines: list[str],
    header: tuple[int, str, list[str], list[str]],
    column: str | int,
    time_step: float | None,
    unit: str | None,
) -> Record:
    above, mark, names, units = header
    time = next(k for k, text in enumerate(units) if _in_seconds(text))
    samples = [k for k, text in enumerate(units) if acceleration_in_g(text)] or [
        k for k, text in enumerate(units) if names[k] and not text
    ]
    listed, said = {k + 1: names[k] for k in samples}, f"line {above}, {lines[above - 1]!r},"
    if re.search(r"period|freq|\bp?sa\b|spectr", " ".join([names[time], *listed.values()]), re.I):
        raise ValueError(f"{said} is of a response spectrum; expected a ground motion")
    wanted = str(column).casefold()
    samples = [k for k in samples if wanted in ("", names[k].casefold(), str(k + 1))]
    if len(samples) != 1:
        numbered = ", ".join(f"{name!r} ({k})" for k, name in listed.items())
        raise ValueError(
            f"expected as `column` the name or number of one of {numbered}"
            if listed
            else f"{said} names no acceleration"
        )
    rows, both = lines[above:], [time, samples[0]]
    table = _table(rows, mark)
    if table is not None and max(both) < table.shape[1] <= len(names):
        table = table[:, both]
    else:
        for place, row in enumerate(rows, above + 1):
            if row.count(mark) >= len(names) and any(_cells(row, mark)[len(names) :]):
                raise ValueError(
                    f"line {place} is {row!r}, with more cells than line {above}: if its commas "
                    "are decimal, separate the columns by semicolons"
                )
        table = _floats(rows, "line", above + 1, mark, both)
    text, seconds = units[samples[0]], _in_seconds(units[time]) or 1.0
    unit = _agreed_unit({acceleration_in_g(text): text} if text else {}, unit)
    step = _regular_step(table[:, 0], None if time_step is None else time_step / seconds)
    return _record(path, table[:, 1], unit, seconds * step, seconds * table[0, 0])


def _plain(
    path: Path, lines: list[str], column: str | int, time_step: float | None, unit: str
) -> Record:
    """Return the record in columns of numbers, whose order or whose reader says what they mean."""
    above = next((k for k, line in enumerate(lines) if _has_numbers_only(line)), None)
    if above is None:
        raise ValueError("no line has numbers only")
    stated = [*map(_step_of, _STEP.finditer("\n".join(lines[:above]))), time_step]
    _check_equal("DT and `time_step`", stated)
    time_step, unit = stated[0], _unit_of(lines[:above], unit)
    begin, start, rows = lines[above], f"line {above + 1}", lines[above:]
    mark = ";" if ";" in begin else None if "," not in begin else "\t" if "\t" in begin else ","
    if (table := _table(rows, mark)) is not None:
        sizes: dict[int, int] = dict.fromkeys(range(len(table)), int(table.shape[1]))
    else:
        rows = ["" if row.lstrip().startswith("#") else row for row in rows]
        sizes = {k: len(row.split(mark)) for k, row in enumerate(rows) if row.strip()}
    size, *others = sizes.values()
    if mark == ",":
        text = "".join(rows)
        if {*others} - {size} or not ("." in text or re.search(r",(?!\d)", text)):
            raise ValueError(f"{start} is {begin!r}: are its commas decimal? Write points for them")
    first = float(_in_c(re.split(r"[\s,;]", begin.strip())[0]))
    if first in (sum(others), sum(others) - 1, len(others)) or (size == 1 and first == time_step):
        raise ValueError(
            f"{start} is {begin!r}, as if it were the number of values that follow, or the time "
            "step: remove it. If it is a sample, use numpy.loadtxt and Record"
        )
    across = (
        "; if the samples run across the lines, these read them:\n\nfrom pathlib import Path\n\n"
        f"words = Path({str(path)!r}).read_text().split('\\n', {above})[-1].split()\n"
        f"Record({time_step or 'TIME_STEP'}, np.array(words, float), unit={unit!r})"
    )
    for k, other in sizes.items():
        if other != size:
            raise ValueError(
                f"line {above + k + 1} has {other} numbers, {start} has {size}{across}"
            )
    table = _floats(rows, "line", above + 1, mark, range(size)) if table is None else table
    times = size > 1 and _are_times(table[:, 0])
    samples = [k for k in range(times, size) if str(column) in ("", str(k + 1))]
    if len(samples) != 1:
        raise ValueError(
            f"{size} columns, {'the first of times' if times else 'none of times'}; expected as "
            f"`column` the number of one with accelerations{'' if times else across}"
        )
    if times:
        time_step = _regular_step(table[:, 0], time_step)
    if time_step is None:
        raise ValueError("no column has times; expected `time_step`, in s")
    return _record(path, table[:, samples[0]], unit, time_step, table[0, 0] if times else 0.0)


def _cells(line: str, mark: str | None) -> list[str]:
    """Return the cells of a line, without quotes; None separates by blanks."""
    return line.split() if mark is None else next(csv.reader([line], delimiter=mark), [""])


def _has_numbers_only(line: str) -> bool:
    return all(map(_NUMBER.fullmatch, re.split(r"[\s,;]+", line.strip(" \t,;"))))


def _table(
    rows: list[str], mark: str | None, columns: Sequence[int] | None = None
) -> NDArray[np.float64] | None:
    """Return columns of the rows that are not empty, or None where a cell is no finite number."""
    if not any(map(str.strip, rows)):
        return np.empty((0, len(columns or [0])))
    with suppress(ValueError):
        options: Any = {"comments": None, "quotechar": '"', "ndmin": 2}
        table = np.loadtxt(rows, delimiter=mark, usecols=columns, **options)
        if np.isfinite(table).all():
            return table
    return None


def _floats(
    rows: list[str], label: str, first: int, mark: str | None, columns: Sequence[int]
) -> NDArray[np.float64]:
    """Return columns of the rows that are not empty, or raise ValueError with the first bad row.

    Rows are numbered from `first`. Commas are decimal where semicolons or tabs separate.
    """
    table, blank = _table(rows, mark, columns), f"{mark or ''} \t"
    if table is None:
        text = _in_c("\n".join(row for row in rows if row.strip(blank)))
        text = text.replace(",", ".") if mark in (";", "\t") else text
        table = _table(text.split("\n"), mark, columns)
    if table is not None:
        return table
    for place, row in enumerate(rows, first):
        cells = _cells(row, mark)
        if row.strip(blank) and not all(
            k < len(cells) and _is_number(cells[k], mark) for k in columns
        ):
            hint = ": is its comma decimal?" if "," in "".join(cells) else ""
            raise ValueError(f"{label} {place} is {row!r}; expected numbers{hint}")
    raise ValueError("expected rows of numbers")


def _is_number(text: str, mark: str | None) -> bool:
    """Return whether a cell is a finite number."""
    plain = text.replace(",", ".") if mark in (";", "\t") else text
    return bool(_NUMBER.fullmatch(plain)) and math.isfinite(float(_in_c(plain)))


def _in_seconds(unit: str) -> float | None:
    """Return one unit of time in s, or None for a text that is no such unit."""
    match = re.fullmatch(r"\s*(m|milli)?s(ecs?|econds?)?\s*", unit, re.IGNORECASE)
    return (0.001 if match[1] else 1.0) if match else None


def _in_c(text: str) -> str:
    """Return numbers as C prints them: 1.0E-02, not 1.0D-02 as Fortran."""
    return re.sub(r"[Dd](?<=[\d.].)(?=[-+\d])", "E", text)


def _are_times(values: NDArray[np.float64]) -> bool:
    """Return whether values rise or fall nearly always, or rise and are equal in coarse digits."""
    steps = np.diff(values)
    rising, falling = np.mean(steps > 0.0), np.mean(steps < 0.0)
    return bool(max(rising, falling) > 0.9 or (rising > 0.0) != (falling > 0.0))


def _regular_step(times: NDArray[np.float64], time_step: float | None) -> float:
    """Return the step of times that were printed, to their digits, from equal steps.

    A `time_step`, in the unit of the times, is the step if it agrees with all of them.
    """
    if times.size < 2:
        raise ValueError(f"{times.size} samples; expected at least two")
    digit = next((10.0**-n for n in range(15) if np.array_equal(times.round(n), times)), 0.0)
    steps, mean = np.diff(times), float(times[-1] - times[0]) / (times.size - 1)
    step, usual = mean if time_step is None else time_step, np.median(steps)
    # Multiples of a digit are printed exactly.
    is_exact = time_step is not None and digit and abs(step / digit - round(step / digit)) < 1e-6
    slack = 0.01 * abs(step) + (0.0 if is_exact else digit)
    off = np.abs(times - times[0] - step * np.arange(times.size))[1:] > slack
    uneven = ~(np.abs(steps - usual) < 0.5 * usual) & (time_step is None)
    if not (off | uneven).any():
        return step
    is_coarse = digit > 0.5 * mean > 0.0 and uneven.mean() > 0.1
    begun = float(np.median(steps[:9]))
    changed = np.abs(steps - begun) > slack
    k = int((changed if changed.any() and not is_coarse else off | uneven).argmax())
    text = f"row {k + 2}: the time {times[k + 1]:.12g} follows {times[k]:.12g}; expected "
    if mean <= 0.0:
        raise ValueError(f"{text}times that rise")
    if is_coarse:
        raise ValueError(f"{text}steps: they are printed to {digit:g} only, so give `time_step`")
    if time_step is not None and not changed.any():
        raise ValueError(f"{text}steps of {step:.6g}, which is `time_step`: leave it out")
    raise ValueError(
        f"{text}equal steps of {begun:.6g}: is a sample missing? If the sampling is uneven, "
        "resample it (numpy.interp)"
    )


def _record(
    path: Path, samples: NDArray[np.float64], unit: str, step: float, start: float = 0.0
) -> Record:
    if step > checks.MAX_USUAL_STEP:
        raise ValueError(f"the time step is {step:.6g} s; expected at most 0.2 s: is it in ms?")
    factor, largest = acceleration_in_g(unit), float(np.abs(samples).max(initial=0.0))
    if factor and not 0.0 < factor * largest <= MAX_RECORDED:
        raise ValueError(
            f"the largest acceleration is {factor * largest:.6g} g; expected more than 0 and at "
            f"most {MAX_RECORDED:g} g: is the unit another than {unit!r}?"
        )
    name = path.stem if acceleration_in_g(path.stem) is None else path.name  # not that of a unit
    return Record(step, samples, name, unit=None if factor == 1.0 else unit, start=start)
