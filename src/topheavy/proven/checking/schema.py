"""The form of a certificate: which entries there are, of which type, length and range.

Nothing is computed from a certificate of another form. Numbers are texts: decimals or fractions.
"""

import re
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from .intervals import NotProven

Test = Callable[[str, Any], None]

DECIMAL = r"(?a)-?\d{1,400}(\.\d{1,400})?([eE][+-]?\d{1,3})?"
NUMBER = DECIMAL + r"|-?\d{1,400}/[1-9]\d{0,400}"
WAVES = ("sine", "cosine", "constant", "ricker-symmetric", "ricker-antisymmetric")
MAX_HALF_PERIODS = 200
MIN_SIZE, MAX_NUMBER = Fraction(1, 10**9), 10**9
MAX_EVENTS = 20_000


def _refuse(where: str, value: Any, expected: str) -> None:
    raise NotProven(f"{where} is {repr(value)[:60]}; expected {expected}")


def number(low: Any = -MAX_NUMBER, high: Any = MAX_NUMBER, form: str = NUMBER) -> Test:
    pattern = re.compile(form)

    def test(where: str, value: Any) -> None:
        if not isinstance(value, str) or not pattern.fullmatch(value):
            _refuse(where, value, "a number as text" if form == NUMBER else "a decimal as text")
        if not low <= Fraction(value) <= high:
            _refuse(where, value, f"a number from {float(low):g} to {float(high):g}")

    return test


def whole(low: int, high: int) -> Test:
    def test(where: str, value: Any) -> None:
        if type(value) is not int or not low <= value <= high:
            _refuse(where, value, f"a whole number from {low} to {high}")

    return test


def truth(where: str, value: Any) -> None:
    if not isinstance(value, bool):
        _refuse(where, value, "true or false")


def one_of(*values: Any) -> Test:
    def test(where: str, value: Any) -> None:
        if not any(type(value) is type(one) and value == one for one in values):
            _refuse(where, value, f"one of {', '.join(map(str, values))}")

    return test


def either(value: Any, test: Test) -> Test:
    """Return a test that passes for one value, or as the other test says."""

    def tested(where: str, entry: Any) -> None:
        if type(entry) is not type(value) or entry != value:
            test(where, entry)

    return tested


def one_form(name: str, forms: dict[str, dict[str, Any]]) -> Test:
    """Return a test of a mapping whose entry `name` says which form it has."""

    def test(where: str, value: Any) -> None:
        word: Any = value.get(name) if isinstance(value, dict) else None
        one_of(*forms)(f"{where}.{name}", word)
        _fits(where, value, {name: one_of(word), **forms[word]})

    return test


def events(where: str, value: Any) -> None:
    if not isinstance(value, list) or len(value) > MAX_EVENTS:
        _refuse(where, value, f"a list of at most {MAX_EVENTS}")
    for place, event in enumerate(value):
        EVENT(f"{where}[{place}]", event)


def _fits(where: str, value: Any, form: Any) -> None:
    """Raise `NotProven` unless a value has a form: these keys, this many entries, or a test."""
    if isinstance(form, dict):
        if not isinstance(value, dict):
            _refuse(where, value, "a mapping")
        for key in value.keys() ^ form.keys():
            verb = "has" if key in value else "lacks"
            raise NotProven(f"{where} {verb} {key!r}; expected {', '.join(form)}")
        for key, inner in form.items():
            _fits(f"{where}.{key}", value[key], inner)
    elif isinstance(form, tuple):
        if not isinstance(value, list) or len(value) != len(form):
            _refuse(where, value, f"a list of {len(form)}")
        for place, (entry, inner) in enumerate(zip(value, form, strict=True)):
            _fits(f"{where}[{place}]", entry, inner)
    else:
        form(where, value)


SIZE, PHASE, ANGLE = number(MIN_SIZE), number(0, 1000), number(-100, 100)
AMPLITUDE = number(form=DECIMAL)
SIDES = {"half_width": SIZE, "half_height": SIZE, "gravity": SIZE}
SIDES |= {"mass_ratio": either("infinite", number(0))}
STRUCTURES = {
    "block": {
        "slenderness": number(MIN_SIZE, Fraction(157, 100)),
        "frequency_parameter": SIZE,
        "restitution": number(0, 1),
    },
    "frame": SIDES,
    "body": SIDES | {"axis": number(0), "cap_width": number(0), "cap_depth": number(0)},
}
EVENT = one_form(
    "event",
    {
        "uplift": {"sigma": PHASE},
        "step": {"h": PHASE, "last": truth, "impact": either(None, number(-1000, 1000))},
        "walls": {"sigma": PHASE, "walls": (ANGLE, ANGLE)},
        "gone": {},
    },
)
CERTIFICATE = {
    "structure": one_form("kind", STRUCTURES),
    "linearised": truth,
    "pulse": {
        "wave": one_of(*WAVES),
        "half_periods": whole(1, MAX_HALF_PERIODS),
        "amplitude": AMPLITUDE,
        "angular_frequency": SIZE,
    },
    "factor": (AMPLITUDE, AMPLITUDE),
    "outcome": one_of("survives", "overturns"),
    "impacts": either(None, whole(0, MAX_EVENTS)),
    "bits": whole(32, 1024),
    "order": whole(4, 128),
    "events": events,
}


def validated(certificate: Any) -> None:
    """Raise `NotProven`, with the entry and what is expected, unless a certificate has the form."""
    _fits("certificate", certificate, CERTIFICATE)
    low, high = map(Fraction, certificate["factor"])
    if not low <= high:
        _refuse("certificate.factor", certificate["factor"], "two in ascending order")
