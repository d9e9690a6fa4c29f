"""The trilith that already rocks: its starts, two solvers, and what refutes each result."""

import math

import pandas as pd
import pytest

import topheavy as th
from replication.workbench import truth
from steps import trilith_states
from steps.trilith_states import Course, Later, Start, by_scipy, by_taylor
from topheavy.ground.shaking_table import table_motion

FRAME, MOTION = th.RockingFrame(th.Column(0.11, 0.40), 0.434), table_motion(0.005, 3.3)
CASE = {"column": {"half_width": 0.11, "half_height": 0.40}, "mass_ratio": 0.434}
CASE |= {"table_amplitude": 0.005, "table_frequency": 3.3}
SPEC = {"quarters": [0, 1], "rotations": {"largest": 0.6, "points": 6}, "duration": 12.0}
SPEC |= {"velocities": {"largest": 0.4, "points": 5}, "sample": {"points": 3}}
SPEC |= {"checked_by_second_route": 2}
KEPT = Course("rocking", 0.064, 0.064)
RESTS, FELL = (Course(outcome, math.nan, math.nan) for outcome in ("rests", "overturned"))


def course(quarters, rotation, velocity, by=by_taylor, duration=12.0):
    return by(FRAME, MOTION, Start(quarters, rotation, velocity), duration)


@pytest.mark.parametrize("quarters", range(4))
@pytest.mark.parametrize("state", [(0.3, 0.1), (-0.35, -0.2), (0.6, 0.4), (-0.6, -0.4)])
def test_two_solvers_agree_and_half_a_cycle_later_is_the_mirror(quarters, state):
    ours, other = (course(quarters, *state, by) for by in (by_taylor, by_scipy))
    there = course(quarters + 2, *(-value for value in state)) if quarters < 2 else ours
    assert ours.outcome == other.outcome == there.outcome
    assert ours[1:] == pytest.approx(other[1:], abs=1e-7, nan_ok=True)
    assert ours[1:] == pytest.approx(there[1:], abs=1e-12, nan_ok=True)


def test_rest_steady_rocking_and_overturning_are_reached_below_uplift():
    """The three outcomes of a motion that leaves the trilith at rest if it is at rest."""
    starts = ((0.0, 0.0), (0.6, 0.25), (0.3, 0.1), (0.6, 0.4))
    outcomes = [course(0, *state, duration=24.0).outcome for state in starts]
    assert outcomes == ["rests", "rests", "rocking", "overturned"]
    # flat before the sine takes over
    assert course(1, 3.0, 9.0) == pytest.approx(FELL, nan_ok=True)


def test_later_motion_is_the_motion_of_later():
    later = Later(MOTION, 0.1)
    for segment in later.segments(1.0):
        for t in (segment.start, 0.5 * (segment.start + segment.stop), segment.stop):
            then = pytest.approx(MOTION.excitation(t + 0.1))
            assert segment.acceleration(t) == then
            assert later.excitation(t) == then
    assert (later.segments(1.0)[0].start, later.duration) == (0.0, math.inf)


@pytest.fixture
def judged(given):
    """Return the findings of starts with given courses, in turn."""

    def found(courses):
        rows = pd.DataFrame(
            Start(0, 0.1 * place, 0.0)._asdict() | one._asdict()
            for place, one in enumerate(courses)
        )
        given(trilith_states, outcomes=rows, second_route=None, _agreement=truth(True))
        return trilith_states.main(CASE, SPEC)[-1]

    return found


@pytest.mark.parametrize(
    ("courses", "holds"),
    [
        ([KEPT, KEPT, KEPT, RESTS, FELL], True),
        ([KEPT, KEPT, KEPT, RESTS], False),  # none overturns
        ([KEPT, KEPT, KEPT, FELL], False),  # none comes to rest
        ([KEPT, KEPT, RESTS, FELL], False),  # half are not most
    ],
)
def test_most_starts_keep_rocking_and_some_end_in_each_other_way(judged, courses, holds):
    found = judged(courses)["most_starts_keep_rocking"]
    assert (found["holds"], found["starts"]) == (holds, len(courses))
    assert (found["come_to_rest"], found["overturn"]) == (courses.count(RESTS), courses.count(FELL))


@pytest.mark.parametrize(
    ("last", "holds"),
    [
        ((0.0641, 0.0645), True),
        ((0.0655, 0.0655), False),  # another rotation
        ((0.0655, 0.0640), False),  # still settling
    ],
)
def test_steady_rotation_is_one_and_settled(judged, last, holds):
    found = judged([KEPT, Course("rocking", *last), RESTS])["one_steady_rotation"]
    assert (found["holds"], found["starts"]) == (holds, 2)


@pytest.fixture(scope="module")
def table():
    return trilith_states.outcomes(FRAME, MOTION, SPEC)


def agreement(table):
    """The finding on the sample of a table that SciPy judges."""
    return trilith_states._agreement(trilith_states.second_route(FRAME, MOTION, table, SPEC))


def test_scipy_confirms_the_sample_and_pairs_beside_a_boundary_that_are_close_and_differ(table):
    found = agreement(table)
    assert (found["holds"], found["starts"], found["beside_a_boundary"]) == (True, 3, 4)
    found = trilith_states.beside_a_boundary(FRAME, MOTION, table, SPEC, 2)
    assert len(found) == 4
    for (low, ours), (high, other) in zip(found[::2], found[1::2], strict=True):
        assert 0.0 < high.rotation - low.rotation <= trilith_states.BESIDE
        assert (low.quarters, low.velocity) == (high.quarters, high.velocity)
        assert ours.outcome != other.outcome


@pytest.mark.parametrize("only", [range(3), range(3, 7)], ids=["of the grid", "beside a boundary"])
@pytest.mark.parametrize("wrong", [FELL, Course("rocking", 0.0, 0.0)])
def test_second_route_can_refute_each_part_of_its_sample(given, table, only, wrong):
    calls = iter(range(7))
    given(trilith_states, by_scipy=lambda *g: wrong if next(calls) in only else by_taylor(*g))
    assert not agreement(table)["holds"]
    assert next(calls, None) is None


def test_second_route_that_compares_no_boundary_does_not_hold(given, table):
    given(trilith_states, beside_a_boundary=[])
    assert not agreement(table)["holds"]
