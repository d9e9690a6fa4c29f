"""The words to avoid: found in prose, and only there."""

import pytest
import yaml

from steps import words

PHRASES = {"is had|are had": "gives", "seat|seats": "column-top contact"}


@pytest.fixture
def tree(tmp_path, plant):
    """Make a root with one file to check, and the list of words for it."""

    def make(text, **entries):
        words = {"phrases": PHRASES, "files": ["a.md"], "except": []} | entries
        return plant(tmp_path, {"a.md": text, "paper/words.yaml": yaml.safe_dump(words)})

    return make


def test_phrase_is_named_with_file_line_and_advice(tree, capsys):
    root = tree("One line.\nHalf of the gain is had at once.\n")
    assert words.main(root) == 1
    assert "a.md:2: 'is had'; better: gives\n" in capsys.readouterr().out
    (root / "a.md").write_text("The cap beam gives half of the gain.\n", encoding="utf-8")
    assert words.main(root) == 0
    assert not capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("The gain is\nhad at once.", 1),
        ("\n# The gain is\n# had at once.\n", 2),
        ("Seats open.", 1),
        ("a seat.", 1),
    ],
)
def test_phrase_is_found_across_lines_and_with_a_capital(text, line):
    ((found, *_),) = words.findings(text, PHRASES)
    assert found == line


def test_code_is_not_prose():
    code = (
        'seat = table["seat"]  # a seat\nword = f"the seat {seat} opens"\n"""Two\n\n  seats."""\n'
    )
    found = [(line, phrase) for line, phrase, _ in words.findings(words.prose(code), PHRASES)]
    assert found == [(1, "seat"), (2, "seat"), (5, "seats")]


def test_excluded_file_is_not_checked(tree):
    assert words.main(tree("It is had.", **{"except": ["a.md"]})) == 0


@pytest.mark.parametrize("key", ["files", "except"])
def test_entry_that_matches_no_file_is_refused(tree, key):
    root = tree("", **{key: ["b.md"]})
    with pytest.raises(ValueError, match=rf"words\.yaml: {key} has 'b\.md', which matches no file"):
        words.main(root)
