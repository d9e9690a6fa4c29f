"""Ground velocities below which nothing overturns: which findings a changed table breaks."""

import math

import numpy as np
import pytest

from replication.step import call
from steps import guarantee
from tests.cases import COLUMN, CONFIG, as_written, broken
from topheavy import RockingFrame

SETTINGS = CONFIG["guarantee"] | {
    "attack": CONFIG["guarantee"]["attack"]
    | {"slendernesses": [36.0], "limits": [36.0], "mass_ratios": [1.0]},
    "ramps": CONFIG["guarantee"]["ramps"] | {"slendernesses": [36.0], "mass_ratios": [1.0]},
    "mass_ratios": [0.0, 1.0, math.inf],
}
PARAMS = {"settings": SETTINGS, "structures": CONFIG["structures"]}


@pytest.fixture(scope="module")
def computed():
    return as_written(call(guarantee.compute, "guarantee", {}, PARAMS))


@pytest.fixture
def tables(computed):
    """The tables by their names in findings."""
    names = {name: name if name == "guarantee" else f"guarantee_{name}" for name in computed}
    return {names[name]: table.copy() for name, table in computed.items()}


def findings(tables):
    return call(guarantee.findings, "guarantee", {}, PARAMS | tables)


def test_all_hold(tables):
    assert broken(findings(tables)) == set()


@pytest.mark.parametrize(
    ("table", "row", "column", "number"),
    [
        ("guarantee_attack", "visits == 2 and mass_ratio == 1", "found", 1.0),
        ("guarantee_motions", "share > 1", "overturned", False),
        ("guarantee_motions", "share < 1", "peak", 0.99),
    ],
)
def test_changed_number_breaks_its_finding(tables, table, row, column, number):
    (chosen,) = tables[table].query(row).index
    tables[table].loc[chosen, column] = number
    assert broken(findings(tables)) == {"velocity_is_sharp"}


def test_velocities_of_the_column_of_six_metres():
    """V_1, V_2 and V*, cm/s, by hand from their formulas; their ratio is √(R̂/R) for V_1."""
    column, frame = COLUMN.block(), RockingFrame(COLUMN, 1.0).block()
    numbers = [100.0 * guarantee.velocity(column, n) for n in (1, 2, math.inf)]
    assert numbers == pytest.approx([52.74, 26.92, 2.138], abs=0.005)
    ratio = guarantee.velocity(frame, 1) / guarantee.velocity(column, 1)
    assert ratio == pytest.approx(math.sqrt(4.0 / 3.0))


def test_break_even_makes_both_velocities_equal():
    column, frame = COLUMN.block(), RockingFrame(COLUMN, 1.0).block()
    assert guarantee.break_even(column, frame, math.inf) == pytest.approx(0.0187, abs=1e-4)
    assert np.isnan(guarantee.break_even(column, frame, 1))


def test_body_that_would_return_later_is_not_lost():
    """It lands with the rate of its start, however long it stays beside α."""
    block = COLUMN.block()
    least = 2.0 * block.frequency_parameter * math.sin(block.slenderness / 2.0)
    assert guarantee.landing(block, (1.0 - 1e-9) * least) == pytest.approx(least, rel=1e-6)
    assert math.isnan(guarantee.landing(block, (1.0 + 1e-9) * least))
