"""Numbers of a document: those that quote a source, and those without one."""

import re
from collections import Counter
from html.parser import HTMLParser
from typing import NamedTuple

NAMES = re.compile(
    r"(?:(?:Eqs?\.|Equations?|paper’s|its|restitution|size|and) \(\d+\)|Theorems? \d)"
    r"(?:(?:, | and | to )(?:\(\d+\)|\d))*"  # Eqs. (1), (2) and (3)
    r"|(?:Figures?|Tables?|Figs?\.|pages?|p\.|par\.) S?\d+(?:, \(\d\))?"
    r"|(?:^|[.;:] )\(\d\) "  # numbers of an enumeration
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
        self.count: Counter[str] = Counter()  # classes "number", with a source, and "typed"
        self.quotes: list[Quote] = []  # in the order of their links
        self.without: list[tuple[str, str]] = []  # a number, and its sentence
        self.open: list[tuple[str, str]] = []  # tag and class
        self.text, self.free = "", list[tuple[int, str]]()
        self.links: list[tuple[int, str, str]] = []  # place in the text, source, target
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
            self.free = [(p, n) for p, n in self.free if p < self.equation or len(n) > 1]
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
        for place, number in self.free:
            is_sign = number == "0" and re.search("[=<>≤≥] ?$", self.text[:place])
            if not is_sign and not any(start <= place < end for start, end in named):
                self.without.append((number, self.sentence(place)))
        row = f"{self.row}: " if self.row and any(tag == "td" for tag, _ in self.open) else ""
        for place, source, target in self.links:
            self.quotes.append(Quote(source, target, self.heading, row + self.sentence(place)))
        self.ended, self.text, self.free, self.links = self.text.strip(), "", [], []

    def sentence(self, place: int) -> str:
        """Return the sentence that has a place of the text."""
        ends = [0, *(hit.end() for hit in SENTENCE.finditer(self.text)), len(self.text)]
        first = max(end for end in ends if end <= place)
        return " ".join(self.text[first : min(end for end in ends if end > place)].split())
