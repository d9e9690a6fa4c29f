"""Motions, break-even and records: the sweep, numbers by hand, and findings that break."""

import math

import numpy as np
import pandas as pd
import pytest

from replication.config import read_yaml
from steps.beyond import break_even, motions, records
from steps.shared import second, sweep
from steps.shared.ensemble import Ensemble
from tests.cases import COLUMN, ROOT
from topheavy import Record, RockingFrame, judge

CONFIG = read_yaml(ROOT / "config" / "config.yaml")
EVEN = CONFIG["break_even"] | {"reductions": {"highest": 0.2, "step": 0.1}}
SETTINGS = CONFIG["motions"] | {
    "motions": 4,
    "noise": CONFIG["motions"]["noise"] | {"motions": 3, "soils": [1.0], "corners": [0.2]},
    "vertical": CONFIG["motions"]["vertical"] | {"motions": 2},
    "bootstrap": {"resamples": 100, "confidence": 0.95, "seed": 1},
}


@pytest.fixture(scope="module")
def shards(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shards")
    paths = [folder / f"motions_{number}-of-2.npz" for number in (2, 1)]
    for path in paths:
        found = sweep.sweep(SETTINGS, EVEN, COLUMN, path.stem.removeprefix("motions_"))
        np.savez_compressed(path, **found)
    return [str(path) for path in paths]


def test_models_are_two_sets_noise_and_vertical_motion():
    names = list(sweep.models(CONFIG["motions"]))
    assert (names[:2], len(names)) == ([*sweep.SETS], 10)
    counts = {name: len(each) for name, each in sweep.models(SETTINGS).items()}
    assert list(counts.values()) == [8, 8, 3, 4, 4]
    assert [one.earthquake for one in sweep.models(SETTINGS)["broadband"]] == [0] * 4 + [1] * 4


def test_outcomes_of_all_shards_are_those_of_single_motions(shards):
    for model, each in sweep.models(SETTINGS).items():
        found, question = sweep.outcomes(shards, model), sweep.question_of(model, SETTINGS, COLUMN)
        assert found.shape == (len(each), len(question.blocks), question.velocities.size)
        record, up = sweep.components(each[2], SETTINGS)
        factor = SETTINGS["velocity"] / record.peak_velocity
        if up is not None:
            assert up.peak_acceleration == pytest.approx(2.0 / 3.0 * record.peak_acceleration)
            up = up.scaled(factor)
        for block, fell in zip(question.blocks, found[2, :, -1], strict=True):
            assert judge(block, record.scaled(factor), vertical=up).overturned == fell
    lowered = sweep.outcomes(shards, "broadband: lowered")
    column, frame = (sweep.outcomes(shards, "broadband")[:, place, -1] for place in (0, 2))
    at = EVEN["velocities"].index(SETTINGS["velocity"])
    assert (lowered[:, 0, at] == column).all()
    assert (lowered[:, 3, at] == frame).all()


def test_a_motion_that_leaves_the_ground_in_free_fall_is_left_out():
    still = Record(0.01, np.sin(np.arange(300) / 20.0))
    up = Record(0.01, np.where(np.arange(300) == 100, -1.1, 0.0))
    question = sweep.Question([COLUMN.block()], np.array([still.peak_velocity]))
    assert sweep.overturned(question, still, up) == sweep.FREE_FALL


def test_a_block_with_lower_restitution_has_the_stated_share():
    blocks = sweep.restitution_question(SETTINGS, EVEN, COLUMN).blocks
    own, of_frame = COLUMN.restitution, RockingFrame(COLUMN, 1.0).restitution
    expected = [own, 0.9 * own, 0.8 * own, of_frame, 0.95 * of_frame, 0.9 * of_frame]
    assert [block.restitution for block in blocks] == pytest.approx(expected)


def test_numbers_of_a_row_are_those_of_its_outcomes():
    velocities = np.geomspace(0.15, 4.0, 17)
    fell = np.zeros((40, 3, 18), bool)
    for place, level in ((motions.COLUMN, 8), (motions.FIXED, 4), (motions.FRAME, 10)):
        for motion in range(40):
            fell[motion, place, level + motion % 5 : -1] = True
    fell[:20, motions.COLUMN, -1] = fell[10:18, motions.FRAME, -1] = fell[
        :30, motions.FIXED, -1
    ] = True
    fell[38:, motions.FRAME, -1] = True
    ensemble = Ensemble(fell, None, **SETTINGS["bootstrap"])
    row = motions.row("model", ensemble, ensemble.means(), velocities)
    names = ("column", "fixed", "frame", "harm", "benefit", "only_frame", "only_column")
    assert [row[name] for name in names] == [0.5, 0.75, 0.25, 0.25, 0.25, 2, 12]
    assert row["gain"] == pytest.approx(velocities[10] / velocities[8] - 1.0, rel=1e-3)


ROWS = {"column": 0.2, "fixed": 0.5, "frame": 0.1, "gain": 0.2, "only_frame": 3}
ROWS = {name: [number, number] for name, number in ROWS.items()}
ROWS |= {"harm_low": [0.1, 0.1], "benefit_low": [0.05, 0.05], "gain_low": [0.1, 0.1]}
PAIRS = {"reversed": [0.2, 0.4], "reversed_high": [0.3, 0.45]}


@pytest.mark.parametrize(
    ("change", "false"),
    [
        ({}, set()),
        ({"benefit_low": [0.1, -0.01]}, {"order"}),
        ({"harm_low": [0.0, 0.1]}, {"order"}),
        ({"gain_low": [-0.1, 0.1]}, {"gain"}),
        ({"only_frame": [0, 3]}, {"some_only_frame"}),
        ({"reversed_high": [0.3, 0.5]}, {"probability_is_lower"}),
    ],
)
def test_one_row_is_enough_to_refute(change, false):
    rows = {name: change.get(name, given) for name, given in ROWS.items()}
    found = motions.findings(pd.DataFrame(rows), pd.DataFrame(PAIRS | change))
    assert {name for name, one in found.items() if not one["holds"]} == false


def test_the_benefit_ends_where_its_isotonic_fit_is_zero():
    shares = np.linspace(0.0, 0.2, 5)
    assert break_even.end_of(shares, np.array([3.0, 2.0, 1.0, -1.0, -2.0])) == pytest.approx(0.125)
    assert break_even.end_of(shares, np.array([3.0, 1.0, 2.0, -1.5, -2.0])) == pytest.approx(0.1125)
    assert break_even.end_of(shares, np.array([4.0, 3.0, 2.0, 1.0, 0.5])) == math.inf
    assert break_even.end_of(shares, np.array([-1.0, -2.0, -3.0, -4.0, -5.0])) == 0.0


@pytest.mark.parametrize(
    ("end", "low", "false"),
    [
        ([0.05, 0.08], [0.02, 0.03], set()),
        ([0.05, math.inf], [0.02, 0.03], {"benefit_ends"}),
        ([0.05, 0.08], [0.02, 0.0], {"frame_is_safer"}),
    ],
)
def test_one_velocity_or_change_is_enough_to_refute(end, low, false):
    ends = pd.DataFrame({"end": end, "end_low": [0.04, 0.05]})
    benefits = pd.DataFrame(
        {"lowered": ["both", "both", "column alone"], "benefit_low": [*low, -1.0]}
    )
    found = break_even.findings(ends, benefits)
    assert {name for name, one in found.items() if not one["holds"]} == false


def test_counts_are_of_outcomes_that_are_known(monkeypatch):
    outcomes = {0.0: [1, 1, -1, 0], 1.0: [1, -1, 1, 1]}
    monkeypatch.setattr(records, "read_record", lambda path: Record(0.01, [0.1, 0.2, 0.1], path))
    monkeypatch.setattr(
        records, "overturned", lambda frame, *_: np.array(outcomes[frame.mass_ratio])
    )
    monkeypatch.setattr(records, "check_by_scipy", list)
    settings = {
        "mass_ratios": [0.0, 1.0],
        "slendernesses": [10.0],
        "sizes": {"lowest": 1.0, "highest": 2.0, "points": 1},
        "factors": {"lowest": 1.0, "highest": 4.0, "points": 4},
        "checked": 1,
    }
    (row,) = records.compute(settings, {"tightened": 1e-12}, ["one"])
    names = ("compared", "decided", "both", "only_lighter", "only_heavier")
    assert [row[name] for name in names] == [4, 3, 1, 1, 1]
    found = records.findings(pd.DataFrame([row]))
    assert (found["heavier_is_safer"]["holds"], found["fewer_reversals"]["holds"]) == (False, False)


def test_outcomes_that_a_nudge_changes_are_not_known():
    record = Record(0.01, np.sin(np.arange(200) / 20.0))
    edge = second.beside_a_boundary(lambda f: judge(COLUMN, record.scaled(f)).overturned, 0.3)
    low, high = edge * 0.999, edge * 1.002
    for _ in range(60):
        middle = 0.5 * (low + high)
        fell = judge(COLUMN, record.scaled(middle)).overturned
        low, high = (low, middle) if fell else (middle, high)
    assert records.overturned(COLUMN, record, np.array([0.1, low, 2.0]), 3e-12).tolist() == [
        -1,
        0,
        1,
    ]


def test_a_solver_that_differs_stops_the_step(monkeypatch):
    cells = [(COLUMN.block(), Record(0.01, np.sin(np.arange(200) / 20.0)), None, 0.1, False)]
    second.check_by_scipy(cells)
    with pytest.raises(SystemExit, match="SciPy has 1 of 1 outcomes otherwise"):
        second.check_by_scipy([(*cells[0][:-1], True)])
