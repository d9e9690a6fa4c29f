"""Vertical motion of the ground, and a shaking table."""

import math
from functools import partial

import numpy as np
import pytest

import topheavy as th
from tests.cases import RECORDS
from topheavy import Column, RockingFrame, simulate
from topheavy.ground.shaking_table import (
    amplitude_to_uplift,
    frequency_to_uplift,
    table_acceleration,
    table_motion,
)
from topheavy.ground.vertical import TwoComponents
from topheavy.outcomes.overturning import outcomes_by
from topheavy.second import reference
from topheavy.second.three_bodies import simulate_three_bodies

COLUMN = th.Column(0.5, 3.0)
FRAME = th.RockingFrame(COLUMN, 1.0)
TIME = np.linspace(0.0, 6.0, 601)
SHAKE = th.Record(0.02, 0.2 * np.sin(2.0 * math.pi * np.arange(0, 101) * 0.02 / 1.6), "shake")
UP = th.Record(0.01, 0.35 * np.cos(2.0 * math.pi * np.arange(0, 301) * 0.01 / 0.31), "up")


def constant(value, time_step=0.02, samples=151):
    return th.Record(time_step, np.full(samples, value))


def test_no_vertical_acceleration_changes_nothing():
    plain = reference.simulate(FRAME, SHAKE, samples=TIME)
    with_zero = reference.simulate(FRAME, SHAKE, samples=TIME, vertical=constant(0.0, samples=101))
    np.testing.assert_allclose(plain.rotation, with_zero.rotation, atol=1e-12)


def test_constant_vertical_acceleration_is_another_gravity():
    """In (1 + v) g the column has p √(1 + v) and feels ü_g/(1 + v)."""
    share = 0.7
    found = reference.simulate(COLUMN, SHAKE, samples=TIME[:200], vertical=constant(share - 1.0))
    heavier = th.Column(COLUMN.half_width / share, COLUMN.half_height / share)
    other = reference.simulate(heavier, SHAKE.scaled(1.0 / share), samples=TIME[:200])
    assert np.abs(other.rotation).max() > 0.1 * COLUMN.slenderness
    np.testing.assert_allclose(found.rotation, other.rotation, atol=1e-9)


def test_samples_that_more_than_rounding_keeps_apart_begin_segments_of_their_own():
    ground = TwoComponents(th.Record(0.05, np.ones(61)), th.Record(0.0501, np.ones(61)))
    assert len(ground.segments(math.inf)) == 120


SOLVERS = (
    th.simulate,
    th.judge,
    reference.simulate,
    reference.judge,
    lambda *given, **named: th.overturned_by(*given, [1.0], **named),
)


@pytest.mark.parametrize("solver", SOLVERS)
def test_vertical_of_another_kind_is_refused(solver):
    for shaking, up in ((th.Pulse("one-sine", 0.3, 6.0), UP), (SHAKE, 0.1), (SHAKE, [0.1, 0.2])):
        told = rf"excitation is {type(shaking).__name__} and vertical {type(up).__name__}; expected"
        with pytest.raises(ValueError, match=told):
            solver(FRAME, shaking, vertical=up)


@pytest.mark.parametrize("solver", SOLVERS)
def test_ground_that_falls_from_under_the_structure_is_refused(solver):
    falling = th.Record(0.05, np.array([0.0, 0.4, -0.8, -1.25, 0.0]))
    told = (
        r"^vertical: at 0\.15 s its acceleration times 1 is -1\.25 g; expected more than −1 g, .*"
        r"factors less than 0\.8 are allowed$"
    )
    with pytest.raises(ValueError, match=told):
        solver(FRAME, SHAKE, vertical=falling)
    with pytest.raises(ValueError, match=r"at 0\.05 s .* is -1 g; expected more than −1 g"):
        solver(FRAME, SHAKE, vertical=th.Record(0.05, [0.0, -1.0, 0.0]))


def test_search_is_refused_for_its_largest_factor_alone():
    falling = th.Record(0.05, np.array([0.0, 0.4, -0.5, 0.0]))
    told = r"at 0\.1 s .* times 2\.5 is -1\.25 g.*factors less than 2 are allowed"
    for call in (
        partial(th.overturned_by, FRAME, SHAKE, [0.5, 2.5]),
        partial(th.overturning_intervals, FRAME, SHAKE, (0.5, 2.5), resolution=0.5),
        partial(th.minimum_overturning, FRAME, SHAKE, (0.5, 2.5), resolution=0.5),
        partial(th.lowest_overturning, FRAME, SHAKE, (0.5, 2.5), floor=0.5),
        partial(th.overturned_together, [COLUMN, FRAME], SHAKE, [0.5, 2.5]),
    ):
        with pytest.raises(ValueError, match=told):
            call(vertical=falling)
        call(vertical=falling, scale_vertical=False)
    told = r"times -3 is -1\.2 g.*factors more than -2\.5 are allowed"
    with pytest.raises(ValueError, match=told):
        th.minimum_overturning(FRAME, SHAKE, (-3.0, 0.5), resolution=1.0, vertical=falling)
    huge = th.Record(0.05, np.array([0.0, -3.0, 0.0]), unit="g")  # allowed below a third
    assert not th.overturned_by(FRAME, SHAKE, [0.0, 0.3], vertical=huge).any()


