"""What is refused: by the checks of values and by every public function."""

import math
import re
from fractions import Fraction
from functools import partial

import numpy as np
import pytest

import topheavy as th
from steps.shared.linear import simulate_linear_exact
from steps.shared.three_bodies import simulate_three_bodies
from tests.cases import COLUMN, FRAME
from topheavy import checks
from topheavy.bodies.response import MAX_SAMPLES
from topheavy.ground.shapes import ELEMENTARY

EVERY = [
    checks.finite,
    checks.positive,
    checks.not_negative,
    checks.acceleration,
    checks.within_quarter_turn,
    checks.fraction,
]
NO_NUMBERS = [None, "0.25", b"0.25", True, np.True_, 1j, 10**400, [1.0, 2.0], np.array([0.25])]


@pytest.mark.parametrize("check", EVERY)
@pytest.mark.parametrize("value", [np.float32(0.25), np.array(0.25)])
def test_good_value_comes_back_as_a_float(check, value):
    assert check("thing", value) == 0.25
    assert type(check("thing", value)) is float


@pytest.mark.parametrize("check", EVERY)
@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_value_that_is_not_finite_is_refused_by_every_check(check, value):
    with pytest.raises(ValueError, match=rf"thing is {value}; expected a finite number"):
        check("thing", value)


@pytest.mark.parametrize(
    ("check", "value"),
    [*((check, "0.25") for check in EVERY), *((checks.number, value) for value in NO_NUMBERS)],
)
def test_what_is_no_number_is_refused(check, value):
    with pytest.raises(ValueError, match=r"thing is .*; expected a number"):
        check("thing", value)


@pytest.mark.parametrize(
    "values",
    [[1, 2.5], (0.25,), 3.0, np.arange(4), [], [Fraction(1, 4), 2]],
)
def test_numbers_come_back_as_a_new_array_of_floats(values):
    found = checks.numbers("things", values)
    assert type(found) is np.ndarray
    assert found.dtype == np.float64
    assert found is not values
    np.testing.assert_array_equal(found, np.array(values, dtype=float))


@pytest.mark.parametrize("value", ["0.25", True])
def test_numbers_name_the_first_element_that_is_none(value):
    with pytest.raises(ValueError, match=r"^things: element 0 is .*; expected a number"):
        checks.numbers("things", [value, value])
    with pytest.raises(ValueError, match=r"^things: element 2 is .*; expected a number"):
        checks.numbers("things", np.array([0.1, 0.2, value], dtype=object))


@pytest.mark.parametrize("value", [5e-324, 1, 1e300])
def test_positive_takes_all_above_zero(value):
    assert checks.positive("thing", value) == value


@pytest.mark.parametrize(
    ("check", "value", "expected"),
    [
        (checks.positive, 0.0, "more than zero"),
        (checks.not_negative, -5e-324, "zero or more"),
        (checks.within_quarter_turn, math.pi / 2, "an angle between 0 and π/2, both excluded"),
        (checks.fraction, 1.0 + 2**-52, "a value from 0 to 1"),
    ],
)
def test_first_value_outside_of_a_range_is_refused(check, value, expected):
    with pytest.raises(ValueError, match=f"thing is .*; expected {expected}"):
        check("thing", value)


PULSE = th.Pulse("one-sine", 0.3, 6.0)


RECORD = th.Record(0.1, [0.0, 0.3, 0.0])
QUIET = th.Record(0.1, [0.0, 1e-3])
RICKER = th.Pulse("ricker-symmetric", 0.5, 6.0)
NEVER_ENDS = th.Pulse("harmonic", 0.3, 6.0)
BODIES = partial(simulate_three_bodies, span=5.0, cap_depth=0.6, duration=1.0)
FACTORS = partial(th.overturned_by, factors=[1.0])
JUDGES = [th.judge, FACTORS]
HISTORIES = [th.simulate, BODIES]
TOLERANT = [*HISTORIES, *JUDGES]


def refused(solver, message, *, structure=FRAME, excitation=PULSE, **options):
    with pytest.raises(ValueError, match=f"(?s)^{message}") as error:
        solver(structure, excitation, **options)
    assert len(str(error.value)) < 400  # no array is printed whole


@pytest.mark.parametrize("solver", [th.simulate, *JUDGES])
@pytest.mark.parametrize("motion", [np.arange(1e4), "one-sine", th.Pulse], ids=type)
def test_what_is_no_ground_motion_is_refused_with_an_example(solver, motion):
    says = r"excitation is .*; expected a Pulse or a Record, for example Pulse\(\"one-sine\", 0\.3"
    refused(solver, says, excitation=motion)
    if solver in JUDGES:
        refused(solver, "excitation is None; expected a Pulse or a Record", excitation=None)
    needed = ".* goes on forever; expected" if solver in JUDGES else "duration is"
    refused(solver, needed, excitation=NEVER_ENDS)


@pytest.mark.parametrize("solver", HISTORIES)
@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"rotation": math.pi / 2}, "rotation is 1.5708 rad; expected less than π/2"),
        ({"duration": 0.0}, "duration is 0 s; expected more than zero"),
        ({"duration": 1e300}, r"duration is 1e\+300 s; expected at most 1e\+09 s"),
        ({"samples": 1}, "samples is 1; expected a whole number from 2 to"),
        ({"samples": 10**9}, f"samples is 1000000000; expected .* to {MAX_SAMPLES}"),
        ({"samples": [[0.0, 1.0]]}, r"samples has shape \(1, 2\); expected a list of times in s"),
        ({"samples": [0.0, math.nan]}, "samples holds times that are not finite"),
        ({"samples": [0.0, 0.1, 0.1]}, "samples is not an increasing array"),
    ],
)
def test_history_is_refused(solver, options, message):
    refused(solver, message, **options)


