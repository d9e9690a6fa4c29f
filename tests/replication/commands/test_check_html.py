"""The look at the HTML report in a browser finds what is wrong with a page."""

import asyncio
import base64
import json
from pathlib import Path

import pytest

from replication.commands.check_html import BROWSERS, find_browser, inspect

BROWSER = find_browser()
needs_browser = pytest.mark.skipif(
    BROWSER is None, reason=f"none of {', '.join(BROWSERS)} is on the PATH"
)

FIGURE = '<svg xmlns="http://www.w3.org/2000/svg" width="90" height="60"><path d="M0 0h9v9"/></svg>'
CAPTIONS = {
    "a.svg": {"title": "A", "category": "One", "caption": "What is seen.", "claims": []},
}

# What the report of Snakemake has that is looked at.
PAGE = """<!doctype html><meta charset="utf-8"><script>
var metadata = {Claims: 1}, workflow_desc = "<h1>Verdicts</h1>";
var results = {"a.svg": {data_uri: URI, caption: "<p>What is seen.</p>"}};
</script>"""


def faults_of(page, figure=FIGURE, captions=CAPTIONS):
    """What the look finds in the page, with the figure in it that the workflow wrote."""
    uri = "data:image/svg+xml;charset=utf8;base64," + base64.b64encode(figure.encode()).decode()
    Path("a.svg").write_text(figure, encoding="utf-8")
    Path("page.html").write_text(page.replace("URI", json.dumps(uri)), encoding="utf-8")
    return asyncio.run(inspect(BROWSER, Path("page.html"), captions))


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@needs_browser
def test_requests_errors_and_a_bad_caption_are_found():
    found = faults_of(
        PAGE.replace(
            "<script>",
            "<img src='https://example.org/a.png'><script>"
            "fetch('http://example.org/b').catch(() => 0);"
            "console.error('broken'); setTimeout(() => unknown(), 0);",
        ).replace("<p>What is", "<p class='system-message'>Other is")
    )
    for fault in (
        "asks the network for https://example.org/a.png",
        "asks the network for http://example.org/b",
        "error in the console: broken",
        "error in the console: ReferenceError: unknown is not defined",
        "the caption of a.svg is not in the report",
        "the caption of a.svg is no sound reStructuredText",
    ):
        assert any(told.startswith(fault) for told in found), (fault, found)


OPENING = "the report does not open on a sound text (opening.rst)"


@needs_browser
@pytest.mark.parametrize(
    ("old", "new", "figure", "captions", "found"),
    [
        ("", "", FIGURE, CAPTIONS, []),
        ("Claims: 1", "", FIGURE, CAPTIONS, [OPENING]),
        ("Verdicts", "system-message", FIGURE, CAPTIONS, [OPENING]),
        ("", "", "<svg", CAPTIONS, ["a.svg cannot be drawn"]),
        ("", "", FIGURE, CAPTIONS | {"b.svg": {}}, ["b.svg is not in the report"]),
        ("", "", FIGURE, {}, ["a.svg has no caption"]),
    ],
)
def test_page_is_held_against_the_captions_and_what_the_workflow_wrote(
    old, new, figure, captions, found
):
    assert faults_of(PAGE.replace(old, new), figure, captions) == found


def test_no_browser_on_the_path_is_none():
    assert find_browser(["no-such-browser"]) is None
