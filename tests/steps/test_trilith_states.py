"""The trilith that already rocks: its starts, two solvers, and what refutes each result."""

import math

import pandas as pd
import pytest

from replication.workbench import truth
from steps import trilith_states
from steps.trilith_states import Course, Later, Start, by_scipy, by_taylor
from topheavy import Column, RockingFrame
from topheavy.shaking_table import table_motion

FRAME, MOTION = RockingFrame(Column(0.11, 0.40), 0.434), table_motion(0.005, 3.3)
CASE = {"column": {"half_width": 0.11, "half_height": 0.40}, "mass_ratio": 0.434}
CASE |= {"table_amplitude": 0.005, "table_frequency": 3.3}
SPEC = {
    "quarters": [0, 1],
    "rotations": {"largest": 0.6, "points": 6},
    "velocities": {"largest": 0.4, "points": 5},
    "duration": 12.0,
    "sample": {"points": 3},
    "checked_by_second_route": 2,
}
KEPT = Course("rocking", 0.064, 0.064)
RESTS, FELL = (Course(outcome, math.nan, math.nan) for outcome in ("rests", "overturned"))


@pytest.mark.parametrize("quarters", range(4))
@pytest.mark.parametrize("state", [(0.3, 0.1), (-0.35, -0.2), (0.6, 0.4), (-0.6, -0.4)])
def test_two_solvers_agree_at_every_phase(quarters, state):
    ours, other = (by(FRAME, MOTION, Start(quarters, *state), 12.0) for by in (by_taylor, by_scipy))
    assert ours.outcome == other.outcome
    assert ours[1:] == pytest.approx(other[1:], abs=1e-7, nan_ok=True)


@pytest.mark.parametrize("quarters", [0, 1])
@pytest.mark.parametrize("state", [(0.3, 0.1), (-0.35, -0.2), (0.6, 0.25)])
def test_start_half_a_cycle_later_is_its_mirror(quarters, state):
    here = by_taylor(FRAME, MOTION, Start(quarters, *state), 12.0)
    opposite = Start(quarters + 2, *(-value for value in state))
    there = by_taylor(FRAME, MOTION, opposite, 12.0)
    assert there.outcome == here.outcome
    assert there[1:] == pytest.approx(here[1:], abs=1e-12, nan_ok=True)


def test_rest_steady_rocking_and_overturning_are_reached_below_uplift():
    """The three outcomes of a motion that leaves the trilith at rest if it is at rest."""
    outcomes = [
        by_taylor(FRAME, MOTION, Start(0, *state), 24.0).outcome
        for state in ((0.0, 0.0), (0.6, 0.25), (0.3, 0.1), (0.6, 0.4))
    ]
    assert outcomes == ["rests", "rests", "rocking", "overturned"]


def test_frame_that_lies_flat_before_the_sine_takes_over_has_overturned():
    assert by_taylor(FRAME, MOTION, Start(1, 3.0, 9.0), 12.0) == pytest.approx(FELL, nan_ok=True)


def test_later_motion_is_the_motion_of_later():
    since = 0.1
    later = Later(MOTION, since)
    for segment in later.segments(1.0):
        for t in (segment.start, 0.5 * (segment.start + segment.stop), segment.stop):
            assert segment.acceleration(t) == pytest.approx(MOTION.excitation(t + since))
            assert later.excitation(t) == pytest.approx(MOTION.excitation(t + since))
    assert later.segments(1.0)[0].start == 0.0
    assert later.duration == math.inf


def test_grid_of_starts_is_symmetric_at_each_phase():
    found = list(trilith_states.starts(SPEC))
    assert len(found) == len(set(found)) == 2 * 6 * 5
    assert {(q, -r, -v) for q, r, v in found} == set(found)
    assert max(start.rotation for start in found) == 0.6
    assert max(start.velocity for start in found) == 0.4


def judged(monkeypatch, courses):
    """The findings of starts with these courses, in turn."""
    rows = [
        Start(0, 0.1 * place, 0.0)._asdict() | course._asdict()
        for place, course in enumerate(courses)
    ]
    monkeypatch.setattr(trilith_states, "outcomes", lambda *given: pd.DataFrame(rows))
    monkeypatch.setattr(trilith_states, "second_route", lambda *given: None)
    monkeypatch.setattr(trilith_states, "_agreement", lambda sample: truth(True))
    return trilith_states.main(CASE, SPEC)[-1]


@pytest.mark.parametrize(
    ("courses", "holds"),
    [
        ([KEPT, KEPT, KEPT, RESTS, FELL], True),
        ([KEPT, KEPT, KEPT, RESTS], False),  # none overturns
        ([KEPT, KEPT, KEPT, FELL], False),  # none comes to rest
        ([KEPT, KEPT, RESTS, FELL], False),  # half are not most
    ],
)
def test_most_starts_keep_rocking_and_some_end_in_each_other_way(monkeypatch, courses, holds):
    found = judged(monkeypatch, courses)["most_starts_keep_rocking"]
    assert found["holds"] is holds
    assert found["starts"] == len(courses)
    assert (found["come_to_rest"], found["overturn"]) == (courses.count(RESTS), courses.count(FELL))


@pytest.mark.parametrize(
    ("other", "holds"),
    [
        (Course("rocking", 0.0641, 0.0645), True),
        (Course("rocking", 0.0655, 0.0655), False),  # another rotation
        (Course("rocking", 0.0655, 0.0640), False),  # still settling
    ],
)
def test_steady_rotation_is_one_and_settled(monkeypatch, other, holds):
    found = judged(monkeypatch, [KEPT, other, RESTS])["one_steady_rotation"]
    assert found["holds"] is holds
    assert found["starts"] == 2


@pytest.fixture(scope="module")
def table():
    return trilith_states.outcomes(FRAME, MOTION, SPEC)


def test_pairs_beside_a_boundary_are_close_and_differ(table):
    found = trilith_states.beside_a_boundary(FRAME, MOTION, table, SPEC, 2)
    assert len(found) == 4
    for (low, ours), (high, other) in zip(found[::2], found[1::2], strict=True):
        assert 0.0 < high.rotation - low.rotation <= trilith_states.BESIDE
        assert (low.quarters, low.velocity) == (high.quarters, high.velocity)
        assert ours.outcome != other.outcome


def agreement(table):
    """The finding on the sample of a table that SciPy judges."""
    return trilith_states._agreement(trilith_states.second_route(FRAME, MOTION, table, SPEC))


def test_scipy_confirms_the_sample(table):
    found = agreement(table)
    assert found["holds"]
    assert (found["starts"], found["beside_a_boundary"]) == (3, 4)


@pytest.mark.parametrize("only", [range(3), range(3, 7)], ids=["of the grid", "beside a boundary"])
@pytest.mark.parametrize("wrong", [FELL, Course("rocking", 0.0, 0.0)])
def test_second_route_can_refute_each_part_of_its_sample(monkeypatch, table, only, wrong):
    calls = iter(range(7))

    def other(frame, motion, start, duration):
        return wrong if next(calls) in only else by_taylor(frame, motion, start, duration)

    monkeypatch.setattr(trilith_states, "by_scipy", other)
    assert not agreement(table)["holds"]
    assert next(calls, None) is None


def test_second_route_that_compares_no_boundary_does_not_hold(monkeypatch, table):
    monkeypatch.setattr(trilith_states, "beside_a_boundary", lambda *given: [])
    assert not agreement(table)["holds"]