@pytest.mark.parametrize("solver", TOLERANT)
@pytest.mark.parametrize("value", [0.02, 1e-300, math.nan, "1e-9"])
def test_tolerance_out_of_range_is_refused(solver, value):
    given = re.escape(repr(value) if isinstance(value, (int, float, str)) else str(value))
    between = "" if isinstance(value, str) else r" from 1e-1[36] to 0\.01"
    refused(solver, f"tolerance is {given}; expected a number{between}$", tolerance=value)


@pytest.mark.parametrize("value", [1e-16, np.float64(1e-14), 1e-2])
def test_tolerance_at_the_ends_of_its_range_gives_histories(value):
    whole = th.simulate(FRAME, RICKER, tolerance=value)
    assert th.judge(FRAME, RICKER, tolerance=value).overturned == whole.overturned
    usual = th.simulate(FRAME, RICKER).peak_rotation
    assert whole.peak_rotation == pytest.approx(usual, rel=0.05)


@pytest.mark.parametrize("solver", [th.simulate, *JUDGES])
@pytest.mark.parametrize(
    ("motion", "up", "message"),
    [
        (PULSE, RECORD, "excitation is Pulse and vertical Record; expected two Records"),
        (RECORD, 0.3, "excitation is Record and vertical float; expected two Records"),
        (RECORD, [0.1, 0.2], "excitation is Record and vertical list; expected two Records"),
        (
            *(RECORD, th.Record(0.1, [0.0, -1.0])),
            "vertical: at 0.1 s its acceleration times 1 is -1 g; expected more than −1 g",
        ),
        (
            *(RECORD, th.Record(0.05, [0.0, 0.4, -0.8, -1.25, 0.0])),
            r"vertical: at 0\.15 s its acceleration times 1 is -1\.25 g; expected more than −1 g, "
            r".*factors less than 0\.8 are allowed$",
        ),
    ],
)
def test_vertical_motion_is_refused(solver, motion, up, message):
    refused(solver, message, excitation=motion, vertical=up)


FINE = np.linspace(0.1, 1.0, 20_000)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: th.Column(1e300, 3.0), "half_width is 1e+300 m; expected at most 1e+09 m"),
        (lambda: th.FixedMassColumn(COLUMN, 1.0, 1e308), "cap_width is 1e+308 m; expected at most"),
        (lambda: th.MonolithicPortal(COLUMN, 1.0, 1e300), "span is 1e+300 m; expected at most"),
        (lambda: th.Cap(3.0, 1e200), "half_depth is 1e+200 m; expected at most"),
        (lambda: th.Record(1e300, [0.0, 0.1]), "time_step is 1e+300 s; expected at most 1e+09 s"),
        (lambda: th.Record(0.01, [0.0, 1e200]), "sample 1 of 2 is 1e+200 g"),
        (
            lambda: th.overturning_intervals(COLUMN, PULSE, (0.0, 5.0), resolution=1e-300),
            "resolution is 1e-300 of 0 to 5: 1e+18 cells; expected at most",
        ),
        (
            lambda: th.overturning_map(COLUMN, "one-sine", FINE, FINE),
            "scales by amplitudes: 4e+08 cells; expected at most 1e+08",
        ),
        (lambda: simulate_linear_exact(COLUMN.block(), PULSE), "the block is not linearised"),
        (
            lambda: simulate_linear_exact(
                COLUMN.block().linear(), th.Pulse("ricker-symmetric", 1, 1)
            ),
            "'ricker-symmetric'",
        ),
    ],
)
def test_what_is_beyond_reason_is_refused_by_its_name(ask, message):
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        ask()
    if "ricker" in message:
        assert error.match(", ".join(ELEMENTARY))


@pytest.mark.parametrize("samples", [[], [0.3], 0.3])
def test_record_of_fewer_than_two_samples_is_refused(samples):
    with pytest.raises(ValueError, match=r"(?s)'Kos'.*two sam"):
        th.Record(0.01, samples, "Kos")


# ---------------------------------------------------------------------------- what is asked


@pytest.mark.filterwarnings("always")
@pytest.mark.parametrize(
    ("make", "asked"),
    [
        (lambda: th.Record(10.0, [0.0, 0.1]), "time_step is 10 s.*is it in ms"),
        (lambda: RECORD.scaled_to(pgv=60), "pgv is 60 m/s.*is it in cm/s"),
        (lambda: QUIET.scaled_to(pga=2), "record is scaled by 2e\\+03: is it noise"),
        (lambda: RECORD.scaled_to(pga=200), "pga is 200 g.*is it in gal"),
        (lambda: th.Record(0.1, [0.0, 3.13]), "; the largest acceleration is 3.13 g.*m/s²"),
    ],
)
def test_what_is_probably_a_mistake_is_asked_where_it_was_written(make, asked):
    with pytest.warns(UserWarning, match=asked) as caught:
        make()
    assert [one.filename for one in caught] == [__file__]
