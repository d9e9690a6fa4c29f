"""The digits of a number in print."""

import math
from decimal import Decimal
from typing import Any

MOST_FIGURES = 6
"""A number that is compared with no printed one has at most so many significant figures."""

MOST_DECIMALS = 17


def print_rounding(printed: float) -> float:
    """Return half a unit of the last digit of a printed number: 0.0005 of 0.275, 0.5 of 5.

    A trailing zero is not kept by YAML: 0.50 counts as 0.5.
    """
    exponent = Decimal(repr(printed)).normalize().as_tuple().exponent
    return 0.5 * 10.0 ** min(int(exponent), 0)


def decimals(
    value: float, error: float, printed: Any = None, tolerance: float | None = None
) -> str:
    """Return a computed number in decimals: to a tenth of a tolerance, or as its error justifies.

    Beside a printed number it has more digits where fewer would round an agreement away, or feign
    one. A whole number beside a whole one stays one.
    """
    if tolerance is None or not isinstance(printed, int | float):
        return _by_error(value, error)
    if isinstance(printed, int) and float(value).is_integer():
        return f"{value:.0f}"
    agrees = abs(value - printed) <= tolerance
    allowed = Decimal(repr(tolerance))
    for digits in range(_decimals(0.1 * tolerance), MOST_DECIMALS):
        text = f"{value:.{digits}f}"
        off = abs(Decimal(text) - Decimal(repr(printed)))
        if off < allowed if agrees else off > allowed:
            break
    return text


def _by_error(value: float, error: float) -> str:
    magnitude = math.floor(math.log10(abs(value))) if value else 0
    most = max(0, MOST_FIGURES - 1 - magnitude)
    if error and (justified := _decimals(error)) < most:
        return f"{value:.{justified}f}"
    text = f"{value:.{most}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def _decimals(error: float) -> int:
    """Return the decimals that round a number by an error at most."""
    return max(0, math.ceil(-math.log10(2.0 * error) - 1e-9))
