"""Steps on the trilith's long motion: its orbit and the states that starts reach."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from replication.workbench import truth
from steps import trilith_orbit, trilith_states
from steps.orbit.jets import Jet
from steps.orbit.shaken import Harmonic
from steps.orbit.steady import COARSE, FINE, contraction, settles, steady_rocking
from steps.trilith_states import Course, Later, Start, by_scipy, by_taylor
from topheavy import Column, Pulse, RockingFrame, simulate
from topheavy.ground.shaking_table import abrupt_start, table_motion
from topheavy.proven.balls import Undecided, arb, arb_mat, hull, precision
from topheavy.second import reference

FRAME, MOTION = RockingFrame(Column(0.11, 0.40), 0.434), table_motion(0.005, 3.3)
OMEGA, LAST = MOTION.angular_frequency, 30.0
PUSHED = abrupt_start(FRAME, 0.005, 3.3)  # rad/s, to the negative side
START = math.pi, abs(PUSHED) / OMEGA


@pytest.fixture(scope="module")
def steady():
    return steady_rocking(FRAME, MOTION, START)


@pytest.mark.parametrize("solver", [simulate, reference.simulate])
def test_solvers_come_to_the_steady_rocking(steady, solver):
    time = np.linspace(LAST - 2.0, LAST, 4001)
    found = solver(FRAME, MOTION, velocity=PUSHED, duration=LAST, samples=time)
    phases = np.mod(OMEGA * found.impacts[-6:], math.pi)
    low, high = steady.phase
    assert np.all((low - 1e-7 < phases) & (phases < high + 1e-7))
    assert np.diff(OMEGA * found.impacts[-6:]) == pytest.approx([math.pi] * 5, abs=1e-7)
    assert np.abs(found.rotation).max() == pytest.approx(steady.peak[0], rel=1e-5)
    assert steady.peak[1] - steady.peak[0] < 1e-10
    behind = solver(
        FRAME, MOTION, velocity=PUSHED, duration=LAST, samples=found.impacts[-1:] + 1e-7
    )
    assert abs(behind.velocity[0]) / OMEGA == pytest.approx(steady.velocity[0], abs=1e-7)


def test_area_of_starts_shrinks_by_the_square_of_restitution(steady):
    """A flight keeps dσ dE, an impact takes (√r)² of E: det = √r · v/|w|, (√r)² when steady."""
    with precision(136):
        slope = steady.shaken.flight(steady.centre, FINE)[1]
        assert abs(slope.det() - steady.shaken.block.restitution**2) < 1e-10


def test_derivative_of_a_flight_is_that_of_differences(steady):
    with precision(136):
        start, step = steady.centre + arb_mat(2, 1, [0.4, 0.003]), arb("1e-9")
        slope = steady.shaken.flight(start, FINE)[1]
        for k, off in enumerate(([step, 0], [0, step])):
            ends = [
                steady.shaken.lands(start + s * arb_mat(2, 1, off), (136, 1e-28)) for s in (1, -1)
            ]
            change = [(ends[0].sigma - ends[1].sigma), (ends[0].rate - ends[1].rate)]
            for j in (0, 1):
                assert abs(change[j] / (2 * step) - slope[j, k]) < 1e-5


def test_every_tried_start_of_the_disk_comes_closer_by_the_factor(steady):
    random, back = np.random.default_rng(1), steady.frame.inv()
    with precision(72):
        for _ in range(20):
            turn, share = random.uniform(0.0, 6.3), random.uniform(0.0, 1.0)
            off = [steady.radius * share * x for x in (math.cos(turn), math.sin(turn))]
            image = steady.shaken.flight(steady.centre + steady.frame * arb_mat(2, 1, off), FINE)[0]
            near = back * (image - steady.centre)
            assert math.hypot(*map(float, near.entries())) < steady.contraction * math.hypot(*off)


def test_disk_in_which_starts_may_part_is_refused(steady):
    """At the rim of a larger disk the norm exceeds 1, and at its centre it does not."""
    with precision(72):
        rim = steady.centre + steady.frame * arb_mat(2, 1, [0.3, 0.0])
        slope = steady.frame.inv() * steady.shaken.flight(rim, COARSE)[1] * steady.frame
        assert np.linalg.norm(np.array(slope.mid().tolist(), float), 2) > 1.0
        assert contraction(steady.shaken, steady.centre, steady.frame, 0.3) == 1


def test_start_that_is_not_known_well_enough_is_not_said_to_reach_the_disk(steady):
    with precision(72):
        for wide, reaches in ((1e-3, True), (0.04, False)):
            around = arb_mat(2, 1, [hull(-wide, wide), 0])
            march = steady.shaken.lands(steady.centre + around, (72, 1e-13))
            assert steady.attracts(march) is reaches


@pytest.mark.parametrize(
    ("start", "ends"),
    [
        ((0, 0.3, 0.1), "steady"),
        ((1, -0.2, 0.0), "steady"),
        ((3, 0.2, 0.0), "steady"),
        ((0, 0.3, 0.0), "rests"),
        ((0, 0.6, 0.4), "overturns"),
        ((1, 1.0, -0.9), "overturns"),
    ],
)
def test_starts_end_as_by_the_solver(steady, start, ends):
    quarters, rotation, velocity = start
    assert settles(steady, *start) == ends
    if quarters == 0:
        alpha, p = FRAME.slenderness, FRAME.frequency_parameter
        state = {"rotation": rotation * alpha, "velocity": velocity * alpha * p}
        found = simulate(FRAME, MOTION, **state, duration=24.0, samples=2)
        names = {"rocking": "steady", "rests": "rests", "overturned": "overturns"}
        assert names[found.outcome] == ends


def test_there_is_none_without_forcing_enough_or_without_loss():
    weak = Pulse("harmonic", 0.2 * MOTION.amplitude, OMEGA)
    with pytest.raises(Undecided, match="rests"):
        steady_rocking(FRAME, weak, START)
    with pytest.raises(Undecided):
        steady_rocking(FRAME.block().with_restitution(1.0), MOTION, START)


def test_bad_harmonic_is_named(steady):
    with pytest.raises(ValueError, match="expected 'harmonic'"):
        steady_rocking(FRAME, Pulse("one-sine", 0.2, OMEGA), START)
    lifts = replace(steady.shaken, forcing=Harmonic(Pulse("harmonic", 0.28, OMEGA)))
    with pytest.raises(ValueError, match="uplifts a block at rest"):
        settles(replace(steady, shaken=lifts), 0, 0.1, 0.0)


def test_jets_have_the_derivatives_of_the_function():
    x, y = Jet(arb("0.3"), (arb(1), arb(0))), Jet(arb("0.7"), (arb(0), arb(1)))
    sine, cosine = (2 * x * y - 1).sin_cos()
    found = (3 - sine * x) / 2 + cosine
    a, b = 0.3, 0.7
    s, c = math.sin(2 * a * b - 1), math.cos(2 * a * b - 1)
    assert float(found.value) == pytest.approx((3 - s * a) / 2 + c)
    slopes = (-(2 * b * c * a + s) / 2 - 2 * b * s, -(2 * a * c * a) / 2 - 2 * a * s)
    assert [float(z) for z in found.slopes] == pytest.approx(slopes)


ENDS = (("rocking", "steady"), ("rests", "rests"), ("overturned", "overturns"))


@pytest.mark.parametrize(
    ("pairs", "holds"),
    [
        (ENDS, True),
        ((*ENDS, ("rests", "undecided")), True),  # is counted
        ((*ENDS, ("rests", "steady")), False),
        ((*ENDS, ("rocking", "overturns")), False),
        (ENDS[:2], False),  # none overturns
        ((*ENDS[1:], ("rocking", "undecided")), False),
    ],
)
def test_each_end_is_proven_and_none_differs(pairs, holds):
    table = pd.DataFrame(pairs, columns=["outcome", "proven"])
    found = trilith_orbit.findings(table)["starts"]
    assert found.holds is holds
    assert found.entries["undecided"] == (table.proven == "undecided").sum()


def test_sample_has_so_many_starts_of_each_outcome(monkeypatch):
    monkeypatch.setattr(trilith_orbit, "settles", lambda found, *start: start)
    rows = [(0, 0.1 * k, 0.0, name) for k in range(30) for name in trilith_orbit.NAMES]
    table = pd.DataFrame(rows, columns=["quarters", "rotation", "velocity", "outcome"])
    found = trilith_orbit.starts(None, table)
    assert set(found.outcome.value_counts()) == {trilith_orbit.EACH}
    assert found.proven.iloc[0] == tuple(found.iloc[0, :3])


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
