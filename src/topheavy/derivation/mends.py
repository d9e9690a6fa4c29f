"""What kind of fault a printed form has: the smallest mend under which it holds names the kind.

No kind is written down. A form that does not hold is mended in every way known here, one mend at
a time and the smallest first, until it holds; a form that no single mend saves has no kind.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal, get_args

import sympy as sp

from topheavy.derivation.notation import F_x1, F_x2, F_z1, F_z2

Kind = Literal["convention", "bracket", "radical", "sign", "number"]
KINDS: tuple[Kind, ...] = get_args(Kind)
"""From the smallest mend to the largest. A convention changes nothing in the printed form."""

CONVENTIONS: dict[str, dict[sp.Symbol, sp.Expr]] = {
    "the columns' shears positive to the left": {F: -F for F in (F_x1, F_x2)},
    "the columns' thrusts positive downward": {F: -F for F in (F_z1, F_z2)},
}
"""Which forces may be counted in the other direction. The paper says in words (p. 3) that the
ground is positive to the right and a rotation to the left negative, so these stay."""

_BEGIN = re.compile(r"(?<![^ (])(?=[^ )])")
_END = re.compile(r"(?<=[^ (])(?![^ )])")


@dataclass(frozen=True)
class Mend:
    """One change of a printed form.

    Parameters
    ----------
    kind
        One of `KINDS`.
    text
        The form as changed.
    convention
        The key in `CONVENTIONS` of the forces that are counted the other way, or "".
    """

    kind: Kind
    text: str
    convention: str = ""


def smallest_mend(printed: str, holds: Callable[[Mend], bool]) -> Mend | None:
    """Return the smallest mend of a printed form under which it holds, None if there is none.

    Parameters
    ----------
    printed
        As `topheavy.derivation.notation.read` takes it, or arithmetic.
    holds
        Whether the form holds with a mend made.
    """
    return next(filter(holds, mends(printed)), None)


def mended_quotient(over: float, under: float, printed: str) -> tuple[Mend, float] | None:
    """Return the smallest mend under which a quotient rounds to the printed number, and its value.

    None if no single mend does.

    Parameters
    ----------
    over, under
        Whole numbers, as they are printed: 265 and 265.
    printed
        The quotient with the digits that are printed, "0.434".
    """
    decimals = len(printed.partition(".")[2])

    def value(mend: Mend) -> float:
        found = re.fullmatch(r"([0-9]+)/([0-9]+)", mend.text)
        return int(found[1]) / int(found[2]) if found and int(found[2]) else math.nan

    mend = smallest_mend(f"{over:.0f}/{under:.0f}", lambda m: f"{value(m):.{decimals}f}" == printed)
    return (mend, value(mend)) if mend else None


def mends(printed: str) -> Iterator[Mend]:
    """Yield the mends of a form, the smallest first."""
    yield from (Mend("convention", printed, name) for name in CONVENTIONS)
    yield from (Mend("bracket", other) for other in _brackets(printed))
    yield from (Mend("radical", other) for other in _radicals(printed))
    yield from (Mend("sign", other) for other in _signs(printed))
    yield from (Mend("number", other) for other in _numbers(printed))


def _brackets(text: str) -> Iterator[str]:
    """Yield the form with one bracket moved, or with brackets around the terms of one fraction."""
    for place in re.finditer(r"[()]", text):
        without = text[: place.start()] + text[place.end() :]
        for gap in _places(_BEGIN if place.group() == "(" else _END, without):
            yield from _balanced(without[:gap] + place.group() + without[gap:], text)
    for bar in re.finditer("/", text):
        before, after = text[: bar.start()], text[bar.end() :]
        for start in _places(_BEGIN, before):
            for end in _places(_END, after):
                mended = f"{before[:start]}({before[start:]})/({after[:end]}){after[end:]}"
                yield from _balanced(mended, text)


def _radicals(text: str) -> Iterator[str]:
    """Yield the form with one radical drawn out over what follows its brackets."""
    for place in re.finditer(r"√(?=\()", text):
        start = place.end()
        for gap in _places(_END, text[start:]):
            covered, rest = text[start : start + gap], text[start + gap :]
            yield from _balanced(f"{text[:start]}({covered}){rest}", text)


def _signs(text: str) -> Iterator[str]:
    """Yield the form with one sign turned round, or one put before a member that has none."""
    for place in re.finditer(r"[+−]", text):
        other = "−" if place.group() == "+" else "+"
        yield text[: place.start()] + other + text[place.end() :]
    for place in re.finditer(r"= (?![+−])", text):
        yield text[: place.end()] + "−" + text[place.end() :]


def _numbers(text: str) -> Iterator[str]:
    """Yield the form with one whole number replaced by any other of as many digits."""
    for place in re.finditer(r"(?<![\w.])[0-9]+", text):
        digits = len(place.group())
        for number in range(10 ** (digits - 1), 10**digits):
            if str(number) != place.group():
                yield text[: place.start()] + str(number) + text[place.end() :]


def _places(where: re.Pattern[str], text: str) -> list[int]:
    """Return the places where a term begins, or ends."""
    return [match.start() for match in where.finditer(text)]


def _balanced(text: str, printed: str) -> Iterator[str]:
    """Yield a form if its brackets close, in every member, and it is not the printed one."""
    for member in text.split("="):
        depth = 0
        for character in member:
            depth += {"(": 1, ")": -1}.get(character, 0)
            if depth < 0:
                return
        if depth:
            return
    if text != printed and "()" not in text:
        yield text
