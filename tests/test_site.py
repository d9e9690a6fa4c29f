"""The site of a run: links lead somewhere, nothing is requested, every number leads to its line."""

import re
from collections import Counter
from html import unescape
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from urllib.parse import parse_qsl, unquote

import pytest
from fontTools.ttLib import TTFont

from documents.explorer import outcomes
from tests.cases import ROOT

SITE = ROOT / "results/site"
pytestmark = pytest.mark.skipif(not SITE.is_dir(), reason="needs a finished run: make reproduce")


class Page(HTMLParser):
    """What a crawl needs of a page."""

    def __init__(self, path):
        super().__init__()
        self.text = path.read_text("utf-8")
        self.ids, self.links, self.loaded, self.alts = [], [], [], []
        self.levels, self.tags, self.nested = [], Counter(), 0
        self.lang = ""
        self.feed(self.text)

    def handle_starttag(self, tag, attrs):
        about = dict(attrs)
        self.tags[tag] += 1
        if "id" in about:
            self.ids.append(about["id"])
        if tag == "a":
            self.nested += 1
            assert self.nested == 1, f"a link in a link: {about}"
            self.links += [about["href"]] if "href" in about else []
        elif "src" in about or (tag == "link" and "href" in about):
            self.loaded.append(about.get("src") or about["href"])
        if tag == "img":
            self.alts.append(about.get("alt") or "")
        if re.fullmatch("h[1-6]", tag):
            self.levels.append(int(tag[1]))
        self.lang = about.get("lang", "") if tag == "html" else self.lang

    def handle_endtag(self, tag):
        self.nested -= tag == "a"


@pytest.fixture(scope="module")
def pages():
    return {path: Page(path) for path in SITE.rglob("*.html")}


def test_each_link_leads_to_a_file_and_an_anchor(pages):
    broken = set()
    for path, page in pages.items():
        for link in page.links + page.loaded:
            place, _, anchor = link.partition("#")
            if re.match(r"https?:|data:|mailto:", place):
                continue
            target = (path.parent / place).resolve() if place else path
            ids = pages[target].ids if target in pages else []  # of a notebook: as in its links
            is_state = target.name == "explorer.html" and "=" in anchor
            if not target.is_file() or (
                anchor and not {anchor, unquote(anchor)} & set(ids) and not is_state
            ):
                broken.add(f"{path.relative_to(SITE)}: {link}")
    assert not broken


def test_nothing_is_requested(pages):
    for path, page in pages.items():
        styles = re.findall(r"(?:url\(|@import)\s*['\"]?([^'\")]+)", page.text)
        outside = [
            address for address in page.loaded + styles if re.match(r"(https?:)?//", address)
        ]
        assert not outside, path
    assert "//" not in re.sub(r"url\(data:[^)]*\)", "", (SITE / "site.css").read_text("utf-8"))


def test_a_page_can_be_read_by_machines(pages):
    for path, page in pages.items():
        assert [name for name, n in Counter(page.ids).items() if n > 1] == [], path
        assert page.lang.startswith("en"), path
        assert re.search("<title>[^<]+</title>", page.text), path
        steps = [after - before for before, after in pairwise([0, *page.levels])]
        assert max(steps) == 1, f"{path}: headings {page.levels}"
        assert page.levels.count(1) == 1, path
        assert all(page.alts), path
        whole = "(?:(?!</math>).)*"
        unread = f"<th><math>{whole}</math></th>|<math[^>]*>{whole}<a "
        assert not re.search(unread, page.text), path
    figures = pages[SITE / "index.html"].alts
    assert len(figures) >= 10
    assert all(len(alt) > 40 for alt in figures)


def test_a_result_leads_to_the_line_that_names_it():
    text = (SITE / "numbers.html").read_text("utf-8")
    entry = (
        r'<li id="\w+\.([\w.]+)"><strong>[^<]*</strong>:[^\n]*?href="source/([^"#]+).html#L(\d+)"'
    )
    results = re.findall(entry, text)
    assert len(results) > 150
    for name, script, line in results:
        content = (ROOT / script).read_text("utf-8").splitlines()[int(line) - 1]
        named = "{" in content or name.partition(".")[0] in content or "def findings" in content
        assert named, f"{name}: {script}, line {line}: {content}"


def test_an_input_leads_to_the_line_of_its_section_that_sets_it():
    text = (SITE / "numbers.html").read_text("utf-8")
    lines = (ROOT / "config" / "config.yaml").read_text("utf-8").splitlines()
    inputs = re.findall(r'id="config:([\w.]+)"[^\n]*?config\.yaml\.html#L(\d+)"', text)
    assert len(inputs) > 80
    for name, line in inputs:
        above = (row for row in reversed(lines[: int(line)]) if re.match(r"\w", row))
        assert next(above).startswith(f"{name.partition('.')[0]}:"), f"{name}: line {line}"


@pytest.mark.parametrize("name", ["numbers.md", "verdicts.md"])
def test_links_of_a_list_of_docs_lead_to_files_and_anchors(name):
    text = (SITE.parent / name).read_text("utf-8")
    for place, anchor in re.findall(r"\]\(([^)#]+)#?([^)]*)\)", text):
        if place.startswith("../tests/reference/"):  # published with the list
            assert (SITE / "tables" / Path(place).name).is_file(), place
        elif place.startswith("../"):
            assert (ROOT / "docs" / place).is_file(), place
        else:
            assert f'<a id="{anchor}"></a>' in (SITE.parent / place).read_text("utf-8"), anchor


def test_a_case_beside_a_figure_is_that_of_the_figure(pages):
    links = [link for link in pages[SITE / "index.html"].links if link.startswith("explorer.html#")]
    states = [dict(parse_qsl(link.partition("#")[2])) for link in links]
    ends = [outcomes({key: number(text) for key, text in state.items()}, {}) for state in states]
    assert [(column, frame) for column, _, frame in ends] == [
        ("overturns", "survives"),  # the second pulse of Figure 1
        ("survives", "overturns"),  # pulse 1 of Figure 7
    ]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def test_the_font_has_every_character_of_the_equations():
    known = TTFont(ROOT / "paper/site/math.woff").getBestCmap()
    for name in ("index.html", "supplement.html"):
        equations = re.findall(r"<math.*?</math>", (SITE / name).read_text("utf-8"), re.DOTALL)
        text = unescape(re.sub("<[^>]*>", "", "".join(equations)))
        assert {character for character in text if ord(character) not in known} <= {"\n"}, name
