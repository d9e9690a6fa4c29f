"""Recorded ground motions, and the readers of PEER's AT2 layout and of two-column CSV.

`python -m topheavy.records FILE` prints how a file is understood.
"""

from pathlib import Path

from topheavy.records import at2, columns
from topheavy.records.reading import Reading
from topheavy.records.record import Record

__all__ = ["Reading", "Record", "read", "read_at2", "read_csv", "read_record"]


def read(path: str | Path) -> Reading:
    """Read a file, PEER AT2 or two-column CSV as its name ends: the record and its stated unit.

    Raises
    ------
    ValueError
        For another ending, or a file that `read_at2` or `read_csv` refuses.
    """
    readers = {".at2": at2.read, ".csv": columns.read}
    reader = readers.get(Path(path).suffix.lower())
    if reader is None:
        raise ValueError(f"{path}: expected a file whose name ends in .AT2 or .csv")
    return reader(Path(path))


def read_record(path: str | Path) -> Record:
    """Read a record in g from a file, PEER AT2 or two-column CSV as its name ends.

    Raises
    ------
    ValueError
        For another ending, or a file that `read_at2` or `read_csv` refuses.
    """
    return read(path).record


def read_csv(path: str | Path) -> Record:
    """Read a record with the header `time (s),acceleration (g)` and a line for each sample.

    Other units in the header are converted. The time step is the difference of the last and the
    first time over the number of steps.

    Raises
    ------
    ValueError
        Naming the file and the line: another header, a unit that is not understood, a line that is
        not two numbers, fewer than two samples, times that do not go on in equal steps (a gap),
        steps below 1 µs, accelerations that are all zero or beyond 5 g. A file has at most 10⁸
        bytes and two million samples, a line of the header 1000 characters, an exponent four
        digits.
    """
    return columns.read(Path(path)).record


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
    """
    return at2.read(Path(path)).record
