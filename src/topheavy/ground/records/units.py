"""Units of acceleration and of time, as the headers of records write them."""

import re
import unicodedata
from dataclasses import dataclass

from topheavy.bodies.structures import STANDARD_GRAVITY

UNDERSTOOD = "g, % g, mg, g/10, gal, cm/s², m/s² or mm/s²"
"""The units of acceleration, for messages; each may be spelt in several ways."""

_S = r"(?:seconds?|secs?|s)"
_SQUARED = r"(?:(?:\^|\*\*)?(?:2|\(2\))|\s*squared)"
_PER = r"(?:\s*/\s*|\s+per\s+)"
_ACCELERATION = rf"""(?:
    (?P<hundredth>%\s*g|percent\s+(?:of\s+)?g)
  | g\s*/\s*(?P<part>10{{1,3}})
  | (?P<thousandth>milli-?g|mg)
  | (?P<gal>gals?)
  | (?P<g>g(?:'s)?)
  | (?P<metres>(?P<prefix>milli-?|m|centi-?|c)?(?:met(?:er|re)s?|m)) (?:
        {_PER} {_S} (?:{_SQUARED}|{_PER}{_S})
      | {_PER} \(\s*{_S}{_SQUARED}\s*\)
      | {_PER} (?:sq\.?|square)\s+{_S}
      | [\s·⋅*.]+ {_S} (?:\^|\*\*)?(?:-2|\(-2\))
    )
) (?![\w'^-] | \s*[/*×·⋅^%=] | \s*x\s*\d | \s+per\b | \.\d)"""
_UNIT = re.compile(_ACCELERATION, re.IGNORECASE | re.VERBOSE)

_TIME = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millisecond", "milliseconds"), 1e-3),
}
_STATED = re.compile(
    r"\bunits?(?:\s+of\s+(?:the\s+)?acc\w*\.?)?\s*(?:\b(?:of|are|is|in)\b\s*[:=]?|[:=])\s*[(\[]?\s*",
    re.IGNORECASE,
)
_INTRODUCED = re.compile(r"[(\[{]\s*|\bunits?\s+|\bacc(?:el\w*)?\b\.?\s*[:=]\s*", re.IGNORECASE)
_SAMPLES = re.compile(r"\b(?:acc(?:el\w*)?|data|values?|samples?|points?)\b", re.IGNORECASE)
_IN = re.compile(r"\bin\s+", re.IGNORECASE)
_WORD = re.compile(r"[A-Za-z]+\b(?!\s*[/^*-])")
_PEAK = re.compile(r"\b(?:peak|pga|a?max\w*)\b", re.IGNORECASE)
_DECIMAL = re.compile(r"(?:(?<=\d)\.\d*|\.\d+)\s*")


@dataclass(frozen=True)
class Statement:
    """A unit of acceleration that a header states.

    Attributes
    ----------
    unit : str
        As it is written.
    in_g : float
        One of it, in g.
    place : int
        The number of its line, from 1.
    line : str
        That line.
    """

    unit: str
    in_g: float
    place: int
    line: str


def acceleration_in_g(text: str) -> float | None:
    """Return one unit of acceleration in g, or None for a text that is no such unit.

    1 g is `STANDARD_GRAVITY`, as everywhere in this library.
    """
    match = _UNIT.fullmatch(_plain(text).strip())
    return _in_g(match) if match else None


def time_in_seconds(text: str) -> float | None:
    """Return one unit of time in s, or None for a text that is no such unit."""
    return _TIME.get(text.strip().lower())


def stated_acceleration(lines: list[str]) -> Statement:
    """Return the unit of acceleration that the lines of a header state.

    A statement is a unit after the word "units", after "acceleration in" or "values in", or in
    brackets.

    Raises
    ------
    ValueError
        With the line: when none is stated, when one is not understood, when two contradict.
    """
    found: list[Statement] = []
    for place, line in enumerate((_plain(line).strip() for line in lines), start=1):
        for stated in _STATED.finditer(line):
            if not _UNIT.match(line, stated.end()) and not _is_time(line, stated.end()):
                raise ValueError(
                    f"line {place} states a unit that is not understood: {line!r}; "
                    f"expected {UNDERSTOOD}"
                )
        units = filter(None, (_UNIT.match(line, end) for end in sorted(_where_units_are(line))))
        found += [Statement(unit[0], _in_g(unit), place, line) for unit in units]
    if not found:
        raise ValueError(_nothing_stated(lines))
    for other in found[1:]:
        if other.in_g != found[0].in_g:
            raise ValueError(
                f"line {found[0].place} states {found[0].unit!r} ({found[0].line!r}) and line "
                f"{other.place} states {other.unit!r} ({other.line!r}); expected one unit of "
                "acceleration: take the wrong one out"
            )
    return found[0]


def _where_units_are(line: str) -> set[int]:
    """Return the indices in a line behind what may introduce the unit of all samples.

    The unit of a peak, or behind a decimal number, is that of one value.
    """
    found = {match.end() for match in _STATED.finditer(line)}
    samples = _SAMPLES.search(line)
    introductions = [*_INTRODUCED.finditer(line)]
    if samples:
        introductions += _IN.finditer(line, samples.end())
    peak = _PEAK.search(line)
    peaks_begin = peak.start() if peak else len(line)
    numbers_end = {number.end() for number in _DECIMAL.finditer(line)}
    return found | {
        match.end()
        for match in introductions
        if match.start() < peaks_begin and match.start() not in numbers_end
    }


def _plain(text: str) -> str:
    """Return a text with raised digits, wide letters and the true minus in ASCII."""
    return unicodedata.normalize("NFKC", text).replace("−", "-").replace("’", "'")


def _in_g(unit: re.Match[str]) -> float:
    if unit["metres"]:
        prefix = (unit["prefix"] or "").lower()[:1]
        return {"": 1.0, "c": 0.01, "m": 0.001}[prefix] / STANDARD_GRAVITY
    if unit["gal"]:
        return 0.01 / STANDARD_GRAVITY
    if unit["part"]:
        return 1.0 / int(unit["part"])
    return 0.01 if unit["hundredth"] else 0.001 if unit["thousandth"] else 1.0


def _is_time(line: str, start: int) -> bool:
    word = _WORD.match(line, start)
    return word is not None and time_in_seconds(word[0]) is not None


def _nothing_stated(lines: list[str]) -> str:
    hints = (
        f"line {place} is {line.strip()!r}"
        for place, line in enumerate(lines, start=1)
        if re.search(r"\b(?:units?|acc\w*)\b", line, re.IGNORECASE)
    )
    seen = next(hints, "no line names one")
    return (
        f"lines 1 to {len(lines)} state no unit of acceleration that is understood ({seen}); "
        f"expected {UNDERSTOOD}: write, for example, 'UNITS: G' into the header"
    )
