"""Each result that a claim of the study depends on, in a small case in which it is false."""

import math

import numpy as np
import pandas as pd
import pytest

from studies.mechanism.steps import admissible
from studies.mechanism.steps.admissible import lightest_without_sliding
from studies.mechanism.steps.beside import _bands_apart
from studies.mechanism.steps.demand import Demand
from studies.mechanism.steps.equivalence import differences, mean_share
from topheavy import Cap


def asked(**change):
    given = {"friction": 0.2, "friction_error": 0.0, "least": 0.1, "least_error": 0.0}
    impact = {"impact_friction": 0.1, "impact_least": 0.1, "impacts": 1, "outcome": "rests"}
    return Demand(**given | impact | change)


def test_impact_counts_among_what_is_asked_for():
    assert asked().whole == 0.2
    assert asked(impact_friction=0.3).whole == 0.3
    assert not asked().pulls
    assert asked(impact_least=-0.1).pulls
    assert asked(least=-0.1).pulls


def test_friction_that_the_heaviest_cap_exceeds_is_never_enough():
    rows = [(0.0, 9.0), (0.1, 1.0), (0.2, 5.0), (1.0, 2.0), (4.0, 1.2)]
    table = pd.DataFrame(rows, columns=["mass_ratio", "largest_demand"])
    assert lightest_without_sliding(table, 3.0) == 1.0
    assert lightest_without_sliding(table, 6.0) == 0.1
    assert lightest_without_sliding(table, 1.1) == math.inf


@pytest.mark.parametrize(("largest", "holds_when"), [(0.9, True), (0.17, False)])
def test_frame_slides_on_what_its_heaviest_cap_exceeds(largest, holds_when):
    case = {
        "column": {"half_width": 0.5, "half_height": 3.0},
        "mass_ratios": [0.0, 1.0],
        "frictions": [0.1, largest],
        "shape": "one-sine",
        "frequency_ratios": {"lowest": 3.0, "highest": 4.0, "points": 2},
        "amplitudes": {"lowest": 1.05, "highest": 2.0, "points": 2},
        "samples": 4,
    }
    found = admissible.main(case, Cap(5.0, 0.5))[-1]["friction_is_enough"]
    assert not found["holds"]
    assert found["holds_when"] is holds_when
    assert (found["from_mass_ratio"] == 1.0) is holds_when


def peaks(*overturned):
    values = np.full((3, 5), 0.5)
    for place in overturned:
        values[place] = np.nan
    return pd.DataFrame(values)


def test_both_sides_count_among_pulses_with_another_outcome():
    found = differences(peaks((0, 1), (1, 1), (1, 3)), peaks((0, 2), (1, 1), (1, 2)))
    assert found["only_frame_overturns"] == pytest.approx(1.5 / 8)  # one of two cells on an edge
    assert found["only_column_overturns"] == pytest.approx(1.5 / 8)
    assert found["share_apart"] == pytest.approx(3 / 8)
    assert found["share_thinned"] == pytest.approx(0.5 / 2)  # of every second: (0, 2) on an edge


def test_error_of_a_mean_share_is_no_smaller_than_its_scatter():
    table = pd.DataFrame({"share_apart": [0.02] * 4, "share_thinned": [0.01, 0.03, 0.01, 0.03]})
    mean, error = mean_share(table)
    assert mean == pytest.approx(0.02)
    assert error == pytest.approx(0.005)
    mean, error = mean_share(table.assign(share_thinned=0.01))
    assert error == pytest.approx(0.01)


def test_widest_band_of_either_side_is_taken():
    column, frame = (
        np.array([[1.0, 2.0], [3.0, 5.0]]),
        np.array([[1.5, 2.0], [3.0, 4.0], [6.0, 7.0]]),
    )
    assert _bands_apart(column, frame) == {"column": 4.5, "frame": 6.5}
    assert _bands_apart(column, column[:1]) == {"column": 4.0}
