"""Configs: strict YAML, their schemas and keys, and the parts of a replication."""

import pickle
import re
from pathlib import Path

import pytest

from replication.inputs.config_keys import keys
from replication.inputs.configuration import Sections, read_schema
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


CONFIGS = [
    path.relative_to(ROOT)
    for path in (ROOT / "config/config.yaml", *sorted(ROOT.glob("studies/*/config.yaml")))
]
OPTIONAL = {"because", "only", "factor"}  # for which the code has a default
SCHEMA = """
description: Of all.
properties:
  columns:
    patternProperties:
      "^[a-z]+$": { properties: { height: { $ref: "#/$defs/length", description: its height } } }
  shaking:
    properties:
      periods: { $ref: "#/$defs/grid", unit: s, description: of the pulse }
      slopes:
        allOf: [{ $ref: "#/$defs/grid" }]
        unit: degrees
        properties: { highest: { exclusiveMaximum: 45 } }
      motions:
        type: array
        items: { properties: { file: { type: string }, factor: { type: number, unit: "1" } } }
$defs:
  length: { unit: m, type: number, exclusiveMinimum: 0, maximum: 1000 }
  count: { description: number of values, type: integer, minimum: 2 }
  grid:
    properties:
      lowest: { type: number, exclusiveMinimum: 0 }
      highest: { type: number }
      points: { $ref: "#/$defs/count" }
"""


CONFIG = """\
columns:
  low: { height: 1.0 }
  high: { height: 8.0 }

shaking:
  periods: { lowest: 0.1, highest: 2.0, points: 5 }
  slopes: { lowest: 1.0, highest: 20.0, points: 3 }
  motions:
    - { file: "a # b", factor: 2.0 }
    - { file: c, factor: 3.0 }
"""


@pytest.fixture
def config(tmp_path):
    (tmp_path / "config.schema.yaml").write_text(SCHEMA, encoding="utf-8")
    (tmp_path / "config.yaml").write_text(CONFIG, encoding="utf-8")
    return tmp_path / "config.yaml"


KEYS = [
    ("columns.low.height", "its height", "m", "1.0"),
    ("columns.high.height", "its height", "m", "8.0"),
    ("shaking.periods.lowest", "of the pulse", "s", "0.1"),
    ("shaking.periods.highest", "of the pulse", "s", "2.0"),
    ("shaking.periods.points", "number of values", "", "5"),
    ("shaking.slopes.lowest", "", "degrees", "1.0"),
    ("shaking.slopes.highest", "", "degrees", "20.0"),
    ("shaking.slopes.points", "number of values", "", "3"),
    ("shaking.motions[].file", "", "", "'a # b'; c"),
    ("shaking.motions[].factor", "", "1", "2.0; 3.0"),
]


def test_key_has_the_nearest_meaning_and_unit_and_its_value(config):
    assert [(key.place, key.meaning, key.unit, key.value) for key in keys(config)] == KEYS


@pytest.mark.parametrize("path", CONFIGS, ids=str)
def test_our_schemas_require_every_key_that_the_code_reads(path):
    def closed(node):
        inner = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
        if isinstance(node, dict) and node.get("additionalProperties") is False:
            yield node
        for each in inner:
            yield from closed(each)

    schema = read_schema(ROOT / path.with_name("config.schema.yaml"))
    for node in (one for one in closed(schema) if "properties" in one):
        assert {*node["properties"]} - OPTIONAL == {*node.get("required", [])} - OPTIONAL


@pytest.mark.parametrize("path", CONFIGS, ids=str)
def test_our_schemas_say_what_each_key_means_and_the_unit_of_each_number(path):
    found = keys(ROOT / path)
    lacking = [key.place for key in found if not key.meaning]
    lacking += [
        key.place
        for key in found
        if any(isinstance(each, float) for each in key.values) and not key.unit
    ]
    assert lacking == [], f"expected description and unit in {path.with_name('config.schema.yaml')}"


def test_section_that_a_rule_takes_and_the_config_lacks_is_named_with_its_file():
    config = Sections({"period": {}, "mass": {}})
    said = "config/config.yaml has no section 'periods', .*; did you mean 'period'"
    with pytest.raises(ValueError, match=said):
        config["periods"]
    assert type(pickle.loads(pickle.dumps(config))) is dict  # a job loads no module for it
