"""Verify certificates with the standard library alone: python3 -I -S src/topheavy/proven/checking.

A line tells what each certificate of the files (JSON Lines, also compressed by gzip) proves. The
first that proves nothing ends it with status 1.
"""

import gzip
import json
import runpy
import sys
import zlib
from pathlib import Path
from typing import Any

if not __package__:  # run as a folder, which is a package of its own then; ends there
    folder = Path(sys.path[0]).resolve()
    sys.path[0] = str(folder.parent)
    runpy.run_module(folder.name, run_name="__main__")

from .checker import check
from .intervals import Refused

SAME = ("structure", "excitation", "linearised", "outcome")
USAGE = "usage: python3 -I -S src/topheavy/proven/checking FILE…"


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise Refused("a key stands twice")
    return found


def _no_number(text: str) -> Any:
    raise Refused(f"{text} is no JSON")


def parsed(line: str) -> Any:
    """Return a certificate from its JSON; one with a key twice, or with NaN, is refused."""
    try:
        return json.loads(line, object_pairs_hook=_once, parse_constant=_no_number)
    except (ValueError, RecursionError) as fault:
        raise Refused(f"no JSON: {fault}") from None


def described(certificate: dict[str, Any]) -> str:
    """Return what a certificate is about, and what it proves."""
    motion = certificate["excitation"]
    if "acceleration" in motion:
        motion = motion | {"acceleration": f"of {len(motion['acceleration'])} samples"}
    about = certificate["structure"] | motion | {"factor": " to ".join(certificate["factor"])}
    words = ", ".join(f"{key} {value}" for key, value in about.items())
    linearised = " (linearised)" if certificate["linearised"] else ""
    return f"{words}{linearised}: {certificate['outcome']}, impacts: {certificate['impacts']}"


def main(paths: list[str]) -> str | None:
    """Print a line for each certificate, also of those before that it continues."""
    if not paths:
        return USAGE
    for path in paths:
        opened, last, begin = gzip.open if path.endswith(".gz") else open, None, ""
        number = 0
        try:
            with opened(path, "rt", encoding="utf-8") as lines:
                for number, line in enumerate(lines, 1):
                    where = f"{path}, line {number}"
                    certificate = parsed(line)
                    check(certificate)
                    same, (low, high) = [certificate[key] for key in SAME], certificate["factor"]
                    begin = begin if last == (same, low) else low
                    whole = "" if begin == low else f"; so does each factor from {begin}"
                    print(f"{where}: proven: {described(certificate)}{whole}")
                    last = same, high
        except Refused as reason:
            return f"{where} is refused: {reason}"
        except (OSError, EOFError, UnicodeDecodeError, zlib.error) as fault:
            return f"{path} cannot be read: {fault}"
        if not number:
            return f"{path} holds no certificate"
    return None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
