"""The keys of a config: meaning, unit and value of each; what our schemas leave out."""

from pathlib import Path

import pytest

from replication.inputs.config_keys import keys
from replication.inputs.configuration import read_schema

ROOT = Path(__file__).resolve().parents[3]

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
