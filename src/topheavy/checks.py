"""Check single values; the messages give the value and the expected one."""

import math
import sys
import warnings
from contextlib import suppress
from dataclasses import fields
from os.path import dirname
from reprlib import Repr
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

MAX_ACCELERATION = 1e6
"""Upper limit of a ground acceleration, g: the square of a larger one might overflow."""

MAX_BY_UNIT = {"g": MAX_ACCELERATION, "m": 1e9, "s": 1e9, "rad": 1e9, "rad/s": 1e9}
"""Upper limits by unit: powers of a larger number might overflow."""

MAX_CELLS = 100_000_000
"""Maximum size of a map or a search, which are held in memory."""

MAX_USUAL_ACCELERATION = 2.0
"""g. Few ground accelerations exceed it: of one that does a warning asks the unit."""

MIN_USUAL_ACCELERATION = 0.005
"""g. Few records of interest have a smaller peak: of one that does a warning asks the unit."""

MAX_USUAL_STEP = 0.2
"""s. Few records have a longer time step: a warning asks whether it is in ms."""

MAX_USUAL_VELOCITY = 5.0
"""m/s. Few ground motions exceed it: a warning asks whether a velocity is in cm/s."""

MAX_USUAL_FACTOR = 1000.0
"""Few records are scaled by more: a warning asks whether the record is noise."""

_SHORT = Repr()
_SHORT.maxother = 80
short_repr = _SHORT.repr
"""Return the repr of a value, and only the beginning and end of a long one."""

_HERE = dirname(__file__)


def warn(message: str) -> None:
    """Warn in the line from which the library was called."""
    frame, level = sys._getframe(1), 2
    while frame.f_back and frame.f_code.co_filename.startswith((_HERE, "<string>")):
        frame, level = frame.f_back, level + 1
    warnings.warn(message, stacklevel=level)


def repr_of_fields(instance: Any) -> str:
    """Return the repr of a dataclass, with only the beginning and end of each long field."""
    names = (field.name for field in fields(instance))
    values = (f"{name}={short_repr(getattr(instance, name))}" for name in names)
    return f"{type(instance).__name__}({', '.join(values)})"


def number(name: str, value: Any) -> float:
    """Return `value` as a float, infinite or NaN also, or raise ValueError that names it.

    A text, a truth value and an array are refused, although Python converts some of them.
    """
    if type(value) is float:
        return value
    if np.ma.is_masked(value):
        raise ValueError(f"{name} is masked; expected a number: fill the gap before")
    if np.ndim(value) == 0 and not isinstance(value, (str, bytes, bool, np.bool_)):
        with suppress(TypeError, ValueError, OverflowError):
            return float(value)
    raise ValueError(f"{name} is {short_repr(value)}; expected a number")


