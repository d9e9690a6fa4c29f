import json
from pathlib import Path

import numpy as np
import yaml
from capacity import capacities, fragilities, numbers

import topheavy

CONFIG = yaml.safe_load(Path("config.yaml").read_text())


def found(config):
    return numbers(capacities(config), fragilities(config), config["scale"])


def test_a_deck_without_mass_does_not_help():
    light = found(CONFIG | {"beam": CONFIG["beam"] | {"cap_mass": 0}})
    assert {value for rows in light.values() for row in rows for value in row["gain"]} == {1}


def test_the_text_quotes_the_numbers_of_the_config():
    assert json.loads(Path("results/numbers.json").read_text()) == found(CONFIG)  # Snakemake first


def test_no_overturning_is_a_result_but_not_beyond_the_last_factor():
    none = topheavy.Capacity(np.geomspace(1, 2, 500), np.zeros(500, bool))
    for scale, survives in ((1.5, True), (2.5, None)):
        (row,) = numbers({("", 1): {"column": none, "frame": none}}, {}, scale)["capacities"]
        assert (row["survives"], row["frame"], row["gain"]) == (survives, None, None)
