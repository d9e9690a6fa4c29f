"""Vertical motion of the ground."""

import math

import numpy as np
import pytest

import topheavy as th
from steps.shared import plain
from tests.cases import COLUMN, FRAME

TIME = np.linspace(0.0, 6.0, 601)
SHAKE = th.Record(0.02, 0.2 * np.sin(2.0 * math.pi * np.arange(0, 101) * 0.02 / 1.6), "shake")
UP = th.Record(0.01, 0.35 * np.cos(2.0 * math.pi * np.arange(0, 301) * 0.01 / 0.31), "up")


def test_constant_vertical_acceleration_is_another_gravity():
    """In (1 + v) g the column has p √(1 + v) and feels ü_g/(1 + v)."""
    share, lift = 0.7, th.Record(0.02, np.full(151, -0.3))
    lighter = plain.simulate(COLUMN, SHAKE, samples=TIME[:200], vertical=lift)
    heavier = th.Column(COLUMN.half_width / share, COLUMN.half_height / share)
    similar = plain.simulate(heavier, SHAKE.scaled(1.0 / share), samples=TIME[:200])
    assert np.abs(similar.rotation).max() > 0.1 * COLUMN.slenderness
    np.testing.assert_allclose(lighter.rotation, similar.rotation, atol=1e-9)


ODD = th.Record(0.0137, 0.35 * np.cos(20.3 * 0.0137 * np.arange(211)), "a time step of its own")
LATE = th.Record(0.05, 0.5 * np.sin(9.0 * 0.05 * np.arange(90)), "longer than the horizontal one")
ENDED = th.Record(0.03, np.full(20, -0.6), "ends by a jump, before the horizontal one")
VERTICALS = pytest.mark.parametrize("up", [UP, ODD, LATE, ENDED], ids=lambda up: up.name)
EQUATIONS = pytest.mark.parametrize("linearised", [False, True], ids=["exact", "linearised"])


@VERTICALS
@EQUATIONS
@pytest.mark.parametrize("factor", [-1.4, 2.6])
def test_both_solvers_agree(up, linearised, factor):
    block = FRAME.block().linear() if linearised else FRAME.block()
    shaking = SHAKE.scaled(factor)
    ours = th.simulate(block, shaking, samples=TIME, duration=6.0, vertical=up)
    theirs = plain.simulate(block, shaking, samples=TIME, duration=6.0, vertical=up)
    assert ours.outcome == theirs.outcome
    known = np.isfinite(ours.rotation + theirs.rotation)  # not after it has overturned
    off = ours.rotation[known] - theirs.rotation[known]
    assert np.abs(off).max() < 1e-7 * block.slenderness
    assert known.sum() > 100
    impacts = theirs.impact_times  # the plain solver goes on to the outcome
    np.testing.assert_allclose(ours.impact_times, impacts[impacts <= 6.0], atol=1e-5)
    level = th.simulate(block, shaking, samples=TIME, duration=6.0)
    moved = np.abs(ours.rotation - level.rotation)
    assert np.nanmax(moved) > 1e-3 * block.slenderness
    end, plain_end = (solver.judge(block, shaking, vertical=up) for solver in (th, plain))
    assert end[::2] == plain_end[::2]  # overturned, number of impacts
    close = 1e-8 * block.slenderness
    np.testing.assert_allclose(end.peak_rotation, plain_end.peak_rotation, rtol=0, atol=close)


@pytest.mark.parametrize(("scale_vertical", "linearised"), [(False, True), (True, False)])
def test_factors_scale_both_or_one(scale_vertical, linearised):
    block = FRAME.block().linear() if linearised else FRAME.block()
    factors = np.linspace(0.0, 2.8, 29) + 0.4
    weak = th.Record(ODD.time_step, 0.8 * ODD.acceleration)
    search = {"vertical": weak, "scale_vertical": scale_vertical}
    outcomes = th.overturned_by(block, SHAKE.scaled(1.8), factors, **search)
    for factor, overturned in zip(factors, outcomes, strict=True):
        up = weak.scaled(factor) if scale_vertical else weak
        assert overturned == th.judge(block, SHAKE.scaled(1.8 * factor), vertical=up).overturned
    assert 0 < outcomes.sum() < factors.size
    arguments = (block, SHAKE.scaled(1.8), (0.4, 3.2))
    minimum = th.lowest_overturning(*arguments, floor=0.1, **search)
    low, high = th.overturning_intervals(*arguments, resolution=0.1, **search)[0].lower
    ends = ((low, False), (high, True), *zip(minimum.bracket, (False, True), strict=True))
    for factor, overturned in (*ends, *zip(minimum.upper, (True, False), strict=True)):
        up = weak.scaled(factor) if scale_vertical else weak
        inward = 1 if factor < minimum.upper[0] else -1
        truth = plain.judge(
            block,
            SHAKE.scaled(1.8 * factor * (1 + 1e-8 * inward * (2 * overturned - 1))),
            vertical=up,
        )
        assert truth.overturned == overturned
    without = th.lowest_overturning(*arguments, floor=0.1)
    assert abs(without.factor - minimum.factor) > 1e-3
