"""What is refused or asked about: each check once with its words, and by each public argument."""

import copy
import math
import pickle
import re
from functools import cache, partial, wraps

import matplotlib.pyplot as plt
import numpy as np
import pytest

import topheavy as th
from steps.shared.linear import simulate_linear_exact as closed
from tests.cases import BLOCK, COLUMN, FRAME, MOTION
from topheavy import checks
from topheavy.bodies.free_rocking import quarter_period, restoring_moment
from topheavy.bodies.response import MAX_SAMPLES
from topheavy.bodies.structures import simplified
from topheavy.forces.contacts import forces_at
from topheavy.forces.members import clamped_forces
from topheavy.ground.shapes import ELEMENTARY

# ---------------------------------------------------------------------------- every argument

PULSE = th.Pulse("one-sine", 0.5, angular_frequency=2.0)
RICKER = th.Pulse("ricker-symmetric", 0.5, angular_frequency=6.0)
SHAKING = th.Record(0.02, 0.3 * np.sin(0.1 * np.arange(200)))
UP = th.Record(0.02, 0.1 * np.sin(0.2 * np.arange(200)))
MOTIONS = [th.Record(0.02, 0.3 * np.sin(k * np.arange(200))) for k in (0.03, 0.05, 0.08, 0.2)]
LEVELS = np.geomspace(0.1, 3.0, 20)
FACTORS = np.geomspace(0.5, 2.0, 600)
CAP = th.Cap(5.0, 0.5)
SCALED = {"vertical": UP, "scale_vertical": True}
SHAKEN = {"structure": FRAME, "excitation": SHAKING}
MAP = {"structure": FRAME, "scales": [1.0, 2.0], "amplitudes": [0.25]}
TIGHT = {"tolerance": 2.0**-30}
RANGE = {"scale_range": (0.5, 2.0), **SCALED}
CURVES = {"structures": [COLUMN], "motions": MOTIONS, "levels": [0.5, 1.0], "measure": "PGV"}
CURVES |= {"vertical": [UP] * 4, "scale_vertical": True, "seed": 2}
CURVES |= {"rotation_limit": 0.125, "skewed": False, "confidence": 0.5, "resamples": 100}
START = {"rotation": 0.125, "velocity": 0.125, "duration": 2.0, "samples": 8, "vertical": UP}
BEAM = {"column": COLUMN, "mass_ratio": 1.0}
SINE = {"shape": "one-sine", "amplitude": 0.5}
SINES = {"shape": "one-sine", "periods": [1.0, 2.0], "highest": 4.0}
THREE_NUMBERS = {"frequency_parameter": 2.0, "slenderness": 0.25, "restitution": 0.5}
OUTCOMES = {"factors": FACTORS, "overturned": FACTORS > 1.5, "unit_acceleration": 0.5}


@cache
def history():
    return th.simulate(FRAME, SHAKING, samples=50)


def of_response(function):
    """Return a function that computes its response when it is called, and not before any test."""

    @wraps(function)
    def called(response, **values):
        return function(response=history() if response is history else response, **values)

    return called


def call(function, **values):
    """Return a public function and good values of its arguments, all exact in single precision."""
    return function, values


