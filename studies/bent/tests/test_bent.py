import json
from pathlib import Path

import numpy as np
import pytest
import yaml
from capacity import numbers, outcomes

CONFIG = yaml.safe_load(Path("config.yaml").read_text())
FACTORS, *OVERTURNED = np.loadtxt("results/outcomes.csv").T  # run Snakemake before the tests


def test_a_deck_without_mass_does_not_help():
    _, bent, column = outcomes(CONFIG | {"beam": CONFIG["beam"] | {"cap_mass": 0}})
    assert (bent == column).all()


def test_the_text_quotes_the_numbers_of_the_table():
    quoted = json.loads(Path("results/numbers.json").read_text())
    assert quoted == numbers(FACTORS, *np.array(OVERTURNED, bool), CONFIG["scale"])


def test_no_overturning_is_a_result():
    none = numbers(FACTORS, FACTORS < 0, FACTORS < 0, CONFIG["scale"])
    assert none == {"survives": True, "bent": None, "column": None, "gain": None}


def test_a_factor_beyond_the_grid_has_no_answer():
    for scale in (0.5 * FACTORS[0], 2 * FACTORS[-1]):
        with pytest.raises(SystemExit, match="; extend start or stop of"):
            numbers(FACTORS, FACTORS < 0, FACTORS < 0, scale)
