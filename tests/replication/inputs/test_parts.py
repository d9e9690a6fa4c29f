"""The parts of a work, and the texts that they write."""

import pytest

from replication.inputs.parts import PAPER, Part


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "studies" / "one"
    folder.mkdir(parents=True)
    (folder / "section.typ").touch()
    return folder


def test_study_writes_a_section_and_its_parts_of_the_article_if_it_has_any(study):
    assert Part("one", {}).sections == ["studies/one/section.typ"]
    (study / "article.typ").touch()
    assert Part("one", {}).sections == ["studies/one/section.typ", "studies/one/article.typ"]


def test_paper_has_no_section(study):
    (study.parent / "section.typ").touch()
    assert Part(PAPER, {}).sections == []
