"""Every argument of every public function: a wrong value is refused in words, or asked about."""

import copy
import math
import pickle
import re

import matplotlib.pyplot as plt
import numpy as np
import pytest

import topheavy as th
from tests.cases import COLUMN, FRAME, RECORDS
from topheavy.forces import frame_forces

PULSE = th.Pulse("one-sine", 0.5, 2.0)
SHAKING = th.Record(0.02, 0.3 * np.sin(0.1 * np.arange(200)))
UP = th.Record(0.02, 0.1 * np.sin(0.2 * np.arange(200)))
MOTIONS = [th.Record(0.02, 0.3 * np.sin(k * np.arange(200))) for k in (0.03, 0.05, 0.08, 0.2)]
LEVELS = np.geomspace(0.1, 3.0, 20)
FACTORS = np.geomspace(0.5, 2.0, 600)
CAP = th.Cap(5.0, 0.5)
RESPONSE = th.simulate(FRAME, SHAKING, samples=50)
SCALED = {"vertical": UP, "scale_vertical": True}


def call(function, **values):
    """Return a public function and good values of its arguments, all exact in single precision."""
    return function, values


CALLS = [
    call(th.Column, half_width=0.5, half_height=3.0),
    call(th.Column.of_dimensions, width=1.0, height=6.0),
    call(COLUMN.block, restitution=0.5),
    call(th.RockingFrame, column=COLUMN, mass_ratio=1.0, columns=2),
    call(th.RockingFrame.of_masses, column=COLUMN, cap_mass=4.0, column_mass=2.0, columns=2),
    call(FRAME.block, restitution=0.5),
    call(
        th.RockingBlock,
        frequency_parameter=2.0,
        slenderness=0.25,
        restitution=0.5,
        linearised=False,
    ),
    call(FRAME.block().with_restitution, value=0.5),
    call(th.FixedMassColumn, column=COLUMN, mass_ratio=1.0, cap_width=1.0, cap_depth=0.5),
    call(th.MonolithicPortal, column=COLUMN, mass_ratio=1.0, span=8.0, overhang=0.5, cap_depth=0.5),
    call(th.Cap, span=5.0, half_depth=0.5),
    call(th.Pulse, shape="one-sine", amplitude=0.5, angular_frequency=2.0, cycles=2),
    call(th.Pulse, shape="one-sine", amplitude=0.5, period=2.0),
    call(PULSE.scaled, factor=2.0),
    call(PULSE.excitation, t=[0.5, 2.0]),
    call(th.Record, time_step=0.125, acceleration=[0.0, 0.5, -0.5], unit="g", start=2.0),
    call(SHAKING.scaled, factor=2.0),
    call(SHAKING.scaled_to, pga=0.5),
    call(SHAKING.scaled_to, pgv=0.5),
    call(SHAKING.excitation, t=[0.5, 2.0]),
    call(
        th.simulate,
        structure=FRAME,
        excitation=SHAKING,
        rotation=0.125,
        velocity=0.125,
        duration=2.0,
        samples=8,
        tolerance=2.0**-30,
        vertical=UP,
    ),
    call(th.judge, structure=FRAME, excitation=SHAKING, tolerance=2.0**-30, vertical=UP),
    call(th.overturned_by, structure=FRAME, excitation=SHAKING, factors=[1.0, 2.0], **SCALED),
    call(
        th.peak_rotations,
        structure=[FRAME],
        excitation=SHAKING,
        factors=[0.5, 1.0],
        tolerance=2.0**-30,
        **SCALED,
    ),
    call(
        th.lowest_overturning,
        structure=FRAME,
        excitation=SHAKING,
        scale_range=(0.5, 2.0),
        floor=0.125,
        **SCALED,
    ),
    call(
        th.overturning_intervals,
        structure=FRAME,
        excitation=SHAKING,
        scale_range=(0.5, 2.0),
        resolution=0.125,
        most_impacts=1,
        **SCALED,
    ),
    call(
        th.overturning_map,
        structure=FRAME,
        motion="one-sine",
        scales=[1.0, 2.0],
        amplitudes=[0.25],
    ),
    call(th.overturning_map, structure=FRAME, motion=SHAKING, scales=[1.0, 2.0], amplitudes=[0.25]),
    call(
        th.overturning_spectrum,
        structure=FRAME,
        shape="one-sine",
        periods=[1.0, 2.0],
        highest=4.0,
    ),
    call(th.capacity, structure=FRAME, record=SHAKING, window=0.0625, share=0.5, **SCALED),
    call(
        th.Capacity,
        factors=FACTORS,
        overturned=FACTORS > 1.5,
        window=0.0625,
        share=0.5,
        unit_acceleration=0.5,
    ),
    call(
        th.fragility,
        structures=[COLUMN],
        motions=MOTIONS,
        levels=[0.5, 1.0],
        measure="PGV",
        vertical=[UP] * 4,
        scale_vertical=True,
        groups=[1, 1, 2, 2],
        rotation_limit=0.125,
        skewed=False,
        confidence=0.5,
        resamples=100,
        seed=2,
    ),
    call(th.contact_forces, structure=FRAME, cap=CAP, response=RESPONSE, motion=SHAKING),
    call(th.impact_impulses, frame=FRAME, cap=CAP, velocity=0.5),
    call(th.plot.history, response=RESPONSE, structure=FRAME),
    call(th.plot.structure, shown=FRAME, rotation=0.125, cap_width=5.0, cap_depth=0.5),
]
ARGUMENTS = [
    pytest.param(function, values, name, id=f"{function.__qualname__}-{name}")
    for function, values in CALLS
    for name in values
]
WRONG = [object(), th.Column, 1j, np.ma.masked, "no such", np.full((5000, 2), math.nan)]


