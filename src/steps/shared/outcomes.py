"""Outcomes over a row of intensities as text, so that a table holds them a line each."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

STANDS, FALLS, UNKNOWN = "s", "f", "?"


def written(fell: ArrayLike, decided: ArrayLike = True) -> str:
    """Return a letter for each outcome: STANDS, FALLS, or UNKNOWN if it cannot be decided."""
    return "".join(np.where(decided, np.where(fell, FALLS, STANDS), UNKNOWN))


def read(texts: Iterable[str]) -> NDArray[np.str_]:
    """Return the letters, a row for each text."""
    return np.array([list(text) for text in texts])
