"""Recorded ground motions, and the readers of PEER's AT2 layout and of two-column CSV."""

import re
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy import checks
from topheavy.excitation import Segment

_HEADER_LINES = 4
_COUNT_AND_STEP = re.compile(
    r"NPTS\s*=\s*(?P<count>\d+)\s*,\s*DT\s*=\s*(?P<step>[-+.\deE]+)", re.IGNORECASE
)
_AT2_UNIT = re.compile(
    r"\bunits?\s+(?:of|are|is)\s*[:=]?\s*\(?\s*(?P<unit>[^\s(),;]+)", re.IGNORECASE
)
_CSV_COLUMN = re.compile(r"\s*(?P<name>[^()]*?)\s*\((?P<unit>[^()]*)\)\s*")
_CSV_HEADER = "time (s),acceleration (g)"
#: No ground acceleration above 5 g has been recorded: what exceeds it is in another unit.
_LARGEST = 5.0
#: Times may be rounded by so much of a step; a step that differs by more is a gap.
_ROUNDING = 0.1


@dataclass(frozen=True, eq=False)
class Record:
    """A recorded ground acceleration: sample k at k·time_step, linear between, zero outside.

    Parameters
    ----------
    time_step : float
        s.
    acceleration : array_like, shape (n,)
        In g, n ≥ 2.
    name : str
        What to call it in figures and messages.

    Raises
    ------
    ValueError
        For a step that is not positive, fewer than two samples, or a sample that is not finite or
        beyond `checks.LARGEST_ACCELERATION`.
    """

    time_step: float
    acceleration: NDArray[np.float64]
    name: str = ""

    def __post_init__(self) -> None:
        checks.positive("time_step", self.time_step, "s")
        samples = np.array(self.acceleration, dtype=float)
        called = f"record {self.name!r}" if self.name else "record"
        if samples.ndim != 1 or samples.size < 2:
            raise ValueError(
                f"{called}: acceleration has shape {samples.shape}; "
                "expected one axis of at least two samples"
            )
        bad = np.flatnonzero(~np.isfinite(samples))
        if bad.size:
            raise ValueError(
                f"{called}: sample {bad[0]} of {samples.size} is {samples[bad[0]]}; "
                "expected finite accelerations in g"
            )
        largest = np.abs(samples).argmax()
        checks.acceleration(f"{called}: sample {largest} of {samples.size}", samples[largest])
        samples.setflags(write=False)
        object.__setattr__(self, "acceleration", samples)

    @property
    def duration(self) -> float:
        """Time of the last sample, s."""
        return (self.acceleration.size - 1) * self.time_step

    def scaled(self, factor: float) -> "Record":
        """Return the same record with all accelerations multiplied by `factor`."""
        return Record(
            self.time_step, checks.finite("factor", factor) * self.acceleration, self.name
        )

    def excitation(self, t: ArrayLike) -> float | NDArray[np.float64]:
        """Return the ground acceleration in g at the time(s) t in s; zero outside the record."""
        value = np.interp(
            np.asarray(t, dtype=float) / self.time_step,
            np.arange(self.acceleration.size),
            self.acceleration,
            left=0.0,
            right=0.0,
        )
        return float(value) if np.ndim(value) == 0 else value

    def segments(self, until: float) -> list[Segment]:
        """Return the lines between samples, from 0 to the earlier of `until` and the end."""
        found = []
        samples = self.acceleration.tolist()
        for k, (first, second) in enumerate(pairwise(samples)):
            start, stop = k * self.time_step, (k + 1) * self.time_step
            if start >= until:
                break
            slope = (second - first) / self.time_step
            found.append(Segment(start, min(stop, until), partial(_line, start, first, slope)))
        return found


def read_record(path: str | Path) -> Record:
    """Read a record, PEER AT2 or two-column CSV as the name of the file ends.

    Raises
    ------
    ValueError
        For another ending, or what `read_at2` and `read_csv` refuse.
    """
    readers = {".at2": read_at2, ".csv": read_csv}
    reader = readers.get(Path(path).suffix.lower())
    if reader is None:
        raise ValueError(f"{path}: expected a file whose name ends in .AT2 or .csv")
    return reader(path)