CALLS = [
    call(th.Column, half_width=0.5, half_height=3.0),
    call(th.Column.of_dimensions, width=1.0, height=6.0),
    call(COLUMN.block, restitution=0.5),
    call(th.RockingFrame, **BEAM, columns=2),
    call(th.RockingFrame.of_masses, column=COLUMN, cap_mass=4.0, column_mass=2.0, columns=2),
    call(FRAME.block, restitution=0.5),
    call(th.RockingBlock, **THREE_NUMBERS, linearised=False),
    call(FRAME.block().with_restitution, value=0.5),
    call(th.FixedMassColumn, **BEAM, cap_width=1.0, cap_depth=0.5),
    call(th.MonolithicPortal, **BEAM, span=8.0, overhang=0.5, cap_depth=0.5),
    call(th.Cap, span=5.0, half_depth=0.5),
    call(th.Pulse, **SINE, angular_frequency=2.0, cycles=2),
    call(th.Pulse, **SINE, period=2.0),
    call(PULSE.scaled, factor=2.0),
    call(PULSE.excitation, t=[0.5, 2.0]),
    call(th.Record, time_step=0.125, acceleration=[0.0, 0.5, -0.5], unit="g", start=2.0),
    call(SHAKING.scaled, factor=2.0),
    call(SHAKING.scaled_to, pga=0.5),
    call(SHAKING.scaled_to, pgv=0.5),
    call(SHAKING.excitation, t=[0.5, 2.0]),
    call(th.simulate, **SHAKEN, **START, **TIGHT),
    call(th.judge, **SHAKEN, **TIGHT, vertical=UP),
    call(th.overturned_by, **SHAKEN, **SCALED, factors=[1.0, 2.0]),
    call(th.peak_rotations, **SHAKEN | {"structure": [FRAME]}, **SCALED, **TIGHT, factors=[1.0]),
    call(th.lowest_overturning, **SHAKEN, **RANGE, floor=0.125),
    call(th.overturning_intervals, **SHAKEN, **RANGE, resolution=0.125, most_impacts=1),
    call(th.overturning_map, **MAP, motion="one-sine"),
    call(th.overturning_map, **MAP, motion=SHAKING),
    call(th.overturning_spectrum, structure=FRAME, **SINES),
    call(th.capacity, structure=FRAME, record=SHAKING, **SCALED),
    call(th.Capacity, **OUTCOMES, share=0.5),
    call(th.fragility, **CURVES),
    call(
        of_response(th.contact_forces), structure=FRAME, cap=CAP, response=history, motion=SHAKING
    ),
    call(th.impact_impulses, frame=FRAME, cap=CAP, velocity=0.5),
    call(of_response(th.plot.history), response=history),
    call(th.plot.structure, shown=FRAME, rotation=0.125, cap_width=5.0, cap_depth=0.5),
]
ARGUMENTS = [(function, values, name) for function, values in CALLS for name in values]
WRONG = [object(), th.Column, 1j, np.ma.masked, "no such", np.full((5000, 2), math.nan), b"1"]


def each(chosen=lambda value: True):
    """Parametrise by the arguments whose good value is chosen."""
    rows = [row for row in ARGUMENTS if chosen(row[1][row[2]])]
    ids = [f"{function.__qualname__}-{name}" for function, _, name in rows]
    return pytest.mark.parametrize(("function", "values", "name"), rows, ids=ids)


@each()
def test_wrong_value_is_refused_in_few_words(function, values, name):
    for value in WRONG:
        with pytest.raises(ValueError, match="expected") as error:
            function(**values | {name: value})
        assert len(str(error.value)) < 600


@each(lambda value: np.asarray(value).dtype.kind in "if")
def test_numbers_of_numpy_are_numbers(function, values, name):
    value = np.asarray(values[name])
    for twin in (value.astype({"f": np.float32, "i": np.int64}[value.dtype.kind]), value):
        result = function(**values | {name: twin[()] if np.ndim(twin) == 0 else twin})
        assert repr(result) == repr(function(**values))
    plt.close("all")


SIGNED = {"amplitude", "factor", "rotation", "start", "velocity"}


@each(lambda value: isinstance(value, int | float) and not isinstance(value, bool))
def test_number_without_a_sign_is_no_less_than_zero(function, values, name):
    for value in (-0.001, -math.inf)[name in SIGNED :]:
        with pytest.raises(ValueError, match=r"(?s)expected"):
            function(**values | {name: value})


@each(lambda value: np.ndim(value) == 1)
def test_masked_elements_are_refused(function, values, name):
    value = np.ma.masked_array(values[name], [True, *[False] * (len(values[name]) - 1)])
    for masked in (value, list(value), [value]):
        with pytest.raises(ValueError, match="masked"):
            function(**values | {name: masked})


