"""The steps of the study, in limits and where they have to fail."""

import json
import math
from types import SimpleNamespace

import pandas as pd
import pytest

from studies.mechanism.steps.dependence import opens_below_the_shortest_bay, shortest_bay
from studies.mechanism.steps.equivalence import equivalent_column, maps
from studies.mechanism.steps.rigs import NO_ENGINE, experiment
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
