"""The table for designers: numbers by hand, and what moves farther than a larger block."""

import math

import pandas as pd
import pytest

from steps.beyond import designers
from tests.cases import COLUMN

SETTINGS = {"structure": "one", "mass_ratios": [0.0, 1.0, math.inf], "velocities": [0.4]}
FRICTION = {"bays": [5.0], "depth": 1.0}
STRUCTURES = {"one": {"half_width": 0.5, "half_height": 3.0}}
GAINS = pd.DataFrame({"mass_ratio": [1.0, 1.0, math.inf], "gain": [0.1, 0.3, 0.2]})
ROTATIONS = pd.DataFrame(
    {
        "mass_ratio": [0.0, 1.0, 1.0, math.inf, 0.0, 1.0, math.inf],
        "velocity": 0.4,
        "median_peak": [math.inf, 0.5, 0.0, 0.5, 0.8, 0.4, 0.5],
        "median_peak_low": [0.7, 0.5, 0.6, 0.2, 0.7, 0.5, 0.2],
        "median_peak_high": [math.inf, 1.0, 0.8, 0.3, math.inf, 1.0, 0.3],
        "model": ["a", "a", "b", "a", "c", "c", "c"],
    }
)
SHEARS = pd.DataFrame({"mass_ratio": [0.0, 1.0, 1.0, 1.0], "base_shear": [0.4, 0.2, 0.3, math.nan]})
REQUIRED = pd.DataFrame({"bay": [0.0, 5.0], "mass_ratio": [0.0, 1.0], "required": [0.6, 0.5]})


def test_numbers_are_those_by_hand():
    rows = designers.compute(SETTINGS, FRICTION, STRUCTURES, GAINS, ROTATIONS, SHEARS, REQUIRED)
    column, equal, heaviest = rows
    assert (equal["size_ratio"], heaviest["size_ratio"]) == pytest.approx((4 / 3, 1.5))
    assert equal["velocity_scale"] == pytest.approx(0.1547, abs=1e-4)
    assert (equal["gain_least"], equal["gain_most"]) == (0.1, 0.3)
    assert column["high_0.4"] == math.inf
    half = designers.travel(COLUMN, 0.5 * COLUMN.slenderness)
    assert (equal["low_0.4"], equal["high_0.4"]) == pytest.approx((half, 1.0))
    assert equal["base_shear_largest"] == 0.3
    # of "c" alone: the column overturns in "a" and is not in "b"
    assert equal["moved_least"] == equal["moved_most"] == pytest.approx(0.5, abs=0.01)
    assert heaviest["moved_most"] == pytest.approx(0.625, abs=0.01)
    assert equal["depth_over_width"] == pytest.approx((3.0 + 6.5) / 2 / 3.0)
    slope = 0.75 * math.cos(COLUMN.slenderness) ** 2
    assert column["base_shear_slope"] == pytest.approx(1.0 - slope)
    assert [row["friction_5"] for row in rows] == pytest.approx([0.6, 0.5, 1 / 6])


@pytest.mark.parametrize(("most", "holds"), [(0.75, True), (0.76, False)])
def test_a_larger_motion_than_of_the_larger_block_decides(most, holds):
    row = {"moved_least": 0.6, "moved_most": most, "size_ratio": 4 / 3}
    table = pd.DataFrame([row | {"mass_ratio": 0.0}, row | {"mass_ratio": 1.0}])
    finding = designers.findings(table)["larger_block_moves_no_farther"]
    assert finding["holds"] == holds