@pytest.mark.parametrize("twin", [lambda record: pickle.loads(pickle.dumps(record)), copy.deepcopy])
def test_samples_of_a_record_cannot_be_written_to(twin):
    for record in (SHAKING, twin(SHAKING), twin(SHAKING.scaled(2.0))):
        with pytest.raises(ValueError, match="read-only"):
            record.acceleration[0] = 1.0


# ---------------------------------------------------------------------------- one argument each

STOCKY = th.Column(2.0, 1.0)
THREE = th.RockingFrame.of_masses(COLUMN, 600.0, 60.0, columns=3)
FOREVER = th.Pulse("harmonic", 0.3, angular_frequency=5.0)
STILL = th.Record(0.02, [0.0, 0.0, 0.0], "still")
FALLING = th.Record(0.05, [0.0, 0.4, -0.5, 0.0])
record = partial(th.Record, 0.02)
lowest = partial(th.lowest_overturning, BLOCK)
intervals = partial(th.overturning_intervals, BLOCK, PULSE)
a_map = partial(th.overturning_map, BLOCK)
forces = partial(th.contact_forces, FRAME, CAP)
history_of = partial(th.simulate, FRAME, SHAKING)


def fragile(**changed):
    return th.fragility(**{"structures": COLUMN, "motions": MOTIONS, "levels": LEVELS} | changed)


def arias(motion):
    """Arias intensity but for a constant: it grows with the square of the motion."""
    return float((motion.acceleration**2).sum())


