"""YAML is read strictly: each mistake is reported with its file and line."""

import re
from pathlib import Path

import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.inputs.study_config import read_study_config
from replication.judging.ledger import read_ledger
from replication.pages.captions import read_captions

ROOT = Path(__file__).parents[4]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb: {c: 1}\na: 2\n", "line 3: the key 'a' is given twice, first in line 1; exp"),
        ("a:\n  temple: 1\n  temple: 1\n", "line 3: the key 'temple' is given twice, first in l"),
        ("- {id: x,\n   id: y}\n", "line 2: the key 'id' is given twice, first in line 1"),
        ("a: 1\n\tb: 2\n", r"line 2: found character '\\t' that cannot start any token"),
        ("a: 1\nb: [1, 2\nc: 3\n", "line 3: expected ',' or ']'.*which begins in line 2"),
        ("a: 1\n  b: 2\n", "line 2: mapping values are not allowed here"),
        ("a: *there\n", "line 1: found undefined alias"),
        ("a: 1\nb: \x07\n", r"line 2: the character '\\x07' is not allowed in YAML"),
        ("", "is empty; expected YAML"),
        ("# nothing\n", "is empty; expected YAML"),
    ],
)
def test_fault_is_told_with_file_and_line(tmp_path, text, message):
    path = tmp_path / "config.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=message) as told:
        read_yaml(path)
    assert str(told.value).startswith(str(path))
    assert "\n" not in str(told.value)


def test_byte_that_is_not_utf_8_is_told_with_its_line(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_bytes("a: 1\nb: é\n".encode("latin-1"))
    with pytest.raises(ValueError, match="line 2: the byte 0xe9 is not UTF-8; expected"):
        read_yaml(path)


@pytest.mark.parametrize("text", ["a: &x {b: 1}\nc: {<<: *x, d: 2}\n", "\ufeffa: {b: 1}\r\n"])
def test_merged_keys_a_mark_at_the_head_and_other_line_ends_are_read(tmp_path, text):
    path = tmp_path / "config.yaml"
    path.write_bytes(text.encode())
    assert read_yaml(path)["a"] == {"b": 1}


def test_every_file_of_the_workflow_is_read_strictly(tmp_path):
    twice, missing = "a: 1\na: 2\n", tmp_path / "claims.yaml"
    missing.write_text(twice, encoding="utf-8")
    folder = tmp_path / "studies" / "mine"
    folder.mkdir(parents=True)
    (folder / "config.yaml").write_text(twice, encoding="utf-8")
    for read in (
        lambda: read_ledger([missing]),
        lambda: read_captions([missing]),
        lambda: read_study_config("mine", lambda *given: None, str(tmp_path / "studies")),
    ):
        with pytest.raises(ValueError, match="line 2: the key 'a' is given twice"):
            read()


def test_nothing_else_in_the_workflow_loads_yaml():
    code = [
        *(path for path in ROOT.glob("src/**/*.py") if "tests" not in path.parts),
        *ROOT.glob("src/**/*.smk"),
        *ROOT.glob("studies/*/steps/*.py"),
    ]
    code += [ROOT / "Snakefile"]
    lax = re.compile(r"yaml\.\w*load|load_configfile")
    found = {path.name for path in code if lax.search(path.read_text(encoding="utf-8"))}
    assert found == {"strict_yaml.py"}


def doubled(levels):
    """Return a list of two, the next of two of these, and so on."""
    lines = ["l0: &l0 [x, x]"]
    lines += [f"l{k}: &l{k} [*l{k - 1}, *l{k - 1}]" for k in range(1, levels)]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "a: 1\nb: &x [1,\n  *x]\n",
            r"line 3: the alias \*x is within the value that it names",
        ),
        ("a: &x\n  b: *x\n", r"line 2: the alias \*x is within the value that it names"),
        ("a: &x\n  <<: *x\n", r"line 2: the alias \*x is within the value that it names"),
        ("a: &x [&y [*x]]\n", r"line 1: the alias \*x is within the value that it names"),
        (
            doubled(200),
            r"line 15: the file has more than 100000 values and keys up to here",
        ),
        ("- &x y\n" + "- *x\n" * 100_001, r"line 100\d\d\d: the file has more than 100000 values"),
        ("- 1\n" * 100_001, r"line 100000: the file has more than 100000 values"),
        ("a:\n  " + "[" * 300_000, r"line 2: more than 100 lists and mappings are within each"),
        ("[" * 101 + "]" * 101, r"line 1: more than 100 lists and mappings are within each other"),
    ],
    ids=range(9),
)
def test_what_has_no_end_or_takes_too_long_is_told_with_its_line(tmp_path, text, message):
    path = tmp_path / "config.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}, {message}") as told:
        read_yaml(path)
    assert "\n" not in str(told.value)


def test_aliases_and_levels_within_reason_are_read(tmp_path):
    path = tmp_path / "config.yaml"
    path.write_text(doubled(10) + "deep: " + "[" * 99 + "]" * 99, encoding="utf-8")
    read = read_yaml(path)
    assert read["l1"] == [["x", "x"], ["x", "x"]]
    assert len(read) == 11
