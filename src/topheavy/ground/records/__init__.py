"""Recorded ground motions, and the readers of PEER's AT2 layout and of columns of text.

`python -m topheavy.ground.records FILE …` prints how files are understood.
"""

from __future__ import annotations

from pathlib import Path

from topheavy.ground.records import at2, columns
from topheavy.ground.records.reading import Reading
from topheavy.ground.records.record import Record

__all__ = ["Reading", "Record", "read", "read_at2", "read_csv", "read_record"]


def read(path: str | Path, column: str = "") -> Reading:
    """Read a file, PEER AT2 or CSV as its name ends: the record and its stated unit.

    Raises
    ------
    ValueError
        For another ending, or a file that `read_at2` or `read_csv` refuses.
    """
    ending = Path(path).suffix.lower()
    if ending == ".at2" and not column:
        return at2.read(Path(path))
    if ending == ".csv":
        return columns.read(Path(path), column)
    wanted = ".csv, which alone has columns" if column else ".AT2 or .csv"
    raise ValueError(f"{path}: expected a file whose name ends in {wanted}")


def read_record(path: str | Path, column: str = "") -> Record:
    """Read a record in g from a file, PEER AT2 or CSV as its name ends.

    Raises
    ------
    ValueError
        For another ending, or a file that `read_at2` or `read_csv` refuses.

    Examples
    --------
    >>> th.read_record("data/records/el_centro_1940_NS.AT2").duration
    31.16
    """
    return read(path, column).record


def read_csv(path: str | Path, column: str = "") -> Record:
    """Read a record with the header `time (s),acceleration (g)` and a line for each sample.

    Semicolons or tabs may separate the columns; a comma is a decimal point then. Lines above the
    header that begin with # or % are comments. Of more columns, the first with a unit of time is
    read, and the one with a unit of acceleration, or that which `column` names. Other units are
    converted. The time step is the difference of the last and the first time over the number of
    steps. A warning says if the unit is g and an acceleration exceeds 2 g.

    Raises
    ------
    ValueError
        Naming the file and the line: another header, a unit that is not understood, a line that is
        not two numbers, fewer than two samples, times that do not go on in equal steps (a gap),
        steps below 1 µs, accelerations that are all zero or beyond 5 g. A file has at most 10⁸
        bytes and two million samples, a line of the header 1000 characters, an exponent four
        digits.

    Examples
    --------
    >>> columns, rows = "time (s),acceleration (g)", [[0.0, 0.1], [0.02, -0.2]]
    >>> np.savetxt("motion.csv", rows, delimiter=",", header=columns, comments="")
    >>> read_csv("motion.csv").peak_acceleration
    0.2
    """
    return columns.read(Path(path), column).record


def read_at2(path: str | Path) -> Record:
    """Read a record in the PEER AT2 layout: a header with its unit, NPTS and DT, then the samples.

    The header has at most four lines. It has to state the unit of acceleration, which is converted
    to g of 9.81 m/s², as the library computes. DT is in s unless its unit is stated.

    Raises
    ------
    ValueError
        Naming the file, and the line where there is one: no NPTS and DT, no unit of acceleration
        that is understood or two that contradict, a value that is not a number, more or fewer
        values than NPTS or fewer than two, a step below 1 µs, accelerations that are all zero or
        beyond 5 g. A file has at most 10⁸ bytes and two million samples, a line of the header 1000
        characters, an exponent four digits.

    Examples
    --------
    >>> read_at2("data/records/el_centro_1940_NS.AT2").time_step
    0.02
    """
    return at2.read(Path(path)).record
