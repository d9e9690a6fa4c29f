"""Numbers in the plain text of captions and claims, each with a mark that names its source.

⟨config:vase.period|1.5⟩ is a number with its source. One that is typed has its reason instead:
⟨as heavy as both columns|1⟩.
"""

import math
import re
from collections.abc import Iterable, Mapping
from functools import reduce
from operator import getitem
from typing import Any

WORDS = "no one two three four five six seven eight nine ten eleven twelve"


class Input:
    """A part of a config that a text names as {vase[period]:g}; in the text, it has a mark.

    A factor may stand before the format, {trilith[table_amplitude]:1000*g}. A list is read out, or
    counted, {spectra[shapes]:count}, and has a `last`.
    """

    def __init__(self, content: Any, path: str) -> None:
        self.content, self.path = content, path

    def __getitem__(self, key: str | int) -> "Input":
        if key == "last" and isinstance(self.content, list):
            key = len(self.content) - 1
        try:
            return Input(self.content[key], f"{self.path}{key}.")
        except (LookupError, TypeError):
            raise KeyError(f"{self.path}{key}") from None

    def __format__(self, how: str) -> str:
        if how == "count":
            count = len(self.content)
            number = dict(enumerate(WORDS.split())).get(count, count)
            return f"⟨{self.path.rstrip('.')}|{number}⟩"
        if isinstance(self.content, list | dict):
            keys = self.content if isinstance(self.content, dict) else range(len(self.content))
            return and_list(format(self[key], how) for key in keys)
        factor, _, form = how.rpartition("*")
        number = self.content * float(factor) if factor else self.content
        return f"⟨{self.path.rstrip('.')}|{'∞' if number == math.inf else format(number, form)}⟩"


class Column:
    """{column[temple]} is height by width of a structure of the config, 6 m by 1 m.

    {column[temple]:0.5*} is half of both; {column[motions.structures]} takes the names from a key.
    """

    def __init__(self, settings: Mapping[str, Any], path: str = "") -> None:
        self.settings, self.path = settings, path

    def __getitem__(self, path: str) -> "Column":
        return Column(self.settings, path)

    def __format__(self, how: str) -> str:
        *keys, names = self.path.split(".")
        if keys:
            section = reduce(getitem, keys, self.settings)
            names = section[names]
        form = f"{2 * float(how.rstrip('*') or 1)}*g"
        halves = [
            [
                f"{Input(self.settings, 'config:')['structures'][name][half]:{form}} m"
                for half in ("half_height", "half_width")
            ]
            for name in ([names] if isinstance(names, str) else names)
        ]
        return and_list(" by ".join(pair) for pair in halves)


def and_list(words: Iterable[str]) -> str:
    """Return words as 1, 2 and 3."""
    *most, last = words
    return ", ".join(most) + " and " * bool(most) + last


def inputs(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a text may name in braces."""
    whole = Input(settings, "config:")
    return {key: whole[key] for key in settings} | {"column": Column(settings)}


def without_marks(text: str) -> str:
    """Return a text without the marks of its numbers."""
    return re.sub(r"⟨[^|⟩]*\|([^⟩]*)⟩", r"\1", text)
