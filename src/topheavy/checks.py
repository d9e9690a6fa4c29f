"""Check single values; the messages give the value and the expected one."""

import math
import sys
import warnings
from os.path import dirname
from reprlib import Repr
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

LARGEST_ACCELERATION = 1e6
"""Of a ground motion, g. Far beyond any; far below where squares overflow and a fall is missed."""

LARGEST = {"m": 1e9, "s": 1e9, "rad/s": 1e9}
"""Of a number with this unit: far beyond any; far below where powers of it overflow."""

MOST_CELLS = 100_000_000
"""Of a map or of a search, which are held in memory."""

LARGEST_RECORDED = 2.0
"""g. Few ground accelerations exceed it: of one that does a warning asks the unit."""

LARGEST_PULSE = 50.0
"""g. Few pulses are as strong: a warning asks whether an amplitude is in m/s² or cm/s²."""

LONGEST_STEP = 4.0
"""s. Few records have a longer time step: a warning asks whether it is in ms."""

LARGEST_VELOCITY = 5.0
"""m/s. Few ground motions exceed it: a warning asks whether a velocity is in cm/s."""

FARTHEST_START = 2.0
"""Of α. Few histories begin with a larger rotation: a warning asks whether it is in degrees."""

LONGEST = 200.0
"""m. Few structures exceed it: a warning asks whether a length is in cm or mm."""

_SHORT = Repr()
_SHORT.maxother = 80
short = _SHORT.repr
"""What a message shows of a value: its repr, and only the beginning and end of a long one."""

_HERE = dirname(__file__)


def warn(message: str) -> None:
    """Warn in the line from which the library was called."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_code.co_filename.startswith((_HERE, "<string>")):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, stacklevel=level)


def number(name: str, value: Any) -> float:
    """Return `value` as a float, infinite or NaN also, or raise ValueError that names it.

    A text, a truth value, an array and a masked value are no numbers, even where Python converts
    them: such a value is probably a mistake.
    """
    if getattr(value, "ndim", 0):
        raise ValueError(f"{name} is an array of shape {value.shape}; expected a number")
    if np.ma.is_masked(value):
        raise ValueError(f"{name} is masked; expected a number")
    plain = value.item() if isinstance(value, np.ndarray) else value
    if isinstance(plain, (str, bytes, bool, np.bool_)):
        raise ValueError(f"{name} is {plain!r}; expected a number")
    try:
        return float(plain)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} is {short(plain)}; expected a number") from None


def finite(name: str, value: Any) -> float:
    """Return `value` as a finite float, or raise ValueError that names it."""
    found = number(name, value)
    if not math.isfinite(found):
        raise ValueError(f"{name} is {found}; expected a finite number")
    return found


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return a copy of `values` as an array of floats, infinite or NaN also, or raise ValueError.

    Refuses in an array what `number` refuses alone, and names the first such element.
    """
    if np.ma.is_masked(values):
        masked = np.ma.getmaskarray(np.ma.asarray(values)).ravel()
        raise ValueError(
            f"{name} has {masked.sum()} masked of {masked.size} elements, the first at index "
            f"{masked.argmax()}; expected a number for each: fill them, or leave them out"
        )
    try:
        found = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: {error}; expected rows of equal length") from None
    if found.dtype.kind not in "iuf":
        for index, value in enumerate(np.asarray(values, dtype=object).ravel()):
            number(f"{name}: element {index}", value)
    return np.array(found, dtype=float)


def axis(name: str, values: ArrayLike, *, zero_allowed: bool) -> NDArray[np.float64]:
    """Return `values` as an axis of finite floats above (or from) zero, or raise ValueError."""
    found = np.atleast_1d(numbers(name, values))
    if found.ndim != 1 or found.size == 0:
        raise ValueError(f"{name} has shape {found.shape}; expected a list of numbers, not empty")
    if not np.isfinite(found).all():
        raise ValueError(f"{name} holds {found[~np.isfinite(found)][0]}; expected finite numbers")
    if (found < 0.0).any() or not (zero_allowed or found.all()):
        sign = "negative" if zero_allowed else "zero or negative"
        raise ValueError(f"{name} goes down to {found.min():.6g}; it cannot be {sign}")
    return found


def positive(name: str, value: Any, unit: str = "") -> float:
    """Return `value` as a float above zero, or raise ValueError that names it."""
    number = finite(name, value)
    if number <= 0.0:
        raise ValueError(f"{name} is {_with_unit(number, unit)}; expected more than zero")
    return _within_reason(name, number, unit)


def not_negative(name: str, value: Any, unit: str = "") -> float:
    """Return `value` as a float of zero or more, or raise ValueError that names it."""
    number = finite(name, value)
    if number < 0.0:
        raise ValueError(f"{name} is {_with_unit(number, unit)}; expected zero or more")
    return _within_reason(name, number, unit)


def cells(name: str, *sizes: int) -> None:
    """Raise ValueError if so many cells would exhaust the memory of a machine."""
    if (count := math.prod(sizes)) > MOST_CELLS:
        raise ValueError(f"{name}: {count:.3g} cells; expected at most {MOST_CELLS:.0e}")


def wider_than_column(span: Any, width: float) -> float:
    """Return the span (m) between the axes of columns of a width (m), or raise ValueError."""
    number = positive("span", span, "m")
    if number > LONGEST:
        warn(f"span is {number:.6g} m, and few exceed {LONGEST:g} m: is it in cm or mm?")
    if number <= width:
        raise ValueError(
            f"span is {number:.6g} m; expected more than the width of a column, "
            f"{width:.6g} m, as it is the distance between their axes"
        )
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


def within(name: str, value: Any, low: float, high: float) -> float:
    """Return `value` as a float inside [low, high], or raise ValueError that names it."""
    if not (isinstance(value, (float, int)) and low <= value <= high):
        raise ValueError(f"{name} is {short(value)}; expected a float from {low:g} to {high:g}")
    return value


def fraction(name: str, value: Any) -> float:
    """Return `value` inside [0, 1], or raise ValueError that names it."""
    number = finite(name, value)
    if not 0.0 <= number <= 1.0:
        raise ValueError(f"{name} is {number:.6g}; expected a value from 0 to 1")
    return number


def _within_reason(name: str, number: float, unit: str) -> float:
    if number > (most := LARGEST.get(unit, math.inf)):
        raise ValueError(f"{name} is {number:.6g} {unit}; expected at most {most:.0e} {unit}")
    return number


def _with_unit(number: float, unit: str) -> str:
    return f"{number:.6g} {unit}".rstrip()