def read_csv(path: str | Path) -> Record:
    """Read a record with the header `time (s),acceleration (g)` and a line for each sample.

    The time step is that of the first and the last time over their number of steps.

    Raises
    ------
    ValueError
        Naming the file, and the line where there is one: another header or unit, a line that is
        not two numbers, times that do not go on in equal steps (a gap), accelerations that
        cannot be in g.
    """
    path = Path(path)
    header, *lines = path.read_text(encoding="utf-8").splitlines() or [""]
    columns = [_CSV_COLUMN.fullmatch(part) for part in header.split(",")]
    units = [match["unit"].strip().lower() if match else None for match in columns]
    if len(units) != 2 or None in units:
        raise ValueError(f"{path}: line 1 is {header!r}; expected {_CSV_HEADER!r}")
    if units != ["s", "g"]:
        raise ValueError(
            f"{path}: line 1 has the units {', '.join(map(str, units))}; expected s and g, "
            f"{_CSV_HEADER!r}: convert the values"
        )
    rows: list[tuple[float, float]] = []
    for place, line in enumerate(lines, start=2):
        if not line.strip():
            continue
        try:
            time, acceleration = map(float, line.split(","))
        except ValueError:
            raise ValueError(
                f"{path}: line {place} is {line!r}; expected a time in s and an acceleration in g"
            ) from None
        rows.append((time, acceleration))
    if len(rows) < 2:
        raise ValueError(f"{path}: holds {len(rows)} samples; expected at least two")
    times = np.array(rows)[:, 0]
    step = float(times[-1] - times[0]) / (times.size - 1)
    usual = float(np.nanmedian(np.diff(times)))
    uneven = np.flatnonzero(~(np.abs(np.diff(times) - usual) <= _ROUNDING * abs(usual)))
    if uneven.size or not usual > 0.0:
        k = int(uneven[0]) if uneven.size else 0
        raise ValueError(
            f"{path}: sample {k + 2} of {times.size} is at {times[k + 1]:g} s, the one before at "
            f"{times[k]:g} s; expected times that grow in equal steps (usual here: {usual:g} s)"
        )
    return _checked(path, step, np.array(rows)[:, 1])


def read_at2(path: str | Path) -> Record:
    """Read a record in the PEER AT2 layout: a header with NPTS and DT, then accelerations in g.

    Raises
    ------
    ValueError
        Naming the file, and the line where there is one: no NPTS and DT in the first four lines,
        a unit other than g, a value that is not a number, more or fewer values than NPTS, or
        accelerations that cannot be in g.
    """
    path = Path(path)
    lines = path.read_text(encoding="utf-8").splitlines()
    headers = [_COUNT_AND_STEP.search(line) for line in lines[:_HEADER_LINES]]
    header = next(filter(None, headers), None)
    if header is None:
        raise ValueError(
            f"{path}: no 'NPTS= n, DT= s' in the first {_HEADER_LINES} lines; "
            "expected a PEER AT2 file"
        )
    values: list[float] = []
    first = headers.index(header) + 1
    for unit in filter(None, map(_AT2_UNIT.search, lines[:first])):
        if unit["unit"].lower() != "g":
            raise ValueError(f"{path}: its header gives {unit.group()!r}; expected units of g")
    for place, line in enumerate(lines[first:], start=first + 1):
        for token in line.split():
            try:
                values.append(float(token))
            except ValueError:
                raise ValueError(
                    f"{path}: line {place}: {token!r} is not a number; expected accelerations in g"
                ) from None
    count = int(header["count"])
    if len(values) != count:
        raise ValueError(
            f"{path}: holds {len(values)} accelerations; expected {count} by its NPTS "
            f"({'the file is cut short' if len(values) < count else 'there are too many'})"
        )
    return _checked(path, float(header["step"]), np.array(values))


def _checked(path: Path, time_step: float, acceleration: NDArray[np.float64]) -> Record:
    """Return the record of a file, if its numbers can be one."""
    try:
        record = Record(time_step, acceleration, path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    peak = float(np.abs(record.acceleration).max())
    if peak > _LARGEST:
        raise ValueError(
            f"{path}: its largest acceleration is {peak:g}; expected accelerations in g, which no "
            f"record has above {_LARGEST:g} (is it in m/s² or cm/s²?)"
        )
    return record


def _line(start: float, value: float, slope: float, time: float) -> float:
    return value + slope * (time - start)