ODD = th.Record(0.0137, 0.35 * np.cos(20.3 * 0.0137 * np.arange(211)), "a time step of its own")
LATE = th.Record(0.05, 0.5 * np.sin(9.0 * 0.05 * np.arange(90)), "longer than the horizontal one")
ENDED = th.Record(0.03, np.full(20, -0.6), "ends by a jump, before the horizontal one")
VERTICALS = pytest.mark.parametrize("up", [UP, ODD, LATE, ENDED], ids=lambda up: up.name)
EQUATIONS = pytest.mark.parametrize("linearised", [False, True], ids=["exact", "linearised"])


@VERTICALS
@EQUATIONS
@pytest.mark.parametrize("factor", [1.0, -1.4, 2.6, 4.5])
def test_both_solvers_agree(up, linearised, factor):
    block = FRAME.block().linear() if linearised else FRAME.block()
    shaking = SHAKE.scaled(factor)
    ours = th.simulate(block, shaking, samples=TIME, duration=6.0, vertical=up)
    theirs = reference.simulate(block, shaking, samples=TIME, duration=6.0, vertical=up)
    assert ours.outcome == theirs.outcome
    known = np.isfinite(ours.rotation + theirs.rotation)  # not after it has overturned
    off = ours.rotation[known] - theirs.rotation[known]
    assert np.abs(off).max() < 1e-7 * block.slenderness
    assert known.sum() > 100
    np.testing.assert_allclose(ours.impacts, theirs.impacts, atol=1e-5)
    plain = th.simulate(block, shaking, samples=TIME, duration=6.0)
    moved = np.abs(ours.rotation - plain.rotation)
    assert np.nanmax(moved) > 1e-3 * block.slenderness
    alone, other = (
        th.judge(block, shaking, vertical=up),
        reference.judge(block, shaking, vertical=up),
    )
    assert (alone.overturned, alone.impacts) == (other.overturned, other.impacts)
    np.testing.assert_allclose(alone.peak, other.peak, rtol=0, atol=1e-8 * block.slenderness)


@pytest.mark.parametrize("gamma", [0.0, 1.0])
def test_three_bodies_move_as_the_taylor_solver_says(gamma):
    frame = th.RockingFrame(COLUMN, gamma)
    ours = th.simulate(frame, SHAKE, samples=TIME, duration=6.0, vertical=UP)
    bodies = simulate_three_bodies(
        frame, SHAKE, span=5.0, cap_depth=1.0, duration=6.0, samples=TIME, vertical=UP
    )
    np.testing.assert_allclose(bodies.rotation[:, 0], ours.rotation, atol=1e-7)


@pytest.mark.parametrize("scale_vertical", [False, True])
@EQUATIONS
def test_factors_scale_both_or_one(scale_vertical, linearised):
    block = FRAME.block().linear() if linearised else FRAME.block()
    factors = np.linspace(0.0, 2.8, 29) + 0.4
    weak = th.Record(ODD.time_step, 0.8 * ODD.acceleration)
    found = outcomes_by(
        block, SHAKE.scaled(1.8), factors, vertical=weak, scale_vertical=scale_vertical
    )
    for factor, overturned, impacts in zip(factors, *found, strict=True):
        up = weak.scaled(factor) if scale_vertical else weak
        alone = th.judge(block, SHAKE.scaled(1.8 * factor), vertical=up)
        assert (overturned, impacts) == (alone.overturned, alone.impacts)
    assert 0 < found[0].sum() < factors.size
    search = {"vertical": weak, "scale_vertical": scale_vertical}
    given = (block, SHAKE.scaled(1.8), (0.4, 3.2))
    honest = th.lowest_overturning(*given, floor=0.1, **search)
    low, high = th.minimum_overturning(*given, resolution=0.1, **search)
    ends = ((low, False), (high, True), *zip(honest.bracket, (False, True), strict=True))
    for factor, overturned in (*ends, *zip(honest.upper, (True, False), strict=True)):
        up = weak.scaled(factor) if scale_vertical else weak
        inward = 1 if factor < honest.upper[0] else -1
        truth = reference.judge(
            block,
            SHAKE.scaled(1.8 * factor * (1 + 1e-8 * inward * (2 * overturned - 1))),
            vertical=up,
        )
        assert truth.overturned == overturned
    plain = th.lowest_overturning(*given, floor=0.1)
    assert abs(plain.factor - honest.factor) > 1e-3


