"""Verify certificates with the standard library alone: python3 -I -S src/topheavy/proven/checking.

It reads files of certificates (JSON Lines, also compressed by gzip) and prints for each structure
and pulse the amplitudes that they prove to survive or to overturn. A refused certificate ends it
with status 1.
"""

import gzip
import json
import runpy
import sys
import zlib
from collections.abc import Iterator
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path
from typing import Any

if not __package__:  # run as a folder, which is a package of its own then; ends there
    folder = Path(sys.path[0]).resolve()
    sys.path[0] = str(folder.parent)
    runpy.run_module(folder.name, run_name="__main__")

from .checker import check
from .intervals import NotProven

MAX_LINE = 100_000  # characters
USAGE = "usage: python3 -I -S src/topheavy/proven/checking FILE…"

Range = tuple[Fraction, Fraction, str]
"""From and to which amplitude, g, and the outcome."""


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    entries = dict(pairs)
    if len(entries) < len(pairs):
        raise NotProven("a key occurs twice")
    return entries


def _no_number(text: str) -> Any:
    raise NotProven(f"{text} is no JSON")


def parsed(line: str) -> Any:
    """Return a certificate from its JSON; one with a key twice, or with NaN, is refused."""
    if len(line) > MAX_LINE:
        raise NotProven(f"it is longer than {MAX_LINE} characters")
    try:
        return json.loads(line, object_pairs_hook=_once, parse_constant=_no_number)
    except (ValueError, RecursionError) as fault:
        raise NotProven(f"no JSON: {fault}") from None


def problem(certificate: dict[str, Any]) -> str:
    """Return the structure and the pulse of a certificate in words, without its amplitude."""
    structure, pulse = dict(certificate["structure"]), dict(certificate["pulse"])
    kind, _ = structure.pop("kind"), pulse.pop("amplitude")
    parts = (", ".join(f"{key} {x}" for key, x in part.items()) for part in (structure, pulse))
    words = " (linearised)" if certificate["linearised"] else ""
    return f"{kind}{words}: {'; '.join(parts)}"


def joined(ranges: list[Range]) -> list[Range]:
    """Return ranges of amplitudes in ascending order, without the ends at which two meet."""
    result: list[Range] = []
    for low, high, outcome in sorted(ranges):
        if result and result[-1][2] == outcome and low <= result[-1][1]:
            low, before, _ = result.pop()
            high = max(high, before)
        result.append((low, high, outcome))
    return result


def decimal(number: Fraction) -> str:
    """Return a product of decimals as a decimal with all its digits."""
    with localcontext(prec=5000):
        return format(Decimal(number.numerator) / Decimal(number.denominator), "f")


def lines_of(path: str) -> Iterator[str]:
    with (gzip.open if path.endswith(".gz") else open)(path, "rt", encoding="utf-8") as file:
        while line := file.readline(MAX_LINE + 1):
            yield line


def main(paths: list[str]) -> str | None:
    """Check all files, then print a line for each range of amplitudes with one outcome."""
    if not paths:
        return USAGE
    proven: dict[str, list[Range]] = {}
    count = 0
    for path in paths:
        number = 0
        try:
            for line in lines_of(path):
                number += 1
                certificate = parsed(line)
                outcome = check(certificate)
                ends = [Fraction(x) for x in certificate["factor"]]
                peak = Fraction(certificate["pulse"]["amplitude"])
                low, high = sorted(peak * end for end in ends)
                proven.setdefault(problem(certificate), []).append((low, high, outcome))
        except NotProven as reason:
            return f"{path}, line {number} is refused: {reason}"
        except (OSError, EOFError, UnicodeDecodeError, zlib.error) as fault:
            return f"{path} cannot be read: {fault}"
        if not number:
            return f"{path} holds no certificate"
        count += number
    for about, ranges in proven.items():
        print(about)
        for low, high, outcome in joined(ranges):
            span = f"at {decimal(low)} g"
            if low < high:
                span = f"at each amplitude from {decimal(low)} to {decimal(high)} g"
            print(f"    {outcome} {span}")
    print(f"{count} certificates are proven")
    return None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
