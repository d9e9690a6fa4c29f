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


@pytest.mark.parametrize(("name", "place"), [("bent", 0), ("column", 1)])
def test_the_text_quotes_the_capacity_of_the_table(name, place):
    ends = [abs(FACTORS - 1.05 * f).argmin() + 1 for f in FACTORS if 1.05 * f < FACTORS[-1]]
    shares = [OVERTURNED[place][k:end].mean() for k, end in enumerate(ends)]
    capacity = [FACTORS[k] for k, share in enumerate(shares) if share >= 0.9][:1]
    quoted = json.loads(Path("results/numbers.json").read_text())[name]
    assert capacity == pytest.approx(quoted[:1] if quoted else [])


def test_no_overturning_is_a_result():
    none = numbers(FACTORS, FACTORS < 0, FACTORS < 0, CONFIG["scale"])
    assert none == {"survives": True, "bent": None, "column": None, "gain": None}
