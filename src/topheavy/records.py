"""Recorded ground motions, and the reader of the PEER AT2 format."""

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
        For a step that is not positive, fewer than two samples, or a sample that is not finite.
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


def read_at2(path: str | Path) -> Record:
    """Read a record in the PEER AT2 layout: a header with NPTS and DT, then accelerations in g.

    Raises
    ------
    ValueError
        Naming the file, and the line where there is one: no NPTS and DT in the first four lines,
        a value that is not a number, or more or fewer values than NPTS.
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
    try:
        return Record(float(header["step"]), np.array(values), path.stem)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _line(start: float, value: float, slope: float, time: float) -> float:
    return value + slope * (time - start)
