"""The form of a certificate: which entries there are, of which type, length and range.

Nothing is computed from a certificate of another form. Numbers are texts: decimals or fractions.
"""

import re
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from .intervals import Refused

Test = Callable[[str, Any], None]

NUMBER = re.compile(r"(?a)-?\d{1,400}(\.\d{1,400})?([eE][+-]?\d{1,3})?|-?\d{1,400}/[1-9]\d{0,400}")
HALF_TURNS = {"half-sine": 1, "constant": 1, "one-sine": 2, "one-cosine": 2}
HALF_TURNS |= {"ricker-symmetric": 9, "ricker-antisymmetric": 9}
FINEST, LARGEST = Fraction(1, 10**9), 10**9
MOST_EVENTS, MOST_SAMPLES = 200_000, 500_000


def _refuse(where: str, value: Any, expected: str) -> None:
    raise Refused(f"{where} is {repr(value)[:60]}; expected {expected}")


def number(low: Any = -LARGEST, high: Any = LARGEST) -> Test:
    def test(where: str, value: Any) -> None:
        if not isinstance(value, str) or not NUMBER.fullmatch(value):
            _refuse(where, value, "a number as text")
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


def one_of(*given: Any) -> Test:
    def test(where: str, value: Any) -> None:
        if not any(type(value) is type(one) and value == one for one in given):
            _refuse(where, value, f"one of {', '.join(map(str, given))}")

    return test


def either(*tests: Test) -> Test:
    """Return a test that passes if one of several does; its message is that of the last."""

    def test(where: str, value: Any) -> None:
        for one in tests[:-1]:
            try:
                return one(where, value)
            except Refused:
                continue
        return tests[-1](where, value)

    return test


def some(test: Test, least: int, most: int) -> Test:
    def of_list(where: str, value: Any) -> None:
        if not isinstance(value, list) or not least <= len(value) <= most:
            _refuse(where, value, f"a list of {least} to {most}" if most > least else f"{least}")
        for place, one in enumerate(value):
            test(f"{where}[{place}]", one)

    return of_list


def row(*tests: Test) -> Test:
    def of_row(where: str, value: Any) -> None:
        if not isinstance(value, list) or len(value) != len(tests):
            _refuse(where, value, f"a list of {len(tests)}")
        for place, (test, one) in enumerate(zip(tests, value, strict=True)):
            test(f"{where}[{place}]", one)

    return of_row


def mapping(**entries: Test) -> Test:
    """Return a test of a mapping that has these keys and no other."""

    def of_mapping(where: str, value: Any) -> None:
        if not isinstance(value, dict):
            _refuse(where, value, "a mapping")
        for key in entries.keys() - value.keys():
            raise Refused(f"{where} lacks {key}")
        for key in value.keys() - entries.keys():
            raise Refused(f"{where} has {key!r}; expected {', '.join(entries)}")
        for key, test in entries.items():
            test(f"{where}.{key}", value[key])

    return of_mapping


def anything(where: str, value: Any) -> None:
    """Accept any value: no conclusion rests on this entry."""


SIZE, TIME, ANGLE, HINT = number(FINEST), number(0, 1000), number(-100, 100), number(-1000, 1000)
SIDES = {"half_width": SIZE, "half_height": SIZE, "gravity": SIZE}
SIDES |= {"mass_ratio": either(one_of("infinite"), number(0))}
STRUCTURES = {
    "block": {
        "slenderness": number(FINEST, Fraction(157, 100)),
        "frequency_parameter": SIZE,
        "restitution": number(0, 1),
    },
    "frame": SIDES,
    "body": SIDES | {"axis": number(0), "cap_width": number(0), "cap_depth": number(0)},
}
PULSE = mapping(shape=one_of(*HALF_TURNS), amplitude=number(), angular_frequency=SIZE)
RECORD = mapping(time_step=SIZE, acceleration=some(number(), 2, MOST_SAMPLES))
BRACKET = row(number(0, MOST_SAMPLES), number(0, MOST_SAMPLES))
RANGE, PIECE = row(ANGLE, ANGLE), whole(0, MOST_SAMPLES)
BOUND = some(row(row(TIME, TIME), number(), RANGE), 1, MOST_EVENTS)
EVENTS = {
    "uplift": mapping(event=anything, sigma=BRACKET, side=one_of(1, -1), jumps=truth, piece=PIECE),
    "step": mapping(
        event=anything, h=TIME, box=RANGE, last=truth, impact=either(one_of(None), row(HINT, HINT))
    ),
    "bounded": mapping(event=anything, energy=number(), walls=RANGE, steps=BOUND),
    "gone": mapping(event=anything),
    "rests": mapping(event=anything, sigma=BRACKET, highest=RANGE),
}


def structure(where: str, value: Any) -> None:
    kind: Any = value.get("kind") if isinstance(value, dict) else None
    one_of(*STRUCTURES)(f"{where}.kind", kind)
    mapping(kind=anything, **STRUCTURES[kind])(where, value)


def excitation(where: str, value: Any) -> None:
    is_pulse = isinstance(value, dict) and "shape" in value
    (PULSE if is_pulse else RECORD)(where, value)


def event(where: str, value: Any) -> None:
    name: Any = value.get("event") if isinstance(value, dict) else None
    one_of(*EVENTS)(f"{where}.event", name)
    EVENTS[name](where, value)


CERTIFICATE = mapping(
    structure=structure,
    linearised=truth,
    excitation=excitation,
    factor=row(number(), number()),
    outcome=one_of("survives", "overturns"),
    impacts=whole(0, MOST_EVENTS),
    bits=whole(32, 1024),
    order=whole(2, 128),
    events=some(event, 0, MOST_EVENTS),
)


def validated(certificate: Any) -> None:
    """Raise `Refused`, with the entry and what was expected, unless a certificate has the form.

    What only a motion under a pulse can have is refused under a record.
    """
    if isinstance(certificate, dict):  # nothing is concluded from its `claim`
        certificate = {key: value for key, value in certificate.items() if key != "claim"}
    CERTIFICATE("certificate", certificate)
    low, high = map(Fraction, certificate["factor"])
    if not low <= high:
        _refuse("certificate.factor", certificate["factor"], "two in ascending order")
    if "shape" in certificate["excitation"]:
        for place, one in enumerate(certificate["events"]):
            bracket = one.get("sigma") or ["0"]
            if max(map(Fraction, bracket)) > 1000:
                _refuse(f"certificate.events[{place}].sigma", bracket, "at most 1000")
    elif any(one["event"] == "bounded" for one in certificate["events"]):
        raise Refused("a record has no bound; expected a pulse")
