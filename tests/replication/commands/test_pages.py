"""The pages that `make pages` writes are those that are committed."""

from pathlib import Path

import pytest

from replication.commands import pages

ROOT = Path(__file__).resolve().parents[3]


def test_committed_pages_are_up_to_date(monkeypatch):
    monkeypatch.chdir(ROOT)
    assert list(pages.outdated()) == []


@pytest.mark.parametrize("text", [None, "old"])
def test_page_that_differs_or_is_missing_is_named_with_the_command(tmp_path, monkeypatch, text):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pages, "pages", lambda: {"page.md": lambda: "new"})
    if text:
        Path("page.md").write_text(text, encoding="utf-8")
    (fault,) = pages.outdated()
    assert fault.startswith("page.md is not up to date; run 'make pages'")
    pages.write()
    assert list(pages.outdated()) == []
