"""Print units, step, PGA and PGV of a record's file: `python -m topheavy.records FILE`."""

import argparse
import io
import sys
from pathlib import Path

from topheavy.records import Reading, read
from topheavy.structures import STANDARD_GRAVITY


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


def main(arguments: list[str] | None = None) -> int:
    """Run the command; return 0, or 1 with one line on stderr for a file that is refused."""
    parser = argparse.ArgumentParser(prog="python -m topheavy.records", description=__doc__)
    parser.add_argument("file", type=Path, metavar="FILE", help="AT2 or CSV")
    file = parser.parse_args(arguments).file
    try:
        text = described(read(file))
    except (OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # of a terminal without ² or é
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