BAD = {  # what the message begins with or has, and what is called
    # the checks by which all functions refuse a value
    "x is '1'; expected a number": lambda: checks.number("x", "1"),
    "x is nan; expected a finite number": lambda: checks.finite("x", math.nan),
    "x: element 1 is None; expected a number": lambda: checks.numbers("x", [0.1, None]),
    "expected rows of equal length": lambda: checks.numbers("x", [[0.1], [0.2, 0.3]]),
    "x has shape (0,); expected a list": lambda: checks.axis_values("x", []),
    "x holds inf; expected finite": lambda: checks.axis_values("x", [1.0, math.inf]),
    "x goes down to 0; it cannot be zero or": lambda: checks.axis_values("x", [1.0, 0.0]),
    "it cannot be negative": lambda: checks.axis_values("x", [-1.0], zero_allowed=True),
    "x is 0 m; expected more than zero": lambda: checks.positive("x", 0.0, "m"),
    "x is -1e+07 g; expected at most 1e+06 g": lambda: checks.within_reason("x", -1e7, "g"),
    "x: 4e+08 cells; expected at most": lambda: checks.number_of_cells("x", 20_000, 20_000),
    "span is 1 m; expected more than the width": lambda: checks.wider_than_column(1.0, 1.0),
    "x is 1.5708 rad (90°); expected": lambda: checks.within_quarter_turn("x", math.pi / 2),
    "x is 1.01; expected a number from 0 to 1": lambda: checks.fraction("x", 1.01),
    "x is 1; expected a whole number from 2 to 9": lambda: checks.whole("x", 1, 2, 9),
    "x is 2.5; expected a whole number from 2 on": lambda: checks.whole("x", 2.5, 2),
    # bodies
    "mass_ratio is nan; expected γ": lambda: th.RockingFrame(COLUMN, math.nan),
    "45°": lambda: simplified(th.RockingFrame(th.Column(1.1, 1.0), 0.1)),
    "expected a finite γ": lambda: restoring_moment(th.RockingFrame(COLUMN, math.inf), 0.1),
    "rotation is 0 rad; expected between 0 and α = 0.25": lambda: quarter_period(BLOCK, 0.0),
    "slenderness is 1.10715 rad (63.43°)": lambda: th.simulate(STOCKY, PULSE),
    # ground
    "angular_frequency is None and period is None": lambda: th.Pulse("one-sine", 0.3),
    "is 2.0 and period is 3.0; expected one": lambda: th.Pulse(
        "one-sine", 0.3, angular_frequency=2.0, period=3.0
    ),
    "cycles is 2 for shape 'half-sine'": lambda: th.Pulse(
        "half-sine", 0.3, angular_frequency=5.0, cycles=2
    ),
    "'onesine' (did you mean 'one-sine'?)": lambda: th.Pulse("onesine", 0.3, angular_frequency=5.0),
    "sample 1 of 2 is nan": lambda: record([0.0, math.nan]),
    "'Kos' has shape (1,); expected at least two samples": lambda: record([0.3], "Kos"),
    "name is 'm/s2'; expected a text that is no": lambda: record([0.0, 0.1], "m/s2"),
    "pga is 1, pgv is 2; expected one of both": lambda: SHAKING.scaled_to(pga=1, pgv=2),
    "record 'still' has no acceleration": lambda: STILL.scaled_to(pga=1.0),
    "path is None": lambda: th.read_record(None),
    # outcomes
    'expected a Pulse or a Record, for example Pulse("one-sine", 0.3': lambda: th.simulate(
        FRAME, 3
    ),
    "excitation is None; expected a Pulse or a Record": lambda: th.judge(FRAME, None),
    "goes on forever; expected": lambda: th.judge(FRAME, FOREVER),
    "duration is": lambda: th.simulate(FRAME, FOREVER),
    "rotation is 1.5708 rad; expected less than π/2": lambda: history_of(rotation=math.pi / 2),
    f"samples is 1000000000; expected a whole number from 2 to {MAX_SAMPLES}": lambda: history_of(
        samples=10**9
    ),
    "samples has shape (1, 2); expected a list of times": lambda: history_of(samples=[[0.0, 1.0]]),
    "samples holds times that are not finite": lambda: history_of(samples=[0.0, math.nan]),
    "samples is not an increasing array": lambda: history_of(samples=[0.0, 0.1, 0.1]),
    "excitation is Pulse and vertical Record; expected two": lambda: th.judge(
        FRAME, PULSE, vertical=UP
    ),
    "excitation is Record and vertical list; expected two": lambda: history_of(vertical=[0.1, 0.2]),
    "at 0.1 s its acceleration times 1 is -1 g; expected more than −1 g": lambda: history_of(
        vertical=th.Record(0.1, [0.0, -1.0])
    ),
    "factors less than 0.8 are allowed": lambda: history_of(
        vertical=th.Record(0.05, [0.0, 0.4, -0.8, -1.25, 0.0])
    ),
    "amplitude is 5e+69 g; expected at most": lambda: th.overturned_by(COLUMN, PULSE, [1e70]),
    "'harmonic', which goes on forever": lambda: a_map("harmonic", [1.0], [0.3]),
    "record 'still' has a peak acceleration of 0 g": lambda: a_map(STILL, [1.0], [0.3]),
    "scale_range is (2, 1); expected it to ascend": lambda: lowest(PULSE, (2.0, 1.0), floor=0.1),
    "lacks scale_range and floor; expected": lambda: th.lowest_overturning(COLUMN, PULSE),
    "scale_range begins at -1;": lambda: lowest(PULSE, (-1.0, 1.0), floor=0.1),
    "floor is 1e-11 of 4.5 to 8": lambda: lowest(PULSE, (4.5, 8.0), floor=1e-11),
    "resolution is 1e-300 of 0 to 5": lambda: intervals((0.0, 5.0), resolution=1e-300),
    "excitation goes on forever; expected": lambda: th.overturning_spectrum(
        BLOCK, "harmonic", [1.0]
    ),
    "highest is 0.5; exp": lambda: th.overturning_spectrum(BLOCK, "one-sine", 1, highest=0.5),
    "peak acceleration of the record is 0;": lambda: th.capacity(COLUMN, STILL),
    "factors do not increase": lambda: th.Capacity([1.0, 1.0], [True, True]),
    "overturned has shape (1,); expected (2,)": lambda: th.Capacity([1.0, 1.001], [True]),
    "the block is not linearised": lambda: closed(COLUMN.block(), PULSE),
    ", ".join(ELEMENTARY): lambda: closed(COLUMN.block().linear(), RICKER),
    # forces
    "up to 1.7 rad; expected less than π/2": lambda: forces_at(FRAME, CAP, [-1.7, 0.1], 0, 0),
    "no rocking after an impact": lambda: th.impact_impulses(th.RockingFrame(STOCKY, 1), CAP, 0.5),
    "has 3 columns; expected two": lambda: th.impact_impulses(THREE, CAP, 0.1),
    "differs by up": lambda: forces(history(), SHAKING.scaled(1.01)),
    "without a vertical component": lambda: forces(th.simulate(**SHAKEN, vertical=UP), SHAKING),
    "response begins at 0.5 s; expected t = 0": lambda: forces(
        th.simulate(**SHAKEN, samples=[0.5, 1.0]), SHAKING
    ),
    "expected a RockingFrame, a Column": lambda: th.contact_forces(BLOCK, None, history(), SHAKING),
    "since Column has no loose cap": lambda: th.contact_forces(COLUMN, CAP, history(), SHAKING),
    "the excitation goes on forever": lambda: clamped_forces(FRAME, CAP, FOREVER),
    # risk
    "structures is empty; expected one, a list, or": lambda: fragile(structures={}),
    "structures, int 2: structure is 3; expected a Column": lambda: fragile(structures=[COLUMN, 3]),
    "motions is []; expected a list of motions": lambda: fragile(motions=[]),
    "expected a Record or a Pulse that ends": lambda: fragile(motions=[FOREVER]),
    "measure of motions[1] is 0; expected more": lambda: fragile(motions=[SHAKING, STILL]),
    "which has no PGV; expected a Record, or a fun": lambda: fragile(motions=[PULSE]),
    "levels is array([0.3, 0.1]); expected levels": lambda: fragile(levels=[0.3, 0.1]),
    "measure of motions[0] grows by 4 under a factor of 2 on the motion": lambda: fragile(
        measure=arias
    ),
    "grows by 0.60206 with each factor of 2 on the motion, as a logarithm does; expected a measure "
    "that doubles: take 10**(value/2), with the": lambda: fragile(
        measure=lambda motion: 2.0 * np.log10(motion.peak_acceleration) - 9.0
    ),
    "grows by 1 under a factor of 2 on": lambda: fragile(measure=lambda motion: 3.0),
    "vertical[1] is None; expected a Record for": lambda: fragile(vertical=[UP, None, UP, UP]),
    "confidence is 1; expected more than 0 and less than 1": lambda: fragile(confidence=1.0),
    "rotation_limit is 5 rad (286.5°); expected an angle": lambda: fragile(rotation_limit=5.0),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_call_ends_in_words(message):
    with pytest.raises(ValueError, match=re.escape(message)) as error:
        BAD[message]()
    assert len(str(error.value)) < 600


# ---------------------------------------------------------------------------- several functions


@pytest.mark.parametrize("value", [1e-16, np.float64(1e-14), 1e-2])
def test_tolerance_at_the_ends_of_its_range_gives_histories(value):
    whole = th.simulate(FRAME, RICKER, tolerance=value)
    assert th.judge(FRAME, RICKER, tolerance=value).overturned == whole.overturned
    usual = th.simulate(FRAME, RICKER).peak_rotation
    assert whole.peak_rotation == pytest.approx(usual, rel=0.05)


def test_search_is_refused_for_its_largest_factor_alone():
    says = r"at 0\.1 s .* times 2\.5 is -1\.25 g.*factors less than 2 are allowed"
    ends = (FRAME, SHAKING, (0.5, 2.5))
    for search in (
        partial(th.overturned_by, [COLUMN, FRAME], SHAKING, [0.5, 2.5]),
        partial(th.overturning_intervals, *ends, resolution=0.5),
        partial(th.lowest_overturning, *ends, floor=0.5),
    ):
        with pytest.raises(ValueError, match=says):
            search(vertical=FALLING)
        search(vertical=FALLING, scale_vertical=False)
    says = r"times -3 is -1\.2 g.*factors more than -2\.5 are allowed"
    with pytest.raises(ValueError, match=says):
        th.overturning_intervals(FRAME, SHAKING, (-3.0, 0.5), resolution=1.0, vertical=FALLING)
    huge = th.Record(0.05, [0.0, -3.0, 0.0])  # allowed below a third
    assert not th.overturned_by(FRAME, SHAKING, [0.0, 0.3], vertical=huge).any()


# ---------------------------------------------------------------------------- what is asked

FEW = {"levels": [0.1, 0.2], "resamples": 100}


def marked(place):
    """A record in which a number that stands for missing data takes the place of samples."""
    samples = 981.0 * MOTION
    samples[place] = -999.9
    return th.Record(0.01, samples, unit="gal")


NOISE = np.sin(0.06 * np.arange(1000))
ASKED = {
    "time_step is 10 s.*is it in ms": lambda: th.Record(10.0, [0.0, 0.1]),
    "^record: time_step is 0.25 s: is it in ms": lambda: th.Record(0.25, MOTION[::25]),
    "pgv is 60 m/s.*is it in cm/s": lambda: SHAKING.scaled_to(pgv=60),
    "pga is 200 g.*is it in gal": lambda: SHAKING.scaled_to(pga=200),
    "by 2e.03: is it noise": lambda: th.Record(0.1, [0.0, 1e-3]).scaled_to(pga=2),
    "acceleration is 3.13 g.*m/s²": lambda: th.Record(0.1, [0.0, 3.13]),
    "velocity at the end is -0.305 m/s, with a PGV of 0.4": lambda: th.Record(
        0.01, MOTION - 0.0078
    ),
    "PGV is 7.96 m/s.*; the largest acceleration is 5.65 g": lambda: th.Record(0.01, 20 * MOTION),
    "no sample changes sign": lambda: th.Record(0.01, np.abs(MOTION)),
    "2.26 g, and few exceed 2 g: is it in m/s²": lambda: th.Record(0.01, 8.0 * MOTION),
    "and few exceed 5 g": lambda: th.Record(0.01, 1000.0 * NOISE, unit="m/s2"),
    "is 0.0028.* g, and few .* are below 0.005 g": lambda: th.Record(0.01, 0.01 * MOTION),
    "neighbours of the peak, sample 51 of 400, are below half": lambda: marked(50),
    "neighbours of the peak, sample 400 of 400, are below half": lambda: marked(-1),
    "neighbours of the peak, sample 1 of 400, are below half": lambda: marked(slice(2)),
    "or counts": lambda: th.Record(0.01, -12085 + 6000 * NOISE, unit="m/s2"),
    "half of the levels exceed 20 m/s.*are they in cm/s": lambda: fragile(levels=[10, 20, 30]),
    "exceed 200 g.*in gal or m/s": lambda: fragile(levels=[100, 200, 300], measure="PGA"),
    r"motions\[2\] equals motions\[0\]": lambda: fragile(motions=[*MOTIONS[:2], MOTIONS[0]], **FEW),
    r"motions\[1\] is scaled by up to .*: is it noise": lambda: fragile(
        motions=[MOTIONS[1], MOTIONS[0].scaled(1e-12)], **FEW
    ),
}


@pytest.mark.filterwarnings("always")
@pytest.mark.parametrize("question", ASKED)
def test_what_is_probably_a_mistake_is_asked_where_it_was_written(question):
    with pytest.warns(UserWarning, match=question) as caught:
        ASKED[question]()
    assert {warning.filename for warning in caught} == {__file__}


@pytest.mark.filterwarnings("error")
def test_motion_and_what_is_computed_from_it_pass_without_a_word():
    motion = th.Record(0.01, MOTION, "a motion")
    assert str(motion) == "a motion: 400 samples, time step 0.01 s, PGA 0.2827 g, PGV 0.3981 m/s"
    motion.scaled(100.0).detrended()
    th.Record(0.01, np.zeros(10), "at rest")
