"""What an error message suggests in place of a name that is unknown."""

import difflib
from collections.abc import Iterable
from typing import Any


def hint(given: Any, allowed: Iterable[Any]) -> str:
    """Return the nearest of the names that are allowed, or all of them."""
    names = [str(name) for name in allowed]
    close = difflib.get_close_matches(str(given), names, n=1)
    if close:
        return f"did you mean {close[0]!r}?"
    return f"expected one of {', '.join(names)}" if names else "there are none"