def test_measured_vertical_gives_both_solvers_the_same_outcomes():
    across = th.read_record(RECORDS / "napa_2014_68150_090.AT2")
    up = th.read_record(RECORDS / "napa_2014_68150_UP.AT2")
    structures = [
        COLUMN,
        FRAME,
        th.FixedMassColumn(COLUMN, 1.0),
        th.MonolithicPortal(COLUMN, 1.0, 1.2),
    ]
    factors = np.array([1.6, 2.3])
    found = th.overturned_together(structures, across, factors, vertical=up)
    for structure, row in zip(structures, found, strict=True):
        for factor, overturned in zip(factors, row, strict=True):
            given = (structure, across.scaled(factor))
            ours = th.judge(*given, vertical=up.scaled(factor), tolerance=1e-13)
            theirs = reference.judge(*given, vertical=up.scaled(factor))
            assert overturned == ours.overturned == theirs.overturned
            np.testing.assert_allclose(ours.peak, theirs.peak, rtol=0, atol=1e-6 * 0.165)


TRILITH = RockingFrame(Column(0.11, 0.40), 0.434)
AMPLITUDE, FREQUENCY = 0.005, 3.3  # m, Hz; p. 3
PASSAGE = [  # what, ours, printed on p. 3, half a unit of its last digit
    ("tan α", math.tan(TRILITH.slenderness), 0.275, 5e-4),
    ("α, degrees", math.degrees(TRILITH.slenderness), 15.38, 5e-3),
    ("R, m", TRILITH.column.size, 0.415, 5e-4),
    ("p, rad/s", TRILITH.column.frequency_parameter, 4.21, 5e-3),
    ("p̂, rad/s", TRILITH.frequency_parameter, 3.79, 5e-3),
    ("p̂/p", TRILITH.frequency_parameter / TRILITH.column.frequency_parameter, 0.9, 5e-2),
    ("ü_g, m/s²", table_acceleration(AMPLITUDE, FREQUENCY) * 9.81, 2.15, 5e-3),
    ("ü_g, g", table_acceleration(AMPLITUDE, FREQUENCY), 0.219, 5e-4),
]


@pytest.mark.parametrize(("what", "ours", "printed", "half"), PASSAGE, ids=lambda row: str(row))
def test_number_of_the_passage_is_that_printed(what, ours, printed, half):
    assert ours == pytest.approx(printed, abs=half)


def test_table_motion_is_the_second_derivative_of_its_displacement():
    motion, omega, step = table_motion(AMPLITUDE, FREQUENCY), 2 * math.pi * FREQUENCY, 1e-4
    times = np.linspace(0.01, 1.0, 57)
    before, now, after = (AMPLITUDE * np.sin(omega * (times + k * step)) for k in (-1, 0, 1))
    expected = (before - 2 * now + after) / step**2 / 9.81
    np.testing.assert_allclose(motion.excitation(times), expected, atol=1e-6)
    assert motion.duration == math.inf


def lifts(amplitude: float, frequency: float) -> bool:
    motion = table_motion(amplitude, frequency)
    return simulate(TRILITH, motion, duration=2 / frequency, samples=2).outcome != "no uplift"


@pytest.mark.parametrize("frequency", [1.0, FREQUENCY, 8.0])
def test_amplitude_to_uplift_is_bracketed_by_simulation(frequency):
    amplitude = amplitude_to_uplift(TRILITH, frequency)
    assert not lifts(amplitude * (1 - 1e-9), frequency)
    assert lifts(amplitude * (1 + 1e-9), frequency)


def test_the_two_thresholds_are_one():
    amplitude = amplitude_to_uplift(TRILITH, FREQUENCY)
    assert frequency_to_uplift(TRILITH, amplitude) == pytest.approx(FREQUENCY, rel=1e-14)
    linear = TRILITH.block().linear()
    assert amplitude_to_uplift(linear, FREQUENCY) < amplitude


@pytest.mark.parametrize("value", [0.0, -3.3, math.nan])
def test_table_needs_a_frequency_and_an_amplitude(value):
    with pytest.raises(ValueError, match="frequency is"):
        table_motion(AMPLITUDE, value)
    with pytest.raises(ValueError, match="amplitude is"):
        table_motion(value, FREQUENCY)
