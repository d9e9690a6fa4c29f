"""YAML is read strictly: each mistake is reported with its file and line."""

import re
from pathlib import Path

import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.inputs.study_config import read_study_config
from replication.judging.ledger import read_ledger
from replication.pages.captions import read_captions

ROOT = Path(__file__).parents[3]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "config.yaml"


def doubled(levels):
    """Return a list of two, the next of two of these, and so on."""
    lines = ["l0: &l0 [x, x]"]
    lines += [f"l{k}: &l{k} [*l{k - 1}, *l{k - 1}]" for k in range(1, levels)]
    return "\n".join(lines) + "\n"


WITHIN = r"the alias \*x is within the value that it names"
TOO_MANY = "the file has more than 100000 values and keys up to here"
TOO_DEEP = "more than 100 lists and mappings are within each other"


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
        (b"a: 1\nb: \xe9\n", "line 2: the byte 0xe9 is not UTF-8; expected"),
        # what has no end, or takes too long
        ("a: 1\nb: &x [1,\n  *x]\n", f"line 3: {WITHIN}"),
        ("a: &x\n  b: *x\n", f"line 2: {WITHIN}"),
        ("a: &x\n  <<: *x\n", f"line 2: {WITHIN}"),
        ("a: &x [&y [*x]]\n", f"line 1: {WITHIN}"),
        (doubled(200), f"line 15: {TOO_MANY}"),
        ("- &x y\n" + "- *x\n" * 100_001, rf"line 100\d\d\d: {TOO_MANY}"),
        ("- 1\n" * 100_001, f"line 100000: {TOO_MANY}"),
        ("a:\n  " + "[" * 300_000, f"line 2: {TOO_DEEP}"),
        ("[" * 101 + "]" * 101, f"line 1: {TOO_DEEP}"),
    ],
    ids=range(20),
)
def test_fault_is_told_with_file_and_line(path, text, message):
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(ValueError, match=rf"^{re.escape(str(path))},? {message}") as told:
        read_yaml(path)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("text", ["a: &x {b: 1}\nc: {<<: *x, d: 2}\n", "\ufeffa: {b: 1}\r\n"])
def test_merged_keys_a_mark_at_the_head_and_other_line_ends_are_read(path, text):
    path.write_bytes(text.encode())
    assert read_yaml(path)["a"] == {"b": 1}


def test_every_file_of_the_workflow_is_read_strictly(tmp_path, plant):
    path = tmp_path / "studies/mine/config.yaml"
    plant(tmp_path, {"studies/mine/config.yaml": "a: 1\na: 2\n"})
    for read in (
        lambda: read_ledger([path]),
        lambda: read_captions([path]),
        lambda: read_study_config("mine", lambda *given: None, str(tmp_path / "studies")),
    ):
        with pytest.raises(ValueError, match="line 2: the key 'a' is given twice"):
            read()


def test_nothing_else_in_the_workflow_loads_yaml():
    modules = ROOT.glob("src/**/*.py")
    code = [
        *(path for path in modules if "tests" not in path.relative_to(ROOT).parts),
        *ROOT.glob("src/**/*.smk"),
        *ROOT.glob("studies/*/steps/*.py"),
    ]
    code += [ROOT / "Snakefile"]
    lax = re.compile(r"yaml\.\w*load|load_configfile")
    found = {path.name for path in code if lax.search(path.read_text(encoding="utf-8"))}
    assert found == {"strict_yaml.py"}
