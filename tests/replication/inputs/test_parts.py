"""The parts of a work, and the texts that they write."""

import pickle

import pytest

from replication.inputs.configuration import Sections
from replication.inputs.parts import PAPER, Part


@pytest.fixture
def study(tmp_path, plant, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return plant(tmp_path / "studies" / "one", {"section.typ": ""})


def test_study_writes_a_section_and_its_parts_of_the_article_if_it_has_any(study):
    assert Part("one", {}).sections == ["studies/one/section.typ"]
    (study / "article.typ").touch()
    assert Part("one", {}).sections == ["studies/one/section.typ", "studies/one/article.typ"]
    (study.parent / "section.typ").touch()
    assert Part(PAPER, {}).sections == []


def test_figure_is_drawn_from_the_tables_that_its_function_takes(study, plant):
    draw = "def beside(x):\n    pass\n\n\ndef draw(one_lengths, one_widths):\n    pass\n"
    plant(study, {"figures/line.py": draw, "figures/colours.py": "INK = 'black'\n"})
    assert Part("one", {}).figures == {"studies/one/figures/line": ["one_lengths", "one_widths"]}


def test_section_that_a_rule_takes_and_the_config_lacks_is_named_with_its_file():
    config = Sections({"period": {}, "mass": {}})
    said = "config/config.yaml has no section 'periods', .*; did you mean 'period'"
    with pytest.raises(ValueError, match=said):
        config["periods"]
    assert type(pickle.loads(pickle.dumps(config))) is dict  # a job loads no module for it
