"""What every solver refuses, in the same words; and what would exhaust the machine."""

import math
import re
from functools import partial

import numpy as np
import pytest

from topheavy import (
    Cap,
    Column,
    Ending,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    RockingFrame,
    fragility,
    intervals_together,
    judge,
    minimum_overturning,
    overturning_intervals,
    overturning_map,
    overturning_map_of_record,
    reference,
    simulate,
)
from topheavy.linear import simulate_linear_exact
from topheavy.overturning import Search
from topheavy.three_bodies import simulate_three_bodies

COLUMN = Column(0.5, 3.0)
FRAME = RockingFrame(COLUMN, 1.0)
PULSE = Pulse("one-sine", 0.3, 6.0)
RECORD = Record(0.1, [0.0, 0.3, 0.0])
NEVER_ENDS = Pulse("harmonic", 0.3, 6.0)
BODIES = partial(simulate_three_bodies, span=5.0, cap_depth=0.6, duration=1.0)
HISTORIES = [simulate, reference.simulate, simulate_linear_exact, BODIES]
SOLVERS = [*HISTORIES, judge, reference.judge]


def refused(solver, message, *given, **options):
    subject = FRAME if solver is BODIES else COLUMN
    subject = subject.block().linear() if solver is simulate_linear_exact else subject
    with pytest.raises(ValueError, match=message):
        solver(*(given or (subject, options.pop("excitation", PULSE))), **options)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("motion", [0.3, "one-sine", [0.1, 0.2], Pulse])
def test_what_is_no_ground_motion_is_refused(solver, motion):
    refused(solver, "^excitation is .*; expected a Pulse or a Record, for", excitation=motion)


@pytest.mark.parametrize("solver", [judge, reference.judge])
@pytest.mark.parametrize("motion", [None, NEVER_ENDS])
def test_judge_refuses_a_motion_without_an_end(solver, motion):
    refused(solver, "expected a Pulse or a Record|goes on forever; expected one", excitation=motion)


@pytest.mark.parametrize("solver", HISTORIES)
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rotation": math.nan}, "rotation is nan; expected a finite number"),
        ({"rotation": 2.0}, "rotation is 2 rad; expected less than π/2"),
        ({"velocity": "fast"}, "velocity is 'fast'; expected a number"),
        ({"duration": 0.0}, "duration is 0 s; expected more than zero"),
        ({"duration": 1e300}, r"duration is 1e\+300 s; expected at most 1e\+09 s"),
        ({"samples": 1}, "samples is 1; expected a whole number of at least 2"),
        ({"samples": [[0.0, 1.0]]}, r"samples has shape \(1, 2\); expected a list of times in s"),
        ({"samples": [0.0, math.inf]}, "samples holds times that are not finite"),
        ({"samples": [1.0, 0.0]}, "samples is not an increasing array"),
    ],
)
def test_history_is_refused(solver, options, message):
    if solver is simulate_linear_exact and options.get("rotation") == 2.0:
        pytest.skip("a linearised block may rotate further")
    refused(solver, message, **options)


@pytest.mark.parametrize("solver", [simulate, reference.simulate, BODIES, judge, reference.judge])
@pytest.mark.parametrize("value", [0.0, 1.0, "tight", math.nan])
def test_tolerance_out_of_range_is_refused(solver, value):
    refused(solver, "^tolerance is .*; expected a float from 1e-1[36] to 0.01", tolerance=value)


@pytest.mark.parametrize("solver", [simulate, reference.simulate, BODIES, judge, reference.judge])
@pytest.mark.parametrize(
    ("motion", "up", "message"),
    [
        (PULSE, RECORD, "excitation is Pulse and vertical Record; expected two Records"),
        (RECORD, 0.3, "excitation is Record and vertical float; expected two Records"),
        (RECORD, Record(0.1, [0.0, -1.0]), "vertical: at 0.1 s its acceleration times 1 is -1 g"),
    ],
)
def test_vertical_motion_is_refused(solver, motion, up, message):
    refused(solver, message, excitation=motion, vertical=up)


FINE = np.linspace(0.1, 1.0, 20_000)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: Column(1e300, 3.0), "half_width is 1e+300 m; expected at most 1e+09 m"),
        (lambda: FixedMassColumn(COLUMN, 1.0, 1e308), "cap_width is 1e+308 m; expected at most"),
        (lambda: MonolithicPortal(COLUMN, 1.0, 1e300), "span is 1e+300 m; expected at most"),
        (lambda: Cap(3.0, 1e200), "half_depth is 1e+200 m; expected at most"),
        (lambda: Record(1e300, [0.0, 0.1]), "time_step is 1e+300 s; expected at most 1e+09 s"),
        (
            lambda: minimum_overturning(COLUMN, PULSE, (0.0, 5.0), resolution=1e-9),
            "resolution is 1e-09 of 0 to 5: 5e+09 cells; expected at most 1e+08",
        ),
        (
            lambda: overturning_intervals(COLUMN, PULSE, (0.0, 5.0), resolution=1e-300),
            "resolution is 1e-300 of 0 to 5: 1e+18 cells; expected at most",
        ),
        (
            lambda: intervals_together([Search(COLUMN, PULSE, (0.0, 5.0))], resolution=1e-9),
            "resolution is 1e-09",
        ),
        (
            lambda: overturning_map(COLUMN, "one-sine", FINE, FINE),
            "angular_frequencies by amplitudes: 4e+08 cells; expected at most 1e+08",
        ),
        (
            lambda: overturning_map_of_record(COLUMN, RECORD, FINE, FINE),
            "sizes by peak_accelerations: 4e+08 cells; expected at most",
        ),
        (
            lambda: fragility([COLUMN], [RECORD], [0.1, 0.2], resamples=10**9),
            "resamples is 1000000000; expected at most 100000",
        ),
    ],
)
def test_what_would_exhaust_the_machine_is_refused_by_its_name(ask, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        ask()


def test_endings_that_overturn_are_the_same_whatever_made_their_nan():
    one, other = (Ending(True, float("nan"), 2) for _ in range(2))
    assert one == other
    assert hash(one) == hash(other)
    assert one != Ending(True, math.nan, 1)
    assert Ending(False, 0.1, 0) == Ending(False, 0.1, 0) != Ending(False, 0.2, 0)
