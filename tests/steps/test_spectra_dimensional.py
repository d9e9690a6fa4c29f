"""Structures of one's own: named in the config, with caps by γ or by masses."""

import copy
from pathlib import Path

from replication.inputs.strict_yaml import read_yaml
from steps.inputs import check_inputs
from steps.spectra_dimensional import lines

ROOT = Path(__file__).resolve().parents[2]
CONFIG = read_yaml(ROOT / "config" / "config.yaml")


def with_pier(caps):
    config = copy.deepcopy(CONFIG)
    config["structures"]["my_pier"] = {"half_width": 1.0, "half_height": 8.0}
    config["spectra_dimensional"]["frames"]["my_pier"] = caps
    return config


def check(config):
    schema = ROOT / "config" / "config.schema.yaml"
    check_inputs(config, "config.yaml", str(schema), str(ROOT / "data" / "records"))


def test_structure_of_ones_own_has_lines_for_each_cap():
    config = with_pier([0.0, {"cap_mass": 3000.0, "column_mass": 1000.0}])
    check(config)
    found = lines(config["spectra_dimensional"], config["structures"])
    own = [line.labels for line in found if line.labels["structure"] == "my_pier"]
    assert {labels["mass_ratio"] for labels in own} == {0.0, 1.5}
    assert {labels["height"] for labels in own} == {16.0}
