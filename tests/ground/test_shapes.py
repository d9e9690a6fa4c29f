"""One list has the pulse shapes; each user of it has every one of them."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

import topheavy.ground.shapes
from replication.inputs.configuration import read_schema
from replication.inputs.strict_yaml import read_yaml
from steps.explorer import titles
from tests.cases import ROOT
from topheavy import PULSE_SHAPES, Pulse
from topheavy.ground.shapes import ELEMENTARY, ENDING, SHAPES
from topheavy.kernel import forcing

SCHEMAS = [*ROOT.glob("config/*.schema.yaml"), *ROOT.glob("studies/*/*.schema.yaml")]


@pytest.mark.parametrize("name", PULSE_SHAPES)
def test_pulse_and_kernel_have_the_same_wave_of_the_same_length(name):
    pulse = Pulse(name, 1.0, 1.0)
    shape = forcing.SHAPES[name]
    assert pulse.duration == pytest.approx(forcing.LAST_PHASE[shape])
    for phase in np.linspace(0.0, min(pulse.duration, 20.0), 97)[:-1]:
        value, _ = forcing.unit_pulse(shape, phase)
        assert pulse.excitation(phase) == pytest.approx(value, abs=1e-12)


def test_lists_are_parts_of_the_one_list():
    assert set(ENDING) == {name for name in SHAPES if Pulse(name, 1.0, 1.0).duration < math.inf}
    assert set(ELEMENTARY) == {name for name in SHAPES if not name.startswith("ricker")}
    assert tuple(forcing.SHAPES) == PULSE_SHAPES


def test_no_schema_lists_the_shapes_itself():
    assert len(SCHEMAS) > 4
    for path in SCHEMAS:
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"enum:.*(?:sine|ricker)", text), path
    (config,) = (path for path in SCHEMAS if path.parent.name == "config")
    assert read_schema(config)["$defs"]["shape"]["enum"] == list(ENDING)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("topheavy.ground.shapes.ENDINGS", "no attribute 'ENDINGS'; expected a list"),
        ("topheavy.nothing.ENDING", "expected a list"),
        ("topheavy.ground.shapes.math.pi", r"is 3\.14\d+; expected a list"),
    ],
)
def test_schema_that_names_no_list_is_refused(tmp_path, name, told):
    path = tmp_path / "some.schema.yaml"
    path.write_text(f"properties: {{ values: {{ values: {name} }} }}\n", encoding="utf-8")
    assert read_yaml(path)
    with pytest.raises(ValueError, match=rf"some\.schema\.yaml: values is '{name}'.*{told}"):
        read_schema(path)


def test_page_has_every_shape_and_no_other():
    motions = (ROOT / "src/explorer" / "motions.js").read_text(encoding="utf-8")
    assert set(titles(motions)) == set(SHAPES)
    for wrong in (
        motions.replace('"half-sine": {', '"halfsine": {'),
        motions.replace('"con', "//"),
    ):
        assert wrong != motions
        with pytest.raises(ValueError, match=r"differ by .*expected a wave for every shape"):
            titles(wrong)


def test_list_of_shapes_needs_no_numerics():
    source = Path(topheavy.ground.shapes.__file__).read_text(encoding="utf-8")
    assert re.findall(r"^(?:from|import) (\w+)", source, re.MULTILINE) == ["math", "typing"]
