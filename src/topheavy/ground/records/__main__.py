"""Print units, step, PGA and PGV of records: `python -m topheavy.ground.records FILE …`."""

import argparse
import io
import sys
from pathlib import Path

from topheavy.bodies.structures import STANDARD_GRAVITY
from topheavy.ground.records import Reading, read


def described(reading: Reading) -> str:
    """Return units, step, samples, duration, PGA and PGV of a record, a line each."""
    record, unit = reading.record, reading.unit
    to_g = "" if unit.in_g == 1.0 else f", times {unit.in_g:.6g} for g of {STANDARD_GRAVITY} m/s²"
    return "\n".join(
        [
            f"units     {unit.unit}{to_g} (line {unit.place}: {unit.line})",
            f"step      {record.time_step:.6g} s ({1.0 / record.time_step:.6g} Hz)",
            f"samples   {record.acceleration.size}",
            f"duration  {record.duration:.6g} s",
            f"PGA       {record.peak_acceleration:.4g} g",
            f"PGV       {record.peak_velocity:.4g} m/s (integrated from rest, not corrected)",
        ]
    )


def tabulated(readings: dict[Path, Reading]) -> str:
    """Return a line for each record, with a head."""
    rows: list[tuple[str, ...]] = [
        ("file", "unit", "step (s)", "samples", "duration (s)", "PGA (g)", "PGV (m/s)")
    ]
    for path, found in readings.items():
        record = found.record
        numbers = (record.time_step, record.acceleration.size, record.duration)
        peaks = (record.peak_acceleration, record.peak_velocity)
        cells = (*(f"{one:.6g}" for one in numbers), *(f"{one:.4g}" for one in peaks))
        rows.append((path.name, found.unit.unit, *cells))
    widths = [max(map(len, cells)) for cells in zip(*rows, strict=True)]
    lines = ("  ".join(map(str.ljust, row, widths)).rstrip() for row in rows)
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0, or 1 with a line on stderr for each file that is refused."""
    parser = argparse.ArgumentParser(prog="python -m topheavy.ground.records", description=__doc__)
    parser.add_argument("files", type=Path, nargs="+", metavar="FILE", help="AT2 or CSV")
    parser.add_argument("--column", default="", help="of the acceleration, in a CSV of several")
    asked, readings = parser.parse_args(arguments), {}
    for file in asked.files:
        try:
            readings[file] = read(file, asked.column)
        except (OSError, ValueError) as error:
            print(f"error: {error}", file=sys.stderr)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # of a terminal without ² or é
    if len(asked.files) > 1 and readings:
        print(tabulated(readings))
    elif readings:
        print(described(*readings.values()))
    return int(len(readings) < len(asked.files))


if __name__ == "__main__":
    sys.exit(main())
