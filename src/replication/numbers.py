"""Numbers and their sources: marks in plain text, and the numbers of a document without one.

In the text of a caption or a claim, ⟨config:vase.period|1.5⟩ is a number with its source. One that
is typed has its reason instead: ⟨as heavy as both columns|1⟩.
"""

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from decimal import Decimal
from functools import reduce
from html.parser import HTMLParser
from operator import getitem
from typing import Any, NamedTuple

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
        return and_list(" by ".join(each) for each in halves)


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


def print_rounding(printed: float) -> float:
    """Return half a unit of the last digit of a printed number: 0.0005 of 0.275, 0.5 of 5.

    A trailing zero is not kept by YAML: 0.50 counts as 0.5.
    """
    exponent = Decimal(repr(printed)).normalize().as_tuple().exponent
    return 0.5 * 10.0 ** min(int(exponent), 0)


# Numbers of a document ----------------------------------------------------------------------------

NAMES = re.compile(
    r"(?:(?:Eqs?\.|Equations?|paper’s|its|restitution|size|and) \(\d+\)|Theorems? \d)"
    r"(?:(?:, | and | to )(?:\(\d+\)|\d))*"  # Eqs. (1), (2) and (3)
    r"|(?:Figures?|Tables?|Figs?\.|pages?|p\.|par\.) S?\d+(?:, \(\d\))?"
    r"|(?:^|[.;:] )\(\d\) "  # of an enumeration
    r"|(?:al\.|[A-Z]\w+) \(?\d{4}\b"  # Allen et al. (1986)
    r"|record of \d{4}"
)
"""Names of equations, figures, pages and years."""
BLOCKS = {"p", "li", "td", "th", "tr", "h1", "h2", "h3", "h4", "div", "figcaption", "table", "main"}
SKIPPED = {"a", "code", "head", "h1", "h2", "h3", "h4", "nav", "section"}  # a section: references
VOID = {"br", "img", "link", "meta"}
SENTENCE = re.compile(r"(?<!\bal)(?<!\bFig)(?<!\bEqs)(?<!\bEq)(?<!\bp)[.?] ")
NUMBER = re.compile(r"\d+(?:\.\d+)?")
VALUE = re.compile(r"([^0-9=]*[=≤<>≥])?[0-9.,°  ]+")
"""An equation that gives a value, such as γ = 0.5; all others are formulas."""


class Quote(NamedTuple):
    """A number of a document: its source, where its link leads, heading and sentence."""

    source: str
    target: str
    place: str
    sentence: str


class Numbers(HTMLParser):
    """The numbers of a document that Typst compiled to HTML with links (paper/format.typ).

    Digits of headings, links, references and code are no results; nor are those of formulas, unless
    they have several, and a zero after a relation.
    """

    def __init__(self, html: str) -> None:
        super().__init__()
        self.html = html
        self.count: Counter[str] = Counter()  # of "number", with a source, and of "typed"
        self.quotes: list[Quote] = []  # in the order of their links
        self.without: list[tuple[str, str]] = []  # a number, and its sentence
        self.open: list[tuple[str, str]] = []  # tag and class
        self.text, self.free = "", list[tuple[int, str]]()
        self.links: list[tuple[int, str, str]] = []  # of numbers: place in the text, source, target
        self.heading, self.row = "", ""
        self.equation = 0  # where it begins in the text
        self.feed(html)
        self.flush()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Begin a block, an equation, or a number with its source."""
        about = {name: content or "" for name, content in attrs}
        if tag in BLOCKS:
            self.flush()
        if tag in VOID:
            self.handle_data(about.get("alt", ""))
            return
        if tag == "math":
            self.equation = len(self.text)
        if tag == "tr":
            self.row = ""
        if about.get("class") == "number":
            self.links.append((len(self.text), about["title"], about["href"]))
        self.open.append((tag, about.get("class", "")))
        self.count[self.open[-1][1]] += 1

    def handle_endtag(self, tag: str) -> None:
        """End a block; an equation that is a formula has no numbers."""
        if tag == "math" and not VALUE.fullmatch(self.text[self.equation :].strip()):
            self.free = [(at, n) for at, n in self.free if at < self.equation or len(n) > 1]
        while self.open and self.open.pop()[0] != tag:
            pass
        if tag in ("h2", "h3"):
            self.heading = self.text.strip()
        if tag in BLOCKS:
            self.flush()
        if tag == "td" and not self.row:
            self.row = self.ended

    def handle_data(self, data: str) -> None:
        """Take text, and note its numbers."""
        marked = any(name in ("number", "typed", "name", "by") for _, name in self.open)
        if not marked and not {tag for tag, _ in self.open} & SKIPPED:
            self.free += [(len(self.text) + m.start(), m.group()) for m in NUMBER.finditer(data)]
        self.text += data.replace("\u00a0", " ")

    def flush(self) -> None:
        """End the text of a block."""
        named = [hit.span() for hit in NAMES.finditer(self.text)]
        for at, number in self.free:
            is_sign = number == "0" and re.search("[=<>≤≥] ?$", self.text[:at])
            if not is_sign and not any(start <= at < end for start, end in named):
                self.without.append((number, self.sentence(at)))
        row = f"{self.row}: " if self.row and any(tag == "td" for tag, _ in self.open) else ""
        for at, source, target in self.links:
            self.quotes.append(Quote(source, target, self.heading, row + self.sentence(at)))
        self.ended, self.text, self.free, self.links = self.text.strip(), "", [], []

    def sentence(self, at: int) -> str:
        """Return the sentence that has a place of the text."""
        ends = [0, *(hit.end() for hit in SENTENCE.finditer(self.text)), len(self.text)]
        first = max(end for end in ends if end <= at)
        return " ".join(self.text[first : min(end for end in ends if end > at)].split())
