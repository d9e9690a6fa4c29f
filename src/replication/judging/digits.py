"""The digits of a number in print: as many as its tolerance, or else its error, justifies."""

import math
from decimal import Decimal

from replication.judging.claim import JudgedClaim

MOST_FIGURES = 6
"""A number that is compared with no printed one has at most so many significant figures."""

MOST_DECIMALS = 17


def numbers(row: JudgedClaim) -> dict[str, str]:
    """Return the printed, computed and meant number of a claim in decimals; no texts and truths.

    A number beside a printed one is shown to a tenth of the claim's tolerance. It has more digits
    where these would round an agreement away, or feign one. Any other number has the decimals that
    its error justifies. The printed number has its own digits.
    """
    found = {"printed": row.printed, "computed": row.computed, "meant": row.meant}
    shown = {}
    for field, value in found.items():
        if isinstance(value, bool | str) or value is None:
            continue
        if field == "printed":
            shown[field] = f"{Decimal(repr(value)):f}"
        else:
            shown[field] = decimals(value, row.error or 0.0, row.printed, row.tolerance)
    return shown


def decimals(
    value: float, error: float, printed: float | str | None, tolerance: float | None
) -> str:
    """Return a computed number in decimals, beside a printed one if it has a tolerance."""
    if tolerance is None or not isinstance(printed, int | float):
        return by_error(value, error)
    return beside_print(value, printed, tolerance)


def beside_print(value: float, printed: float, tolerance: float) -> str:
    """Return a number to a tenth of a tolerance, so that a reader sees whether it agrees.

    A whole number beside a whole one stays one.
    """
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


def by_error(value: float, error: float) -> str:
    """Return a number with the decimals that its error justifies, and MOST_FIGURES at most."""
    magnitude = math.floor(math.log10(abs(value))) if value else 0
    most = max(0, MOST_FIGURES - 1 - magnitude)
    if error and (justified := _decimals(error)) < most:
        return f"{value:.{justified}f}"
    text = f"{value:.{most}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def _decimals(error: float) -> int:
    """Return the decimals that round a number by an error at most."""
    return max(0, math.ceil(-math.log10(2.0 * error) - 1e-9))
