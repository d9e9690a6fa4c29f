"""The keys of a config and their page: meaning, unit, bounds, value and source of each."""

from pathlib import Path

import pytest
import yaml

from replication.inputs.config_keys import comments, keys
from replication.inputs.schema_words import allowed
from replication.pages.config_page import config_page

ROOT = Path(__file__).resolve().parents[4]

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
# The head of the file.

# Of two | sizes.
columns:
  low: { height: 1.0 } # p. 4
  high: { height: 8.0 }

shaking:
  periods: { lowest: 0.1, highest: 2.0, points: 5 } # ours
  # above
  slopes: { lowest: 1.0, highest: 20.0, points: 3 }
  motions: # of 1940
    - { file: "a # b", factor: 2.0 } # as recorded
    - { file: c, factor: 3.0 }
"""


@pytest.fixture
def config(tmp_path):
    (tmp_path / "config.schema.yaml").write_text(SCHEMA, encoding="utf-8")
    (tmp_path / "config.yaml").write_text(CONFIG, encoding="utf-8")
    return tmp_path / "config.yaml"


LENGTH = ("its height", "m", "a number > 0, ≤ 1000")
KEYS = [
    ("columns.low.height", *LENGTH, "1.0", "p. 4"),
    ("columns.high.height", *LENGTH, "8.0", ""),
    ("shaking.periods.lowest", "of the pulse", "s", "a number > 0", "0.1", "ours"),
    ("shaking.periods.highest", "of the pulse", "s", "a number", "2.0", "ours"),
    ("shaking.periods.points", "number of values", "", "a whole number ≥ 2", "5", "ours"),
    ("shaking.slopes.lowest", "", "degrees", "a number > 0", "1.0", "above"),
    ("shaking.slopes.highest", "", "degrees", "a number < 45", "20.0", "above"),
    ("shaking.slopes.points", "number of values", "", "a whole number ≥ 2", "3", "above"),
    ("shaking.motions[].file", "", "", "a text", "'a # b'; c", "as recorded"),
    ("shaking.motions[].factor", "", "1", "a number", "2.0; 3.0", "as recorded"),
]


def test_key_has_the_nearest_meaning_unit_and_bounds_its_value_and_its_source(config):
    found = [(k.place, k.meaning, k.unit, k.allowed, k.value, k.source) for k in keys(config)]
    assert found == KEYS


def test_comment_is_no_part_of_a_text_and_the_head_is_of_no_key():
    assert comments(CONFIG)["columns"] == "Of two | sizes."
    assert comments(CONFIG)["shaking.motions[]"] == "as recorded"
    assert "head" not in " ".join(comments(CONFIG).values())


def test_page_gives_the_comment_of_a_section_once_and_a_row_a_key(config):
    page = config_page(config)
    assert page.count("Of two | sizes.") == 1
    assert "\n\nThe head of the file.\n\n## columns" in page
    row = "| `columns.low.height` | its height | m | a number > 0, ≤ 1000 | `1.0` | p. 4 |"
    assert row in page.splitlines()
    assert sum(line.startswith("| `") for line in page.splitlines()) == len(KEYS)


@pytest.mark.parametrize(
    ("schema", "said"),
    [
        ("{ enum: [a, b] }", "one of a, b"),
        (
            "{ type: array, minItems: 2, maxItems: 2, items: { type: number } }",
            "2 values, each a number",
        ),
        ("{ oneOf: [{ type: integer }, { title: a mapping }] }", "a whole number or a mapping"),
        ("{ type: array, minItems: 1, items: { enum: [a] } }", "1 or more values, each one of a"),
        ("{ type: array, maxItems: 3, items: { type: string } }", "0 to 3 values, each a text"),
    ],
)
def test_bounds_are_told_in_words(schema, said):
    assert allowed(yaml.safe_load(schema), {}) == said


@pytest.mark.parametrize("path", CONFIGS, ids=str)
def test_our_schemas_require_every_key_that_the_code_reads(path):
    def closed(node):
        inner = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
        if isinstance(node, dict) and node.get("additionalProperties") is False:
            yield node
        for each in inner:
            yield from closed(each)

    schema = yaml.safe_load((ROOT / path.with_name("config.schema.yaml")).read_text("utf-8"))
    for node in (one for one in closed(schema) if "properties" in one):
        assert {*node["properties"]} - OPTIONAL == {*node.get("required", [])} - OPTIONAL


@pytest.mark.parametrize("path", CONFIGS, ids=str)
def test_our_schemas_say_what_each_key_means_and_the_unit_of_each_number(path):
    found = keys(ROOT / path)
    lacking = [key.place for key in found if not key.meaning]
    lacking += [key.place for key in found if "a number" in key.allowed and not key.unit]
    assert lacking == [], f"expected description and unit in {path.with_name('config.schema.yaml')}"
