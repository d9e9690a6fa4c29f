"""Checks of single values, with messages that say what was expected and what came."""

import math
from typing import Any

LARGEST_ACCELERATION = 1e6
"""Of a ground motion, g. Far beyond any; far below where squares overflow and a fall is missed."""


def finite(name: str, value: Any) -> float:
    """Return `value` as a finite float, or raise ValueError that names it."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {value!r}; expected a number") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} is {number}; expected a finite number")
    return number


def positive(name: str, value: Any, unit: str = "") -> float:
    """Return `value` as a float above zero, or raise ValueError that names it."""
    number = finite(name, value)
    if number <= 0.0:
        raise ValueError(f"{name} is {_with_unit(number, unit)}; expected more than zero")
    return number


def acceleration(name: str, value: Any) -> float:
    """Return `value` (g) as a float within ±`LARGEST_ACCELERATION`, or raise ValueError."""
    number = finite(name, value)
    if abs(number) > LARGEST_ACCELERATION:
        raise ValueError(
            f"{name} is {number:.6g} g; expected at most {LARGEST_ACCELERATION:.0e} g in magnitude"
        )
    return number


def within_quarter_turn(name: str, value: Any) -> float:
    """Return the angle `value` (rad) inside (0, π/2), or raise ValueError that names it."""
    number = finite(name, value)
    if not 0.0 < number < math.pi / 2:
        raise ValueError(
            f"{name} is {number:.6g} rad ({math.degrees(number):.4g}°); "
            "expected an angle between 0 and π/2, both excluded"
        )
    return number


def fraction(name: str, value: Any) -> float:
    """Return `value` inside [0, 1], or raise ValueError that names it."""
    number = finite(name, value)
    if not 0.0 <= number <= 1.0:
        raise ValueError(f"{name} is {number:.6g}; expected a value from 0 to 1")
    return number


def _with_unit(number: float, unit: str) -> str:
    return f"{number:.6g} {unit}".rstrip()
