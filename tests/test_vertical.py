"""Vertical ground acceleration: two solvers, limits that are known, and what is refused."""

import math

import numpy as np
import pytest

from topheavy import Column, Pulse, Record, RockingFrame, read_record, reference, simulate
from topheavy.newton_euler import ThreeBodies, uplift_accelerations
from topheavy.three_bodies import simulate_three_bodies
from topheavy.vertical import TwoComponents

COLUMN = Column(0.5, 3.0)
FRAME = RockingFrame(COLUMN, 1.0)
TIME = np.linspace(0.0, 6.0, 601)
SHAKE = Record(0.02, 0.2 * np.sin(2.0 * math.pi * np.arange(0, 101) * 0.02 / 1.6), "shake")
UP = Record(0.01, 0.35 * np.cos(2.0 * math.pi * np.arange(0, 301) * 0.01 / 0.31), "up")


def constant(value, time_step=0.02, samples=151):
    return Record(time_step, np.full(samples, value))


def test_no_vertical_acceleration_changes_nothing():
    plain = reference.simulate(FRAME, SHAKE, samples=TIME)
    with_zero = reference.simulate(FRAME, SHAKE, samples=TIME, vertical=constant(0.0, samples=101))
    np.testing.assert_allclose(plain.rotation, with_zero.rotation, atol=1e-12)


def test_constant_vertical_acceleration_is_another_gravity():
    """In (1 + v) g the column has p √(1 + v) and feels ü_g/(1 + v)."""
    share = 0.7
    found = reference.simulate(COLUMN, SHAKE, samples=TIME[:200], vertical=constant(share - 1.0))
    heavier = Column(COLUMN.half_width / share, COLUMN.half_height / share)
    other = reference.simulate(heavier, SHAKE.scaled(1.0 / share), samples=TIME[:200])
    assert np.abs(other.rotation).max() > 0.1 * COLUMN.slenderness
    np.testing.assert_allclose(found.rotation, other.rotation, atol=1e-9)


@pytest.mark.parametrize("gamma", [0.0, 1.0, 4.0])
def test_three_bodies_move_as_the_block_does(gamma):
    frame = RockingFrame(COLUMN, gamma)
    block = reference.simulate(frame, SHAKE, samples=TIME, duration=6.0, vertical=UP)
    still = reference.simulate(frame, SHAKE, samples=TIME, duration=6.0)
    bodies = simulate_three_bodies(
        frame, SHAKE, span=5.0, cap_depth=1.0, duration=6.0, samples=TIME, vertical=UP
    )
    assert block.impacts.size > 1
    assert np.abs(block.rotation - still.rotation).max() > 0.01 * COLUMN.slenderness
    np.testing.assert_allclose(bodies.rotation[:, 0], block.rotation, atol=1e-7)


@pytest.mark.parametrize("vertical", [-0.3, 0.0, 0.5])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_uplift_begins_at_gravity_times_the_tangent(vertical, side):
    level = (1.0 + vertical) * COLUMN.uplift_acceleration
    for share, outcome in ((0.999, "no uplift"), (1.001, "rests")):
        push = constant(side * share * level, samples=3)
        found = reference.simulate(FRAME, push, vertical=constant(vertical, samples=3))
        assert found.outcome == outcome
    lifts = uplift_accelerations(ThreeBodies(FRAME, 5.0, 1.0))
    assert any(abs(lift) == pytest.approx(COLUMN.uplift_acceleration) for lift in lifts.values())


def test_segments_hold_the_samples_of_both_records():
    ground = TwoComponents(SHAKE, UP)
    segments = ground.segments(math.inf)
    assert segments[0].start == 0.0
    assert segments[-1].stop == pytest.approx(3.0)
    assert len(segments) == 300
    for segment in segments:
        middle = 0.5 * (segment.start + segment.stop)
        gravity = segment.gravity(middle)
        assert gravity == pytest.approx(1.0 + UP.excitation(middle))
        if middle < SHAKE.duration:
            assert gravity * segment.acceleration(middle) == pytest.approx(SHAKE.excitation(middle))


def test_vertical_is_refused_where_it_is_not_supported():
    with pytest.raises(ValueError, match="the Taylor solver has no vertical"):
        simulate(FRAME, SHAKE, vertical=UP)
    with pytest.raises(ValueError, match="expected two Records"):
        reference.simulate(FRAME, Pulse("one-sine", 0.3, 6.0), vertical=UP)
    with pytest.raises(ValueError, match="linearised"):
        reference.judge(FRAME.block().linear(), SHAKE, vertical=UP)
    with pytest.raises(ValueError, match=r"sample 0 is -1\.1 g"):
        reference.simulate(FRAME, SHAKE, vertical=constant(-1.1))


def test_measured_vertical_moves_both_solvers_alike():
    across = read_record("data/records/napa_2014_68150_090.AT2")
    up = read_record("data/records/napa_2014_68150_UP.AT2")
    window = slice(1400, 2200)
    across = Record(across.time_step, 1.5 * across.acceleration[window])
    up = Record(up.time_step, 1.5 * up.acceleration[window])
    time = np.linspace(0.0, across.duration, 201)
    block = reference.simulate(FRAME, across, samples=time, duration=4.0, vertical=up)
    bodies = simulate_three_bodies(
        FRAME, across, span=5.0, cap_depth=1.0, duration=4.0, samples=time, vertical=up
    )
    assert np.abs(block.rotation).max() > 0.05 * COLUMN.slenderness
    np.testing.assert_allclose(bodies.rotation[:, 0], block.rotation, atol=1e-7)