def finite(name: str, value: Any) -> float:
    """Return `value` as a finite float, or raise ValueError that names it."""
    result = number(name, value)
    if not math.isfinite(result):
        raise ValueError(f"{name} is {result}; expected a finite number")
    return result


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return a copy of `values` as an array of floats, infinite or NaN also, or raise ValueError.

    The message names the first element that `number` refuses. Masked elements are refused: NumPy
    would drop the mask and keep what is under it.
    """
    _refuse_masked(name, values)
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name}: {error}; expected rows of equal length") from None
    if array.dtype.kind not in "iuf":
        for index, value in enumerate(np.asarray(values, dtype=object).ravel()):
            number(f"{name}: element {index}", value)
    return np.array(array, dtype=float)


def _refuse_masked(name: str, values: ArrayLike) -> None:
    if masked := _masked(values):
        elements = "element" if masked == 1 else "elements"
        raise ValueError(
            f"{name} has {masked} masked {elements}; expected numbers: fill the gaps before, or "
            "leave them out"
        )


def _masked(values: Any) -> int:
    """Return the number of masked elements of an array or of lists of arrays."""
    if isinstance(values, list | tuple):
        return sum(map(_masked, values))
    return int(np.ma.getmaskarray(values).sum()) if isinstance(values, np.ma.MaskedArray) else 0


def axis_values(
    name: str, values: ArrayLike, unit: str = "", *, zero_allowed: bool = False
) -> NDArray[np.float64]:
    """Return `values` as an axis of finite floats above (or from) zero, or raise ValueError."""
    array = np.atleast_1d(numbers(name, values))
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} has shape {array.shape}; expected a list of numbers, not empty")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} holds {array[~np.isfinite(array)][0]}; expected finite numbers")
    if (array < 0.0).any() or not (zero_allowed or array.all()):
        sign = "negative" if zero_allowed else "zero or negative"
        raise ValueError(f"{name} goes down to {array.min():.6g}; it cannot be {sign}")
    within_reason(name, array.max(), unit)
    return array


def positive(name: str, value: Any, unit: str = "") -> float:
    """Return `value` as a float above zero, or raise ValueError that names it."""
    number = finite(name, value)
    if number <= 0.0:
        raise ValueError(f"{name} is {_with_unit(number, unit)}; expected more than zero")
    return within_reason(name, number, unit)


def not_negative(name: str, value: Any, unit: str = "") -> float:
    """Return `value` as a float of zero or more, or raise ValueError that names it."""
    number = finite(name, value)
    if number < 0.0:
        raise ValueError(f"{name} is {_with_unit(number, unit)}; expected zero or more")
    return within_reason(name, number, unit)


def number_of_cells(name: str, *sizes: int) -> None:
    """Raise ValueError unless a grid of these sizes fits in memory."""
    if (count := math.prod(sizes)) > MAX_CELLS:
        raise ValueError(f"{name}: {count:.3g} cells; expected at most {MAX_CELLS:.0e}")


def wider_than_column(span: Any, width: float) -> float:
    """Return the span (m) between the axes of columns of a width (m), or raise ValueError."""
    number = positive("span", span, "m")
    if number <= width:
        raise ValueError(
            f"span is {number:.6g} m; expected more than the width of a column, "
            f"{width:.6g} m, as it is the distance between their axes"
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
    if not low <= (result := number(name, value)) <= high:
        raise ValueError(
            f"{name} is {short_repr(value)}; expected a number from {low:g} to {high:g}"
        )
    return result


def whole(name: str, value: Any, least: int, most: float = math.inf) -> int:
    """Return `value` as an int from `least` to `most`, or raise ValueError."""
    number = finite(name, value)
    if number != int(number) or not least <= number <= most:
        end = "on" if most == math.inf else f"to {most}"
        raise ValueError(f"{name} is {value}; expected a whole number from {least} {end}")
    return int(value)


def truth(name: str, value: Any) -> bool:
    """Return `value`, True or False of Python or NumPy, as a bool, or raise ValueError."""
    if not isinstance(value, (bool, np.bool_)):
        raise ValueError(f"{name} is {short_repr(value)}; expected True or False")
    return bool(value)


def truths(name: str, values: ArrayLike) -> NDArray[np.bool_]:
    """Return a copy of `values` as an array of True and False, or raise ValueError."""
    _refuse_masked(name, values)
    if (array := np.asarray(values)).dtype != bool:
        raise ValueError(f"{name} is {short_repr(values)}; expected True or False in each place")
    return np.array(array)


def set_fields(instance: Any, **values: float) -> None:
    """Set fields of a frozen dataclass to checked values, as floats of Python for the kernel."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)


def fraction(name: str, value: Any) -> float:
    """Return `value` inside [0, 1], or raise ValueError that names it."""
    return within(name, value, 0.0, 1.0)


def within_reason(name: str, value: Any, unit: str) -> float:
    """Return `value` as a finite float within the limit of its unit, or raise ValueError."""
    number = finite(name, value)
    if abs(number) > (most := MAX_BY_UNIT.get(unit, math.inf)):
        raise ValueError(f"{name} is {number:.6g} {unit}; expected at most {most:.0e} {unit}")
    return number


def _with_unit(number: float, unit: str) -> str:
    return f"{number:.6g} {unit}".rstrip()
