"""Files of ground motions: PEER's AT2, CSV with units in its header, plain columns of numbers."""

from __future__ import annotations

import codecs
import csv
import re
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.ground.records import MAX_RECORDED, UNITS, Record, acceleration_in_g

OTHER_READERS = """\
from gmprocess.io.read import read_data  # pip install gmprocess

trace = read_data("FILE")[0][0].detrend("demean")
unit, start = trace.stats.standard.units, trace.stats.starttime.timestamp
record = Record(trace.stats.delta, trace.data, trace.id, unit=unit, start=start)
import obspy  # or, of K-NET and KiK-net: pip install obspy

trace = obspy.read("FILE").merge()[0].detrend("demean")  # refuses a gap
samples, start = trace.data * trace.stats.calib, trace.stats.starttime.timestamp
record = Record(trace.stats.delta, samples, trace.id, unit="m/s2", start=start)
"""

NETWORKS = {
    "K-NET": r"Origin Time",
    "ESM": r"EVENT_NAME:",
    "AFAD": r"STRONG GROUND MOTION RECORDS OF TURK",
    "COSMOS": r".*\(Format v",
    "SMC": r"\d (UN)?CORRECTED ACCELEROGRAM",
    "GeoNet": r"(Un)?corrected accelerogram.*\nSite ",
    "CSMIP, RENADIC or USC": r"(Un)?corrected accelerogram",
}
"""How the first lines of their files begin; the first that fits counts."""

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
    tabs. `start` of the record is the first time.

    Parameters
    ----------
    column : str or int
        Of a CSV with several columns of acceleration, the name of the one to read, or its number in
        the file, counted from 1.
    time_step : float, optional
        s. In place of times that are not there, or have too few digits.
    unit : str, optional
        Of acceleration, for a file that `numpy.loadtxt` reads: a column of accelerations, or times
        (s) and accelerations.

    Raises
    ------
    ValueError
        With the file and the reason: another format, no unit or two, samples or times that miss,
        a step beyond 0.2 s, a response spectrum, accelerations that are all zero or beyond 5 g.

    Examples
    --------
    >>> th.read_record("data/records/el_centro_1940_NS.AT2").duration
    31.16
    >>> columns, rows = "time (s),acceleration (g)", [[0.0, 0.1], [0.02, -0.2], [0.04, 0.1]]
    >>> np.savetxt("motion.csv", rows, delimiter=",", header=columns, comments="")
    >>> th.read_record("motion.csv").peak_acceleration
    0.2
    """
    if not isinstance(path, str | PathLike):
        raise ValueError(f"path is {checks.short_repr(path)}; expected that of a file")
    if not isinstance(column, str):
        column = checks.whole("column", column, 1)
    raw, ending = (path := Path(path)).read_bytes(), path.suffix.lower()
    try:
        lines = raw.decode("utf-16" if raw[:2] in UTF_16 else "utf-8-sig").splitlines()
    except UnicodeDecodeError:
        lines = raw.decode("cp1252", errors="replace").splitlines()
    try:
        if unit is not None:
            return _plain(path, lines, time_step, unit)
        if ending == ".csv":
            return _csv(path, lines, column, time_step)
        if ending == ".at2" and not column and time_step is None:
            return _at2(path, lines)
        raise ValueError(
            "expected a name that ends in .AT2 (without column and time_step) or .csv, or "
            "read_record(path, time_step=…, unit=…) for plain columns of numbers"
        )
    except (ValueError, csv.Error) as error:
        message, head = f"{path}: {error}", "\n".join(lines[:3])
        networks = [name for name, begin in NETWORKS.items() if re.match(begin, head, re.I)]
        if networks or ending not in (".at2", ".csv"):
            networks.append("a national network")
            message += f".\nThese lines read a file of {networks[0]}:\n\n{OTHER_READERS}"
        raise ValueError(message) from None


_DT = r"(?P<step>[\d.]+(?:[ED][-+]?\d+)?)[ \t]*\(?(?P<unit>(?!NPTS|UNIT)[A-Z]*)"
_COUNT = re.compile(r"\bNPTS\s*[=:]\s*(?P<size>\d+)", re.IGNORECASE)
_STEP = re.compile(rf"\bDT\s*(?:\((?P<before>\w+)\)\s*)?[=:]\s*{_DT}", re.IGNORECASE)
_OLD = re.compile(rf"^\s*(?P<size>\d+)[ \t,]+{_DT}[ \t,)]*NPTS", re.IGNORECASE | re.MULTILINE)
_UNIT = re.compile(
    r"(\bunits?\s*(?:of\s+acc\w*\s*)?(?:\b(?:of|are|is|in)\b\s*[:=]?|[:=])\s*[(\[]?)?(?(1)|"
    r"(?:[(\[]|\bacc\w*\s*[:=]\s*|\bunits?\s+|\bin\s+(?!unit)))(%\s*g\b|[^\s,;()\[\]]+)(?!\s*=)",
    re.IGNORECASE,
)
_PEAK = re.compile(r"\b(peak|pga|a?max\w*)\b", re.IGNORECASE)


def _at2(path: Path, lines: list[str]) -> Record:
    head = "\n".join(lines[:10])
    count, step = _COUNT.search(head), _STEP.search(head)
    if not count or not step:
        count = step = _OLD.search(head)
    if not count or not step:
        raise ValueError("expected 'NPTS= n, DT= s SEC' in the first ten lines")
    number, word = step["step"], step["unit"] or step.groupdict().get("before")
    seconds, end = _in_seconds(word or "s"), head.count("\n", 0, max(count.end(), step.end())) + 1
    time_step = float(_in_c(number)) * (seconds or 1.0)
    if not seconds or (not word and time_step > checks.MAX_USUAL_STEP):
        raise ValueError(f"DT is {number} {word or ''}; expected SEC or MSEC behind it")
    size, values = int(count["size"]), _in_c(" ".join(lines[end:])).split()
    if len(values) < size or re.match(r"[-+.\d]", "".join(values[size : size + 1])):
        raise ValueError(f"NPTS is {size}, and {len(values)} values follow; expected as many")
    return _record(path, time_step, values[:size], _unit_of(lines[:end]))


def _unit_of(header: list[str]) -> str:
    """Return the one unit of acceleration that the lines of a header state."""
    units: dict[float | None, str] = {}
    for line in header:
        for match in _UNIT.finditer(line):
            unit = match[2].rstrip(".:")
            factor = acceleration_in_g(unit)
            if not _in_seconds(unit) if match[1] else factor and not _PEAK.search(line):
                units.setdefault(factor, unit)
    if len(units) != 1 or None in units:
        states = " and ".join(map(repr, units.values())) or "no unit"
        raise ValueError(f"the header states {states}; expected one of {', '.join(UNITS)}")
    return next(iter(units.values()))


_CELL = re.compile(r"^\s*(.*?)\s*(?:[(\[]([^()\[\]]*)[)\]]|\bin\s+(\S+(?:\s+g)?))?\s*$")


def _csv(path: Path, lines: list[str], column: str | int, time_step: float | None) -> Record:
    separator = re.match(r"sep=(.)", lines[0]) if lines else None
    for line in lines[:30]:
        mark = separator[1] if separator else next((m for m in ";\t" if m in line), ",")
        cells = next(csv.reader([line.lstrip("#% ")], delimiter=mark), [])
        names, brackets, behind = zip(
            *(_CELL.findall(cell)[0] for cell in cells or [""]), strict=True
        )
        units = [*map(str.__add__, brackets, behind)]  # one of both is empty
        times = [k for k, unit in enumerate(units) if _in_seconds(unit)]
        samples = [k for k, unit in enumerate(units) if acceleration_in_g(unit)]
        if times and samples:
            break
    else:
        raise ValueError("expected a header such as 'time (s),acceleration (g)', with units")
    listed = {k + 1: names[k] for k in samples}
    texts = names[times[0]], *listed.values()
    if re.search(r"period|freq|\bp?sa\b|spectr", " ".join(texts), re.I):
        raise ValueError(f"{line!r} is of a response spectrum; expected a ground motion")
    wanted = str(column).casefold()
    samples = [k for k in samples if wanted in ("", names[k].casefold(), str(k + 1))]
    if len(samples) != 1:
        numbered = ", ".join(f"{name!r} ({k})" for k, name in listed.items())
        raise ValueError(f"expected as `column` the name or number of one of {numbered}")
    table, both, above = [], (times[0], samples[0]), lines.index(line)
    for row in (rows := csv.reader(lines[above + 1 :], delimiter=mark)):
        try:
            if any(map(str.strip, row)):
                pair = [_in_c(row[k] if mark == "," else row[k].replace(",", ".")) for k in both]
                table.append([*map(float, pair)])
        except (ValueError, IndexError):
            place = above + 1 + rows.line_num
            raise ValueError(f"line {place} is {mark.join(row)!r}; expected numbers") from None
    seconds = _in_seconds(units[times[0]]) or 1.0
    return _record(path, time_step, np.array(table).reshape(-1, 2), units[samples[0]], seconds)


def _plain(path: Path, lines: list[str], time_step: float | None, unit: str) -> Record:
    table = np.loadtxt(lines, ndmin=2, delimiter="," if "," in "".join(lines[-1:]) else None)
    if (columns := table.shape[1]) > 2 or (columns == 1 and time_step is None):
        raise ValueError(
            f"{columns} columns; expected one and `time_step`, or times (s) and samples"
        )
    return _record(path, time_step, table if columns == 2 else table[:, 0], unit)


def _in_seconds(unit: str) -> float | None:
    """Return one unit of time in s, or None for a text that is no such unit."""
    match = re.fullmatch(r"\s*(m|milli)?s(ecs?|econds?)?\s*", unit, re.IGNORECASE)
    return (0.001 if match[1] else 1.0) if match else None


def _in_c(text: str) -> str:
    """Return numbers as C prints them: 1.0E-02, not 1.0D-02 as Fortran; 1_0 is none."""
    return re.sub(r"(?<=[\d.])D(?=[-+\d])", "E", text.replace("_", "__"), flags=re.IGNORECASE)


def _regular_step(times: NDArray[np.float64]) -> float:
    """Return the step of times that were printed, to their digits, from equal steps."""
    if times.size < 2:
        raise ValueError(f"{times.size} samples; expected at least two")
    digit = next((10.0**-n for n in range(15) if np.array_equal(times.round(n), times)), 0.0)
    steps, step = np.diff(times), float(times[-1] - times[0]) / (times.size - 1)
    off = np.abs(times - times[0] - step * np.arange(times.size))[1:] > digit + 0.01 * abs(step)
    uneven = ~(np.abs(steps - (usual := np.median(steps))) < 0.5 * usual)
    if (wrong := off | uneven).any():
        after, time = times[int(wrong.argmax()) :][:2]
        text = f"the time {time:.12g} follows {after:.12g}; expected steps of {step:.3g}: "
        if digit > 0.5 * step and uneven.mean() > 0.1:
            raise ValueError(f"{text}they are printed to {digit:g} only, so give `time_step` in s")
        raise ValueError(
            f"{text}is a sample missing? If the sampling is uneven, resample it (numpy.interp); if "
            "only the clock is, give `time_step` in s"
        )
    return step


def _record(
    path: Path, time_step: float | None, columns: ArrayLike, unit: str, seconds: float = 1.0
) -> Record:
    """Return the record of a file's samples, or of its times and samples."""
    table = np.array(columns, dtype=float)
    times, samples = table.T if table.ndim == 2 else (np.zeros(1), table)
    step = seconds * _regular_step(times) if time_step is None else time_step
    if step > checks.MAX_USUAL_STEP:
        raise ValueError(f"the time step is {step:.6g} s; expected at most 0.2 s: is it in ms?")
    factor, largest = acceleration_in_g(unit), float(np.abs(samples).max(initial=0.0))
    if factor and not 0.0 < factor * largest <= MAX_RECORDED:
        raise ValueError(
            f"the largest acceleration is {factor * largest:.6g} g; expected more than 0 and at "
            f"most {MAX_RECORDED:g} g: is the unit another than {unit!r}?"
        )
    stated, start = None if factor == 1.0 else unit, seconds * float(times[0])
    return Record(step, samples, path.stem, unit=stated, start=start)