@pytest.mark.parametrize(("function", "values", "name"), ARGUMENTS)
def test_wrong_value_is_refused_in_few_words(function, values, name):
    for value in WRONG:
        with pytest.raises(ValueError, match="expected") as error:
            function(**values | {name: value})
        assert len(str(error.value)) < 600


@pytest.mark.parametrize(
    ("function", "values", "name"),
    [one for one in ARGUMENTS if np.asarray(one.values[1][one.values[2]]).dtype.kind in "if"],
)
def test_numbers_of_numpy_are_numbers(function, values, name):
    value = np.asarray(values[name])
    for other in (value.astype({"f": np.float32, "i": np.int64}[value.dtype.kind]), value):
        result = function(**values | {name: other[()] if np.ndim(other) == 0 else other})
        assert repr(result) == repr(function(**values))
    plt.close("all")


@pytest.mark.parametrize(
    ("function", "values", "name"),
    [one for one in ARGUMENTS if np.ndim(one.values[1][one.values[2]]) == 1],
)
def test_masked_elements_are_refused(function, values, name):
    value = np.ma.masked_array(values[name], [True, *[False] * (len(values[name]) - 1)])
    for masked in (value, list(value)):
        with pytest.raises(ValueError, match="expected"):
            function(**values | {name: masked})


THREE = th.RockingFrame.of_masses(COLUMN, 600.0, 60.0, columns=3)


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda: th.overturned_by(COLUMN, PULSE, [1e70]), "amplitude is 5e+69 g; expected at most"),
        (lambda: th.peak_rotations(COLUMN, SHAKING, [1e70]), "g; expected at most 1e+06 g"),
        (lambda: th.simulate(COLUMN, PULSE, velocity=1e70), "velocity is 1e+70 rad/s; expected at"),
        (lambda: th.overturning_map(COLUMN, SHAKING, [1e70], [0.1]), "scales is 1e+70 m; expected"),
        (lambda: PULSE.excitation(math.nan), "t holds NaN; expected times in s"),
        (lambda: th.Record(0.01, [0.0, 0.1], "m/s2"), "name is 'm/s2'; expected a text that is no"),
        (lambda: th.RockingFrame(COLUMN, 1.0, 10**5), "columns is 100000; expected a whole number"),
        (lambda: th.read_record(None), "path is None"),
        (lambda: th.read_record(RECORDS / "x.AT2", None), "column is None; expected a number"),
        (
            lambda: th.overturning_spectrum(COLUMN, "one-sine", 1, highest=0.5),
            "highest is 0.5; exp",
        ),
        (lambda: th.capacity(COLUMN, SHAKING.scaled(0.0)), "peak acceleration of the record is 0;"),
        (lambda: th.impact_impulses(THREE, CAP, 0.1), "frame has 3 columns; expected two"),
        (lambda: th.plot.structure(THREE), "frame has 3 columns; expected two"),
        (lambda: th.fragility(COLUMN, MOTIONS, LEVELS, th.Column), "measure is <class"),
        (
            lambda: th.fragility(COLUMN, MOTIONS, LEVELS, groups=[1, 1, math.nan, math.nan]),
            "groups is [1, 1, nan, nan]; expected the group of each of 4 motions",
        ),
        (
            lambda: th.contact_forces(FRAME, CAP, RESPONSE.rotation, RESPONSE.velocity),
            "expected one that simulate returned",
        ),
        (lambda: th.contact_forces(FRAME, CAP, RESPONSE), "response differs by up to"),
    ],
)
def test_bad_call_ends_in_words(function, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        function()


@pytest.mark.parametrize("twin", [lambda it: pickle.loads(pickle.dumps(it)), copy.deepcopy])
def test_samples_of_a_record_cannot_be_written_to(twin):
    for record in (SHAKING, twin(SHAKING), twin(SHAKING.scaled(2.0))):
        with pytest.raises(ValueError, match="read-only"):
            record.acceleration[0] = 1.0


@pytest.mark.parametrize(
    "result",
    [
        SHAKING,
        RESPONSE,
        FRAME,
        th.capacity(COLUMN, PULSE),
        th.fragility(COLUMN, MOTIONS, LEVELS, resamples=100),
        th.impact_impulses(FRAME, CAP, LEVELS),
        frame_forces(FRAME, CAP, 0.01 * LEVELS, LEVELS, LEVELS),
    ],
    ids=lambda result: type(result).__name__,
)
def test_representation_is_short(result):
    assert len(repr(result)) < 600
