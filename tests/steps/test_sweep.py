"""One sweep of the ensemble: what is asked is answered, and what SciPy is asked of it."""

import numpy as np
import pytest

from steps.shared import second, sweep
from topheavy import Column, FixedMassColumn, judge
from topheavy.ground.synthetic.ensemble import first_draws

COLUMN = Column(0.5, 3.0)
ENSEMBLE = {
    "seed": 2014,
    "families": ["near-fault", "broadband"],
    "scenarios": [
        {"magnitude": 6.5, "distance": 10.0, "site_velocity": 760.0, "directivity": 10.0},
        {"magnitude": 7.3, "distance": 10.0, "site_velocity": 760.0, "directivity": 30.0},
    ],
}
SUBJECTS = [
    sweep.Subject({"name": "bare"}, COLUMN.block()),
    sweep.Subject({"name": "fixed"}, FixedMassColumn(COLUMN, 1.0).block()),
]
ASKED = {
    "pgv": sweep.Asked(SUBJECTS, np.array([[0.3, 0.6, 1.0], [0.2, 0.4, 0.8]]), 3),
    "pga": sweep.Asked(SUBJECTS[:1], np.array([0.2, 0.5]), 2, "pga"),
}


@pytest.fixture(scope="module")
def shards():
    return [sweep.sweep(ASKED, ENSEMBLE, f"{number}-of-3") for number in (3, 1, 2)]


@pytest.mark.parametrize("name", ASKED)
def test_answer_has_what_each_scaled_motion_overturns(shards, name):
    asked = ASKED[name]
    found = sweep.answers(shards, name, ENSEMBLE, asked.motions)
    assert found.draws == first_draws(ENSEMBLE, asked.motions)
    levels = np.broadcast_to(asked.levels, (len(asked.subjects), asked.levels.shape[-1]))
    for draw, peak, fell in zip(found.draws, found.peaks, found.outcomes, strict=True):
        record = draw.record()
        assert peak == (record.peak_velocity if name == "pgv" else record.peak_acceleration)
        for subject, row, outcomes in zip(asked.subjects, levels, fell, strict=True):
            expected = [judge(subject.block, record.scaled(v / peak)).overturned for v in row]
            assert outcomes.tolist() == expected
    assert 0 < found.outcomes.sum() < found.outcomes.size


def test_shard_that_is_missing_or_twice_is_told(shards):
    for some, count in ((shards[:2], 8), ([*shards, shards[0]], 16)):
        with pytest.raises(ValueError, match=f"pgv: outcomes of {count} motions; expected 12, "):
            sweep.answers(some, "pgv", ENSEMBLE, 3)


def test_outcomes_are_read_as_they_were_written(shards, tmp_path):
    paths = [str(tmp_path / f"{number}.npz") for number in range(3)]
    for path, shard in zip(paths, shards, strict=True):
        np.savez_compressed(path, **shard)
    one, other = (
        sweep.read_answers(paths, "pga", ENSEMBLE, 2),
        sweep.answers(shards, "pga", ENSEMBLE, 2),
    )
    np.testing.assert_array_equal(one.outcomes, other.outcomes)
    np.testing.assert_array_equal(one.peaks, other.peaks)


# What SciPy is asked ------------------------------------------------------------------------------


@pytest.mark.parametrize("factor", [0.3, 1.0, 4.0])
def test_factor_beside_a_boundary_has_the_same_outcome(factor):
    found = second.beside_a_boundary(lambda by: by > 1.3, factor)
    assert (found > 1.3) == (factor > 1.3)
    assert abs(found / 1.3 - 1.0) < 2.0 * second.NEAR


def test_outcome_that_a_nudge_changes_is_not_decided():
    edge = 1.0 + 0.5 * second.NUDGE
    assert second.decided(lambda by: by > edge, 1.0) is None
    assert second.decided(lambda by: by > edge, 1.1) is True
    assert second.decided(lambda by: by > edge, 0.9) is False


def test_scipy_is_asked_of_what_is_decided(monkeypatch):
    record = first_draws(ENSEMBLE, 1)[0].record()
    cells = [(COLUMN, record, factor, fell) for factor, fell in ((0.01, False), (20.0, True))]
    assert second.by_scipy(cells) == {"decided": 2, "differ": 0}
    wrong = [(*cell[:3], not cell[3]) for cell in cells]
    assert second.by_scipy(wrong) == {"decided": 2, "differ": 2}
    monkeypatch.setattr(second, "decided", lambda *given: None)
    assert second.by_scipy(wrong) == {"decided": 0, "differ": 0}
