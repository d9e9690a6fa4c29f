"""Steps of the study: findings that decide, demands, equivalent columns."""

import json
import math
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from steps.shared.histories import history
from studies.mechanism.steps import admissible
from studies.mechanism.steps.admissible import lightest_without_sliding
from studies.mechanism.steps.beside import _bands_apart
from studies.mechanism.steps.demand import Demand, demand
from studies.mechanism.steps.dependence import opens_below_the_shortest_bay, shortest_bay
from studies.mechanism.steps.equivalence import differences, equivalent_column, maps, mean_share
from studies.mechanism.steps.rigs import NO_ENGINE, experiment
from studies.mechanism.steps.setting import pulse_on
from studies.mechanism.steps.three_bodies import AGREE, compare
from topheavy import Cap, Column, Pulse, RockingFrame

COLUMN, CAP = Column(0.5, 3.0), Cap(span=5.0, half_depth=0.5)
GRIDS = {
    "frequency_ratios": {"lowest": 2.0, "highest": 6.0, "points": 5},
    "amplitudes": {"lowest": 1.0, "highest": 6.0, "points": 11},
}


def test_equivalent_column_has_the_size_and_frequency_of_the_frame_and_its_own_restitution():
    frame = RockingFrame(COLUMN, 1.0)
    block = equivalent_column(frame)
    assert block.frequency_parameter == pytest.approx(frame.frequency_parameter)
    assert block.slenderness == pytest.approx(frame.slenderness)
    assert block.restitution == pytest.approx(COLUMN.restitution)
    assert block.restitution > frame.restitution


def test_frame_without_a_cap_is_its_equivalent_column():
    alone = RockingFrame(COLUMN, 0.0)
    one, other = maps((alone.block(), equivalent_column(alone)), alone, "one-sine", GRIDS)
    pd.testing.assert_frame_equal(one, other, rtol=1e-7)


def test_seat_of_massless_columns_opens_below_a_bay_of_2b_and_2d_tan_alpha():
    frame = RockingFrame(COLUMN, math.inf)
    assert shortest_bay(frame, 0.5) == pytest.approx(1.0 + 2 * 0.5 / 6)
    bays = opens_below_the_shortest_bay(frame, 0.5)
    assert ((bays.least < 0.0) == (bays.span < bays.shortest_bay)).all()


def test_three_bodies_agree_with_the_frame_and_with_no_other():
    frame, pulse = RockingFrame(COLUMN, 1.0), Pulse("one-sine", 0.3, 6.0)
    row = compare(frame, CAP, pulse, 4.0, 200)
    assert row["impacts"] > 0
    assert max(row["rotation_apart"], row["force_apart"], row["ratio_apart"]) < AGREE
    assert abs(COLUMN.restitution - frame.restitution) > 1e3 * row["ratio_apart"]


def test_without_the_engine_an_experiment_says_why_it_tested_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr("replication.workbench.undeclared", lambda declared: [])
    job = SimpleNamespace(
        input=[],
        log=[str(tmp_path / "log")],
        params=SimpleNamespace(engine=None),
        output=[str(tmp_path / "t.csv"), str(tmp_path / "f.json")],
    )
    experiment(job, lambda *_: pytest.fail("it ran"))
    found = json.loads((tmp_path / "f.json").read_text("utf-8"))
    assert found == {"not_tested": NO_ENGINE, "called": []}
    assert pd.read_csv(tmp_path / "t.csv").not_tested.tolist() == [NO_ENGINE]


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


FRAME = RockingFrame(COLUMN, 1.0)


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return pulse_on(COLUMN, {"shape": shape, "frequency_ratio": ratio}, amplitude)


def test_frame_that_stays_at_rest_asks_for_nothing():
    found = demand(FRAME, CAP, history(FRAME, pulse(0.9), 4))
    assert found.outcome == "no uplift"
    assert np.isnan(found.friction)
    assert not found.pulls


def test_error_covers_what_many_more_samples_find():
    shaking = pulse(2.0)
    few, many = (demand(FRAME, CAP, history(FRAME, shaking, n)) for n in (4, 256))
    assert abs(few.whole - many.whole) <= few.friction_error + 1e-12
    assert few.friction_error < 0.02 * few.whole
